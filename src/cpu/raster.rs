//! Twins of `wgsl/raster`: the rasterizer's stages, over all cores.

pub mod call;
pub mod clip;
pub mod count;
pub mod cover;
pub mod crowd;
pub mod cut;
pub mod facet;
pub mod fill;
pub mod ground;
pub mod heat;
pub mod hold;
pub mod lace;
pub mod mark;
pub mod pixels;
pub mod plan;
pub mod project;
pub mod reach;
pub mod scan;
pub mod shade;
pub mod shadow;
pub mod sift;
pub mod snap;
pub mod speck;
pub mod split;
pub mod weights;

use std::convert::Infallible;
use std::ops::Range;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use rayon::prelude::*;

use crate::raster::{Drawn, Raster, Seen};
use crate::tables::{BIN, Corner, Drawing, Face, GROUP, Lens, NO_DEPTH, NONE, Piece, TILE, Tally};

/// What is nearest, row by row from the top left; each word may be written by any thread.
#[derive(Debug, Default)]
pub struct Image {
    /// [`NO_DEPTH`] less the depth, of all lenses that share the image one after the other; zero is nothing.
    pub nears: Vec<AtomicU32>,
    /// [`NONE`] less the number of the face; none at all for shadows.
    pub ids: Vec<AtomicU32>,
}

impl Image {
    /// Depths and ids.
    #[must_use]
    pub fn seen(&self) -> Seen {
        let all = |words: &[AtomicU32], less: u32| words.iter().map(|word| less - word.load(Relaxed)).collect();
        (all(&self.nears, NO_DEPTH), all(&self.ids, NONE))
    }
}

/// The rasterizer on the CPU, with what its stages hand on to each other.
#[derive(Debug)]
pub struct CpuRaster<'a> {
    drawing: &'a Drawing,
    laced: bool,
    /// Of [`Raster::project`].
    pub corners: Vec<Corner>,
    /// Of [`Raster::split`], in order.
    pub late: Vec<u32>,
    /// Those of them that are in hand: those before are drawn.
    portion: Range<usize>,
    /// Bytes of pieces and of their entries that faces drawn at once may have, unless it is one face.
    pub at_once: usize,
    /// Of [`Raster::cut`], in the order of their faces.
    pub pieces: Vec<Piece>,
    /// Of [`Raster::count`].
    pub counts: Vec<u32>,
    /// The counts of the portions that are drawn.
    before: Vec<u32>,
    /// Of [`Raster::scan`], with the end of the last list.
    pub starts: Vec<u32>,
    /// Of [`Raster::scan`]: tiles with an entry.
    pub busy: Vec<u32>,
    /// Of [`Raster::fill`].
    pub entries: Vec<u32>,
    /// What was counted.
    pub tally: Tally,
    /// Of [`Raster::sift`]: runs of pixels that show a face, and that show none, in order.
    pub runs: [Vec<u32>; 2],
    /// Of [`Raster::shade`]: red, green, blue and the number of samples in the sum.
    pub sums: Vec<[f32; 4]>,
}

/// Faces or pixels that a thread takes at once.
const CHUNK: usize = 1024;

/// About as many bytes as the pieces of a face and their entries take, if they fill its bounding box.
fn bytes(lens: &Lens, face: &Face, corners: &[Corner]) -> usize {
    let [a, b, c] = [face.a, face.b, face.c].map(|i| corners[i as usize]);
    let sides = if a.code | b.code | c.code == 0 {
        let bounds = plan::on_film(lens, plan::span(a.at, b.at, c.at));
        [bounds.z - bounds.x, bounds.w - bounds.y]
    } else {
        [lens.width as i32, lens.height as i32]
    };
    let under = |side: u32| sides.iter().map(|pixels| pixels.max(&0) / side as i32 + 2).product::<i32>() as usize;
    under(TILE) * size_of::<u32>() + under(TILE * BIN) * size_of::<Piece>()
}

impl<'a> CpuRaster<'a> {
    /// A rasterizer of one drawing.
    #[must_use]
    pub fn new(drawing: &'a Drawing) -> Self {
        Self {
            drawing,
            laced: drawing.laced(),
            corners: Vec::new(),
            late: Vec::new(),
            portion: 0..0,
            at_once: 64 << 20,
            pieces: Vec::new(),
            counts: Vec::new(),
            before: Vec::new(),
            starts: Vec::new(),
            busy: Vec::new(),
            entries: Vec::new(),
            tally: Tally::default(),
            runs: Default::default(),
            sums: Vec::new(),
        }
    }
}

