//! The sums of a film that grows, in host memory.

use std::convert::Infallible;
use std::ops::Range;

use super::trace::CpuTrace;
use super::trace::lay::lay;
use crate::film::Run;
use crate::trace::grow::Grow;
use crate::trace::{BLOCK, Paths, Trace as _};

/// Red, green, blue and the number of samples in the sum, pixel by pixel.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CpuSums {
    before: Vec<[f32; 4]>,
    block: Vec<[f32; 4]>,
    /// All of them.
    pub all: Vec<[f32; 4]>,
}

impl Grow for CpuTrace<'_> {
    type Sums = CpuSums;

    fn sums(&mut self, pixels: u32) -> Result<CpuSums, Infallible> {
        let none = vec![[0.0; 4]; pixels as usize];
        Ok(CpuSums { before: none.clone(), block: none.clone(), all: none })
    }

    fn resume(&mut self, sums: &CpuSums, pixels: Range<u32>, samples: Range<u32>) -> Result<Paths, Infallible> {
        let run = Run { samples: samples.start / BLOCK * BLOCK..samples.start, ..Run::new(pixels.clone(), 0) };
        let Ok(mut paths) = self.begin(&run, samples.end);
        if !samples.start.is_multiple_of(BLOCK) {
            paths.sums.copy_from_slice(&sums.block[pixels.start as usize..pixels.end as usize]);
        }
        Ok(paths)
    }

    fn keep(&mut self, paths: Paths, sums: &mut CpuSums) -> Result<(), Infallible> {
        sums.block[paths.pixels.start as usize..paths.pixels.end as usize].copy_from_slice(&paths.sums);
        Ok(())
    }

    fn lay(&mut self, sums: &mut CpuSums) -> Result<(), Infallible> {
        let CpuSums { before, block, all } = sums;
        for ((all, before), block) in all.iter_mut().zip(before).zip(block) {
            *all = lay(*before, *block);
        }
        Ok(())
    }

    fn turn(&mut self, sums: &mut CpuSums) {
        sums.before.clone_from(&sums.all);
    }
}
