//! Twins of `wgsl/raster`: the rasterizer's stages, over all cores.

pub mod behind;
pub mod call;
pub mod clip;
pub mod count;
pub mod cover;
pub mod crowd;
pub mod cut;
pub mod facet;
pub mod far;
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
pub mod veil;
pub mod weights;

use std::convert::Infallible;
use std::ops::Range;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use rayon::prelude::*;

use crate::raster::{Portions, Raster, Seen};
use crate::tables::{BIN, Corner, Drawing, Face, Lens, NO_DEPTH, NONE, Piece, TILE, Tally};

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
    pub(super) drawing: &'a Drawing,
    laced: bool,
    /// Of [`Raster::project`].
    pub corners: Vec<Corner>,
    /// How the faces are divided.
    pub portions: Portions,
    /// Of [`Raster::far`].
    pub cells: Vec<u32>,
    /// Of [`Raster::veil`]; none until it is known.
    pub veil: Vec<[u32; 4]>,
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
    pub(super) before: Vec<u32>,
    /// Of [`Raster::scan`], with the end of the last list.
    pub starts: Vec<u32>,
    /// Of [`Raster::scan`]: tiles with an entry.
    pub busy: Vec<u32>,
    /// Of [`Raster::fill`].
    pub entries: Vec<u32>,
    /// What was counted.
    pub tally: Tally,
    /// Of [`Look::sift`](crate::raster::Look::sift): runs of pixels that show a face, and that show none, in order.
    pub runs: [Vec<u32>; 2],
    /// Of [`Look::shade`](crate::raster::Look::shade): red, green, blue and the number of samples in the sum.
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
            portions: Portions::new(drawing),
            cells: Vec::new(),
            veil: Vec::new(),
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
        self.veil.clear();
        self.corners = self.drawing.vertices.par_iter().map(|vertex| project::project(lens, vertex)).collect();
        (self.late, self.portion, self.before) = (Vec::new(), 0..0, Vec::new());
        Ok(())
    }

    fn faces(&self) -> u32 {
        self.portions.faces()
    }

    fn portions(&self, lens: &Lens) -> Vec<Range<u32>> {
        self.portions.of(lens)
    }

    fn far(&mut self, lens: &Lens, image: &Image) -> Result<(), Infallible> {
        let cells = (0..lens.cells()[0]).into_par_iter();
        self.cells = cells.map(|cell| far::far(lens, &image.nears, cell)).collect();
        Ok(())
    }

    fn veil(&mut self, lens: &Lens) -> Result<(), Infallible> {
        let cells = (0..lens.cells()[0]).into_par_iter();
        self.veil = cells.map(|cell| veil::veil(lens, &self.cells, cell)).collect();
        Ok(())
    }

    fn split(&mut self, lens: &Lens, image: &mut Image, lace: bool, faces: Range<u32>) -> Result<(), Infallible> {
        let whole = faces.end == self.faces();
        if faces.start == 0 {
            self.tally = Tally::default();
        }
        if self.portion.end > 0 && self.portion.end < self.late.len() {
            if whole {
                self.portion = self.next(lens, self.portion.end);
            }
            return Ok(());
        }
        if faces.start == 0 {
            (self.late, self.portion) = (Vec::new(), 0..0);
        }
        let (corners, veil) = (&self.corners, &self.veil);
        let all = &self.drawing.faces[faces.start as usize..faces.end as usize];
        let chunks = all.par_chunks(CHUNK).enumerate().map(|(chunk, some)| {
            let ids = faces.start + (chunk * CHUNK) as u32..;
            let late = some
                .iter()
                .zip(ids)
                .filter(|(face, _)| split::split(lens, face, corners, lace, veil, &image.nears));
            late.map(|(_, id)| id).collect::<Vec<_>>()
        });
        self.late.par_extend(chunks.flatten_iter());
        if whole {
            self.portion = self.next(lens, 0);
        }
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
}
