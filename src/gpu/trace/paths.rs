//! ray trees in host memory <-> on the device

use std::ops::Range;

use bytemuck::Zeroable as _;

use super::GpuTrace;
use crate::film::Run;
use crate::gpu::{Buffer, Error};
use crate::tables::{Path, Waiting};
use crate::trace::Paths;

/// The ray trees of a run of pixels, on the device.
#[derive(Debug)]
pub struct GpuPaths {
    pub(super) pixels: Range<u32>,
    pub(super) paths: Buffer<Path>,
    pub(super) waiting: Buffer<Waiting>,
    pub(super) walks: Buffer<[u32; 2]>,
    pub(super) sums: Buffer<[f32; 4]>,
    pub(super) squares: Buffer<f32>,
    pub(super) ids: Buffer<u32>,
    pub(super) ended: Vec<bool>,
}

impl GpuTrace<'_> {
    /// Paths from host memory.
    ///
    /// # Errors
    /// If they do not fit the device.
    pub fn upload(&self, paths: &Paths) -> Result<GpuPaths, Error> {
        Ok(GpuPaths {
            pixels: paths.pixels.clone(),
            paths: self.gpu.upload("paths", &paths.paths)?,
            waiting: self.gpu.upload("waiting", &paths.waiting)?,
            walks: self.gpu.upload("walks", &paths.walks)?,
            sums: self.gpu.upload("sums", &paths.sums)?,
            squares: self.gpu.upload("squares", &paths.squares)?,
            ids: self.gpu.upload("ids", &paths.ids)?,
            ended: Vec::new(),
        })
    }

    /// All of a run of pixels in host memory, as it is.
    ///
    /// # Errors
    /// If the device is lost or does not answer.
    pub fn download(&self, paths: &GpuPaths) -> Result<Paths, Error> {
        Ok(Paths {
            pixels: paths.pixels.clone(),
            paths: self.gpu.read(&paths.paths)?,
            waiting: self.gpu.read(&paths.waiting)?,
            walks: self.gpu.read(&paths.walks)?,
            sums: self.gpu.read(&paths.sums)?,
            squares: self.gpu.read(&paths.squares)?,
            ids: self.gpu.read(&paths.ids)?,
        })
    }

    /// Pixels that have the samples of a run, and get those up to `end`.
    pub(super) fn fresh(&self, run: &Run, end: u32) -> Result<GpuPaths, Error> {
        let pixels = run.pixels.clone();
        let count = pixels.len();
        let paths = if run.samples.end == 0 && run.ended.is_empty() {
            self.gpu.zeroed("paths", count)?
        } else {
            self.gpu.upload("paths", &idle(run, end))?
        };
        Ok(GpuPaths {
            pixels,
            paths,
            waiting: self.gpu.zeroed("waiting", count * self.max_depth as usize)?,
            walks: self.gpu.zeroed("walks", count * self.deep as usize)?,
            sums: self.gpu.upload("sums", &run.sums)?,
            squares: self.gpu.upload("squares", &run.squares)?,
            ids: self.gpu.upload("ids", &run.ids)?,
            ended: run.ended.clone(),
        })
    }

    /// The same in the place of pixels that are done with.
    pub(super) fn again(&self, spare: GpuPaths, run: &Run, end: u32) -> GpuPaths {
        self.gpu.write(&spare.paths, &idle(run, end));
        self.gpu.write(&spare.sums, &run.sums);
        self.gpu.write(&spare.squares, &run.squares);
        self.gpu.write(&spare.ids, &run.ids);
        GpuPaths { pixels: run.pixels.clone(), ended: run.ended.clone(), ..spare }
    }
}

/// Paths that are idle at the sample that each pixel is to get next.
fn idle(run: &Run, end: u32) -> Vec<Path> {
    let sample = |i| if run.has_ended(i) { end } else { run.samples.end };
    (0..run.pixels.len()).map(|i| Path { sample: sample(i), ..Path::zeroed() }).collect()
}
