//! Ray trees in host memory: what a backend is given to begin with, and what it ends with.

use std::ops::Range;

use bytemuck::Zeroable as _;

use crate::film::Run;
use crate::tables::{NONE, Path, Tables, Waiting};

/// The ray trees of a run of pixels, with their part of the film, in host memory.
#[derive(Debug, Clone, PartialEq)]
pub struct Paths {
    /// Which pixels, counted along rows from the top left.
    pub pixels: Range<u32>,
    /// One for each pixel.
    pub paths: Vec<Path>,
    /// The stacks: `max_depth` places for each pixel.
    pub waiting: Vec<Waiting>,
    /// The stacks of walks that are put down: `deep` places for each pixel.
    pub walks: Vec<[u32; 2]>,
    /// Red, green, blue and the number of samples in the sum.
    pub sums: Vec<[f32; 4]>,
    /// Of the samples' luminances, summed.
    pub squares: Vec<f32>,
    /// What the first ray of the first sample met.
    pub ids: Vec<u32>,
}

impl Paths {
    /// Pixels with no sample yet.
    #[must_use]
    pub fn new(pixels: Range<u32>, tables: &Tables) -> Self {
        let count = pixels.len();
        Self {
            pixels,
            paths: vec![Path::zeroed(); count],
            waiting: vec![Waiting::zeroed(); count * tables.settings.max_depth as usize],
            walks: vec![[0; 2]; count * tables.deep as usize],
            sums: vec![[0.0; 4]; count],
            squares: vec![0.0; count],
            ids: vec![NONE; count],
        }
    }

    /// Pixels that have the samples of a run, and get those up to `end`.
    #[must_use]
    pub fn of(run: &Run, end: u32, tables: &Tables) -> Self {
        let mut paths = Self::new(run.pixels.clone(), tables);
        for (i, path) in paths.paths.iter_mut().enumerate() {
            path.sample = if run.has_ended(i) { end } else { run.samples.end };
        }
        Self { sums: run.sums.clone(), squares: run.squares.clone(), ids: run.ids.clone(), ..paths }
    }
}