impl CpuRaster<'_> {
    /// As many of the late faces from `first` on as are drawn at once: in a film of a few faces all, of thousands that
    /// fill it some.
    fn next(&self, lens: &Lens, first: usize) -> Range<usize> {
        let mut room = self.at_once;
        let faces = self.late[first..].iter().map(|id| &self.drawing.faces[*id as usize]);
        let fit = faces.take_while(|face| {
            let bytes = bytes(lens, face, &self.corners);
            let fits = bytes <= room;
            room = room.saturating_sub(bytes);
            fits
        });
        let count = fit.count().max(1).min(self.late.len() - first);
        first..first + count
    }
}

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

impl Raster for CpuRaster<'_> {
    type Image = Image;
    type Error = Infallible;

    fn image(&mut self, pixels: usize, ids: bool) -> Result<Image, Infallible> {
        let nothing = |words: usize| (0..words).map(|_| AtomicU32::new(0)).collect();
        Ok(Image { nears: nothing(pixels), ids: nothing(if ids { pixels } else { 0 }) })
    }

    fn clear(&mut self, image: &mut Image) -> Result<(), Infallible> {
        image.nears.par_iter_mut().chain(&mut image.ids).for_each(|word| *word.get_mut() = 0);
        Ok(())
    }

    fn project(&mut self, lens: &Lens) -> Result<(), Infallible> {
        self.corners = self.drawing.vertices.par_iter().map(|vertex| project::project(lens, vertex)).collect();
        (self.late, self.portion, self.before) = (Vec::new(), 0..0, Vec::new());
        Ok(())
    }

    fn split(&mut self, lens: &Lens, image: &mut Image, lace: bool) -> Result<(), Infallible> {
        self.tally = Tally::default();
        if self.portion.end > 0 && self.portion.end < self.late.len() {
            self.portion = self.next(lens, self.portion.end);
            return Ok(());
        }
        let corners = &self.corners;
        let chunks = self.drawing.faces.par_chunks(CHUNK).enumerate().map(|(chunk, faces)| {
            let ids = (chunk * CHUNK) as u32..;
            let late =
                faces.iter().zip(ids).filter(|(face, _)| split::split(lens, face, corners, lace, &image.nears));
            late.map(|(_, id)| id).collect::<Vec<_>>()
        });
        self.late = chunks.flatten_iter().collect();
        self.portion = self.next(lens, 0);
        Ok(())
    }

    fn cut(&mut self, lens: &Lens) -> Result<(), Infallible> {
        let Drawing { vertices, faces, .. } = self.drawing;
        let pieces = self.late[self.portion.clone()]
            .par_iter()
            .map(|id| cut::cut(lens, *id, &faces[*id as usize], vertices));
        self.pieces = pieces.flatten_iter().collect();
        self.tally.pieces = self.pieces.len() as u32;
        Ok(())
    }

    fn count(&mut self, lens: &Lens) -> Result<(), Infallible> {
        self.counts = count::count(lens, &self.pieces);
        Ok(())
    }

    fn scan(&mut self, _lens: &Lens) -> Result<(), Infallible> {
        (self.starts, self.busy) = scan::scan(&self.counts, &mut self.tally);
        Ok(())
    }

    fn fill(&mut self, lens: &Lens) -> Result<(), Infallible> {
        self.entries = fill::fill(lens, &self.pieces, &self.starts, self.tally.entries);
        Ok(())
    }

    fn cover(&mut self, lens: &Lens, image: &mut Image) -> Result<(), Infallible> {
        self.busy.par_iter().for_each(|&tile| {
            let first = 2 * tile as usize;
            let list = &self.entries[self.starts[first] as usize..self.starts[first + 2] as usize];
            cover::cover(lens, tile, &self.pieces, list, &image.nears, &image.ids);
        });
        Ok(())
    }

    fn laced(&self) -> bool {
        self.laced
    }

    fn lace(&mut self, lens: &Lens, image: &mut Image) -> Result<(), Infallible> {
        self.busy.par_iter().for_each(|&tile| {
            let first = 2 * tile as usize;
            let list = &self.entries[self.starts[first] as usize..self.starts[first + 2] as usize];
            lace::lace(self.drawing, lens, tile, (&self.pieces, list), &image.nears, &image.ids);
        });
        Ok(())
    }

    fn settle(&mut self, _lens: &Lens, _image: &mut Image) -> Result<bool, Infallible> {
        if self.portion.end == self.late.len() {
            return Ok(true);
        }
        self.before.resize(self.counts.len(), 0);
        for (before, count) in self.before.iter_mut().zip(&self.counts) {
            *before += count;
        }
        Ok(false)
    }

    fn mark(&mut self, lens: &Lens, image: &mut Image) -> Result<(), Infallible> {
        let faces = self.drawing.faces.par_iter().zip(0_u32..self.drawing.faces.len() as u32);
        faces.for_each(|(face, id)| mark::mark(lens, id, face, &self.corners, &image.nears, &image.ids));
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
