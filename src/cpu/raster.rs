//! Twins of `wgsl/raster`: the rasterizer's stages, over all cores.

pub mod clear;
pub mod clip;
pub mod count;
pub mod cover;
pub mod facet;
pub mod fill;
pub mod hold;
pub mod mark;
pub mod plan;
pub mod project;
pub mod reach;
pub mod scan;
pub mod shade;
pub mod shadow;
pub mod snap;
pub mod split;
pub mod texture;
pub mod weights;

use std::convert::Infallible;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use rayon::prelude::*;

use crate::raster::{Drawn, Raster};
use crate::tables::{Corner, Drawing, Lens, Piece, Tally};

/// Depths and ids, row by row from the top left; each may be written by any thread.
#[derive(Debug, Default)]
pub struct Image {
    /// Of all lenses that share the image, one after the other; [`NO_DEPTH`](crate::tables::NO_DEPTH) is nothing.
    pub depths: Vec<AtomicU32>,
    /// Faces by number, or [`NONE`](crate::tables::NONE); none at all for shadows.
    pub ids: Vec<AtomicU32>,
}

/// The rasterizer on the CPU, with what its stages hand on to each other.
#[derive(Debug)]
pub struct CpuRaster<'a> {
    drawing: &'a Drawing,
    /// Of [`Raster::project`].
    pub corners: Vec<Corner>,
    /// Of [`Raster::split`], in the order of their faces.
    pub pieces: Vec<Piece>,
    /// Of [`Raster::count`].
    pub counts: Vec<u32>,
    /// Of [`Raster::scan`].
    pub starts: Vec<u32>,
    /// Of [`Raster::fill`].
    pub entries: Vec<u32>,
    /// What was counted.
    pub tally: Tally,
    sums: Vec<[f32; 4]>,
}

/// Faces or pixels that a thread takes at once.
const CHUNK: usize = 1024;

impl<'a> CpuRaster<'a> {
    /// A rasterizer of one drawing.
    #[must_use]
    pub fn new(drawing: &'a Drawing) -> Self {
        Self {
            drawing,
            corners: Vec::new(),
            pieces: Vec::new(),
            counts: Vec::new(),
            starts: Vec::new(),
            entries: Vec::new(),
            tally: Tally::default(),
            sums: Vec::new(),
        }
    }
}

impl Raster for CpuRaster<'_> {
    type Image = Image;
    type Error = Infallible;

    fn clear(&mut self, depths: usize, ids: usize) -> Result<Image, Infallible> {
        Ok(Image { depths: clear::clear(depths), ids: clear::clear(ids) })
    }

    fn project(&mut self, lens: &Lens) -> Result<(), Infallible> {
        self.corners = self.drawing.vertices.par_iter().map(|vertex| project::project(lens, vertex)).collect();
        Ok(())
    }

    fn split(&mut self, lens: &Lens, image: &mut Image) -> Result<(), Infallible> {
        let (vertices, corners) = (&self.drawing.vertices, &self.corners);
        let chunks = self.drawing.faces.par_chunks(CHUNK).enumerate().map(|(chunk, faces)| {
            let mut pieces = Vec::new();
            for (face, id) in faces.iter().zip((chunk * CHUNK) as u32..) {
                split::split(lens, id, face, vertices, corners, &image.depths, |piece| pieces.push(piece));
            }
            pieces
        });
        self.pieces = chunks.flatten_iter().collect();
        self.tally = Tally { pieces: self.pieces.len() as u32, ..Tally::default() };
        Ok(())
    }

    fn count(&mut self, lens: &Lens) -> Result<(), Infallible> {
        self.counts = count::count(lens, &self.pieces);
        Ok(())
    }

    fn scan(&mut self, _lens: &Lens) -> Result<(), Infallible> {
        self.starts = scan::scan(&self.counts, &mut self.tally);
        Ok(())
    }

    fn fill(&mut self, lens: &Lens) -> Result<(), Infallible> {
        self.entries = fill::fill(lens, &self.pieces, &self.starts, self.tally.entries);
        Ok(())
    }

    fn cover(&mut self, lens: &Lens, image: &mut Image) -> Result<(), Infallible> {
        (0..lens.tiles()).into_par_iter().for_each(|tile| {
            let first = self.starts[tile as usize] as usize;
            let list = &self.entries[first..first + self.counts[tile as usize] as usize];
            cover::cover(lens, tile, &self.pieces, list, &image.depths, &image.ids);
        });
        Ok(())
    }

    fn mark(&mut self, lens: &Lens, image: &mut Image) -> Result<(), Infallible> {
        let faces = self.drawing.faces.par_iter().zip(0_u32..self.drawing.faces.len() as u32);
        faces.for_each(|(face, id)| mark::mark(lens, id, face, &self.corners, &image.depths, &image.ids));
        Ok(())
    }

    fn shade(&mut self, lens: &Lens, image: &Image, shadows: &Image) -> Result<(), Infallible> {
        self.sums.resize(lens.pixels() as usize, [0.0; 4]);
        let pixels = self.sums.par_iter_mut().zip(&image.ids).zip(0_u32..lens.pixels());
        pixels.for_each(|((sum, id), pixel)| {
            shade::shade(self.drawing, lens, &shadows.depths, pixel, id.load(Relaxed), sum);
        });
        Ok(())
    }

    fn end(&mut self, image: &Image) -> Result<Drawn, Infallible> {
        Ok((std::mem::take(&mut self.sums), image.ids.iter().map(|id| id.load(Relaxed)).collect()))
    }
}
