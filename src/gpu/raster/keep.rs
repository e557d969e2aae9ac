//! a drawing that is kept -> another like it, of which only what is small goes to the device

use super::part::parts;
use super::{CELLS, GpuRaster, Kernels, sizes};
use crate::gpu::{Buffer, Error};
use crate::raster::Portions;
use crate::tables::{Drawing, GROUP};

impl GpuRaster<'_> {
    /// Takes up another drawing of the same faces, of whose vertices those before `from` are the same too: what is large
    /// stays on the device.
    ///
    /// # Errors
    /// If the drawing does not fit the device.
    pub fn aim(&mut self, drawing: &Drawing, from: usize) -> Result<(), Error> {
        let [pixels, tiles] = sizes(drawing);
        if tiles > self.busy.len() {
            self.cells = self.gpu.zeroed("cells", CELLS * tiles)?;
            self.veil = self.gpu.blank::<[u32; 4]>("veil", CELLS * tiles)?;
            self.counts = self.gpu.zeroed("counts", 2 * tiles)?;
            self.starts = self.gpu.zeroed("starts", 2 * tiles + 1)?;
            self.busy = self.gpu.zeroed("busy", tiles)?;
        }
        if pixels > self.sums.len() {
            self.sums = self.gpu.zeroed("sums", pixels)?;
            self.runs = self.gpu.zeroed("runs", pixels.div_ceil(GROUP as usize))?;
        }
        if from < drawing.vertices.len() {
            self.portions = Portions::new(drawing);
            self.parts = parts(self.gpu, drawing, self.binding)?;
        }
        let Kernels { variant, sources, .. } = &*self.kernels;
        self.shader = variant.shader(self.gpu, sources, drawing)?;
        self.ground = variant.ground(self.gpu, sources, drawing)?;
        if let Some(laces) = &mut self.laces {
            *laces = variant.laces(self.gpu, sources, drawing)?;
        }
        self.lenses = self.gpu.texels("lenses", &drawing.lenses)?;
        self.paints = self.gpu.texels("paints", &drawing.paints)?;
        self.lamps = self.gpu.texels("lamps", &drawing.lamps)?;
        self.gpu.write(&self.canvas, &[drawing.canvas]);
        self.samples = drawing.samples() as u32;
        Ok(())
    }

    /// The sums of the samples that were drawn, where they are.
    #[must_use]
    pub fn shaded(&self) -> &Buffer<[f32; 4]> {
        &self.sums
    }

    /// Begins the sums anew.
    pub fn begin(&mut self) {
        let mut encoder = self.recorded();
        self.sums.clear(&mut encoder);
        self.encoder = Some(encoder);
    }
}
