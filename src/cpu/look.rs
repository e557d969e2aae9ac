//! The stages of an eye, over all cores.

use std::convert::Infallible;
use std::sync::atomic::Ordering::Relaxed;

use rayon::prelude::*;

use super::raster::{CpuRaster, Image, crowd, ground, heat, mark, shade, sift};
use crate::raster::{Drawn, Look};
use crate::tables::{GROUP, Lens, NONE};

/// The pixels of some of an image's runs.
fn each_of(runs: &[u32], sums: &mut [[f32; 4]], work: impl Fn(u32, &mut [f32; 4]) + Sync) {
    let mut rows: Vec<_> = sums.chunks_mut(GROUP as usize).map(Some).collect();
    let taken: Vec<_> = runs.iter().filter_map(|run| Some((*run, rows[*run as usize].take()?))).collect();
    taken.into_par_iter().for_each(|(run, sums)| {
        for (sum, pixel) in sums.iter_mut().zip(run * GROUP..) {
            work(pixel, sum);
        }
    });
}

impl Look for CpuRaster<'_> {
    fn mark(&mut self, lens: &Lens, image: &mut Image) -> Result<(), Infallible> {
        let faces = self.drawing.faces.par_iter().zip(0_u32..self.drawing.faces.len() as u32);
        faces
            .for_each(|(face, id)| mark::mark(lens, id, face, &self.corners, &self.veil, &image.nears, &image.ids));
        Ok(())
    }

    fn sift(&mut self, lens: &Lens, image: &Image) -> Result<(), Infallible> {
        self.runs = sift::sift(&image.ids[..lens.pixels() as usize]);
        Ok(())
    }

    fn shade(&mut self, lens: &Lens, image: &Image, shadows: &Image) -> Result<(), Infallible> {
        self.sums.resize(lens.pixels() as usize, [0.0; 4]);
        each_of(&self.runs[0], &mut self.sums, |pixel, sum| {
            let id = NONE - image.ids[pixel as usize].load(Relaxed);
            shade::shade(self.drawing, lens, &shadows.nears, pixel, id, sum, &mut ());
        });
        Ok(())
    }

    fn ground(&mut self, lens: &Lens) -> Result<(), Infallible> {
        self.sums.resize(lens.pixels() as usize, [0.0; 4]);
        each_of(&self.runs[1], &mut self.sums, |_, sum| ground::ground(self.drawing, sum));
        Ok(())
    }

    fn crowd(&mut self, lens: &Lens) -> Result<(), Infallible> {
        for (count, before) in self.counts.iter_mut().zip(&self.before) {
            *count += before;
        }
        crowd::crowd(lens, &self.drawing.faces, &self.corners, &mut self.counts);
        Ok(())
    }

    fn heat(&mut self, lens: &Lens) -> Result<(), Infallible> {
        self.sums.resize(lens.pixels() as usize, [0.0; 4]);
        let pixels = self.sums.par_iter_mut().zip(0_u32..lens.pixels());
        pixels.for_each(|(sum, pixel)| heat::heat(lens, &self.counts, pixel, sum));
        Ok(())
    }

    fn end(&mut self, lens: &Lens, image: &Image) -> Result<Drawn, Infallible> {
        let mut ids = image.seen().1;
        ids.truncate(lens.pixels() as usize);
        Ok((std::mem::take(&mut self.sums), ids))
    }
}
