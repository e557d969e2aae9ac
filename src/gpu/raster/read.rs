//! what the stages hand on -> host memory

use super::part::Bound;
use super::{GpuImage, GpuRaster};
use crate::gpu::{Buffer, Error};
use crate::raster::Seen;
use crate::tables::{Corner, Lens, NO_DEPTH, NONE, Tally};

impl GpuRaster<'_> {
    /// Of `project`, part after part.
    ///
    /// # Errors
    /// If the device is lost or does not answer.
    pub fn corners(&mut self) -> Result<Vec<Corner>, Error> {
        self.told()?;
        let read = |bound: &Bound| self.gpu.read_texels(&bound.corners, bound.part.vertices as usize);
        let parts: Result<Vec<_>, _> = self.parts.iter().map(read).collect();
        Ok(parts?.concat())
    }

    /// Of `veil`, cell by cell.
    ///
    /// # Errors
    /// If the device is lost or does not answer.
    pub fn hiding(&mut self, lens: &Lens) -> Result<Vec<[u32; 4]>, Error> {
        self.told()?;
        self.gpu.read_texels(&self.veil, lens.cells()[0] as usize)
    }

    /// Of `call`: columns and rows of workgroups.
    #[must_use]
    pub fn calls(&self) -> &Buffer<[u32; 4]> {
        &self.calls
    }

    /// Submits what is recorded and waits for it; what was counted since the lens was taken up.
    ///
    /// # Errors
    /// If the device is lost or does not answer.
    pub fn told(&mut self) -> Result<Tally, Error> {
        let encoder = self.recorded();
        let told = self.gpu.finish_and_read(encoder, &self.tally)?;
        Ok(told.first().copied().unwrap_or_default())
    }

    /// Depths and ids of an image, in host memory.
    ///
    /// # Errors
    /// If the device is lost or does not answer.
    pub fn seen(&mut self, image: &GpuImage) -> Result<Seen, Error> {
        let encoder = self.recorded();
        let words = self.gpu.finish_and_read(encoder, &image.words)?;
        if image.eye {
            return Ok(words.chunks_exact(2).map(|pair| (NO_DEPTH - pair[1], NONE - pair[0])).unzip());
        }
        Ok((words.iter().map(|word| NO_DEPTH - word).collect(), Vec::new()))
    }

    /// Of `shade`: red, green, blue and the number of samples, added up since `end`.
    ///
    /// # Errors
    /// If the device is lost or does not answer.
    pub fn sums(&self) -> Result<Vec<[f32; 4]>, Error> {
        self.gpu.read(&self.sums)
    }
}
