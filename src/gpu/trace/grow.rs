//! The sums of a film that grows, on the device.

use std::ops::Range;
use std::time::Duration;

use super::{GpuPaths, GpuTrace};
use crate::film::Run;
use crate::gpu::pace::Pace;
use crate::gpu::{Binding, Buffer, Error};
use crate::tables::{Slice, Tables, View};
use crate::trace::grow::Grow;
use crate::trace::{BLOCK, Trace as _};

/// Red, green, blue and the number of samples in the sum, pixel by pixel.
#[derive(Debug)]
pub struct GpuSums {
    before: Buffer<[f32; 4]>,
    block: Buffer<[f32; 4]>,
    /// All of them.
    pub all: Buffer<[f32; 4]>,
}

impl GpuTrace<'_> {
    /// Takes up another view of the same scene.
    pub fn aim(&mut self, view: &View) {
        self.gpu.write(&self.view, &[*view]);
    }

    /// Takes up other lights, as many as there were, another background, and other numbers of the same materials.
    ///
    /// # Errors
    /// If the device has no room.
    pub fn repaint(&mut self, tables: &Tables) -> Result<(), Error> {
        self.paints = self.gpu.texels("paints", &tables.paints)?;
        self.gpu.write(&self.materials, &tables.materials);
        self.gpu.write(&self.settings, &[tables.settings]);
        self.gpu.write(&self.lights, &tables.lights);
        self.gpu.write(&self.scene, &[tables.scene()]);
        Ok(())
    }

    /// Work in slices of at most so long: who waits for a window waits for them.
    #[must_use]
    pub fn in_slices_of(mut self, most: Duration) -> Self {
        self.pace = Pace::new(most, self.pace.pixels);
        self
    }
}

impl Grow for GpuTrace<'_> {
    type Sums = GpuSums;

    fn sums(&mut self, pixels: u32) -> Result<GpuSums, Error> {
        let none = |label| self.gpu.zeroed(label, pixels as usize);
        Ok(GpuSums { before: none("before")?, block: none("block")?, all: none("sums")? })
    }

    fn resume(&mut self, sums: &GpuSums, pixels: Range<u32>, samples: Range<u32>) -> Result<GpuPaths, Error> {
        let run = Run { samples: samples.start / BLOCK * BLOCK..samples.start, ..Run::new(pixels.clone(), 0) };
        let paths = self.begin(&run, samples.end)?;
        if !samples.start.is_multiple_of(BLOCK) {
            let mut encoder = self.gpu.encoder();
            sums.block.copy(&mut encoder, pixels.start as usize, &paths.sums, 0, pixels.len());
            self.gpu.queue().submit([encoder.finish()]);
        }
        Ok(paths)
    }

    fn keep(&mut self, paths: GpuPaths, sums: &mut GpuSums) -> Result<(), Error> {
        let mut encoder = self.gpu.encoder();
        paths.sums.copy(&mut encoder, 0, &sums.block, paths.pixels.start as usize, paths.pixels.len());
        self.gpu.queue().submit([encoder.finish()]);
        self.spare = Some(paths);
        Ok(())
    }

    fn lay(&mut self, sums: &mut GpuSums) -> Result<(), Error> {
        let count = sums.all.len() as u32;
        self.gpu.write(&self.slice, &[Slice { first: 0, count, samples: 0, budget: 0 }]);
        let mut encoder = self.gpu.encoder();
        let bindings = [
            Binding::new("slice", &self.slice),
            Binding::new("before", &sums.before),
            Binding::new("block", &sums.block),
            Binding::new("sums", &sums.all),
        ];
        self.lay.dispatch(self.gpu, &mut encoder, &bindings, count)?;
        self.gpu.finish(encoder)
    }

    fn turn(&mut self, sums: &mut GpuSums) {
        let mut encoder = self.gpu.encoder();
        sums.all.copy(&mut encoder, 0, &sums.before, 0, sums.all.len());
        self.gpu.queue().submit([encoder.finish()]);
    }
}
