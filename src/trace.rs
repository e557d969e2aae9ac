//! What a traced frame is: the stages, and their order.
//!
//! ```text
//! pixels -> [cast -> follow -> gather] x rounds -> Film
//! ```
//!
//! A pixel's ray tree lives in a [`Path`] and can be put down after any loop turn. So one round of the three
//! stages starts the pixels that are idle, follows every tree for as long as a budget of loop turns lasts, and
//! gathers the trees that are finished; rounds are repeated until every pixel has all its samples. Neither the
//! budget nor the number of pixels in hand can show in the picture.

use std::ops::Range;

use bytemuck::Zeroable as _;

use crate::film::Film;
use crate::tables::{NONE, Path, Slice, Tables, Waiting};

/// The ray trees of a run of pixels, with their part of the film, in host memory.
#[derive(Debug, Clone, PartialEq)]
pub struct Paths {
    /// Which pixels, counted along rows from the top left.
    pub pixels: Range<u32>,
    /// One for each pixel.
    pub paths: Vec<Path>,
    /// The stacks: `max_depth` places for each pixel.
    pub waiting: Vec<Waiting>,
    /// Red, green, blue and the number of samples in the sum.
    pub sums: Vec<[f32; 4]>,
    /// What the first ray of the first sample met.
    pub ids: Vec<u32>,
}

impl Paths {
    /// Pixels with no sample yet.
    #[must_use]
    pub fn new(pixels: Range<u32>, max_depth: u32) -> Self {
        let count = pixels.len();
        Self {
            pixels,
            paths: vec![Path::zeroed(); count],
            waiting: vec![Waiting::zeroed(); count * max_depth as usize],
            sums: vec![[0.0; 4]; count],
            ids: vec![NONE; count],
        }
    }
}

/// One method a stage: `wgsl/trace/NAME.wgsl` and `cpu/trace/NAME.rs` do the same.
pub trait Trace {
    /// The ray trees of a run of pixels, where this backend keeps them.
    type Paths;
    /// What can go wrong.
    type Error;

    /// The most pixels to have in hand at once.
    fn most_pixels(&self) -> u32;
    /// Loop turns that each pixel may take in the next slice.
    fn budget(&self) -> u32;
    /// Rounds of the three stages before the host looks at how far they are.
    fn rounds(&self) -> u32;

    /// Pixels with no sample yet.
    ///
    /// # Errors
    /// If there is no room for them.
    fn begin(&mut self, pixels: Range<u32>) -> Result<Self::Paths, Self::Error>;

    /// pixels -> primary rays
    ///
    /// # Errors
    /// If the stage cannot be started.
    fn cast(&mut self, paths: &mut Self::Paths, slice: &Slice) -> Result<(), Self::Error>;

    /// rays -> ray trees followed to their end, or for as long as the budget lasts
    ///
    /// # Errors
    /// If the stage cannot be started.
    fn follow(&mut self, paths: &mut Self::Paths, slice: &Slice) -> Result<(), Self::Error>;

    /// finished ray trees -> sums on the film
    ///
    /// # Errors
    /// If the stage cannot be started.
    fn gather(&mut self, paths: &mut Self::Paths, slice: &Slice) -> Result<(), Self::Error>;

    /// pixels of a scene of few primitives -> sums on the film: the three stages, for sample after sample
    ///
    /// # Errors
    /// If the stage cannot be started.
    fn few(&mut self, paths: &mut Self::Paths, slice: &Slice) -> Result<(), Self::Error>;

    /// Waits for the stages; how many pixels have got their last sample since the last call.
    ///
    /// # Errors
    /// If the work was not done, or not to its end.
    fn settle(&mut self, paths: &mut Self::Paths) -> Result<u32, Self::Error>;

    /// The pixels in host memory.
    ///
    /// # Errors
    /// If they cannot be read back.
    fn end(&mut self, paths: Self::Paths) -> Result<Paths, Self::Error>;

    /// After an error: prepares to do the same pixels again in smaller portions.
    ///
    /// # Errors
    /// The error itself, if there is no point in that.
    fn ease(&mut self, error: Self::Error) -> Result<(), Self::Error>;
}

/// One frame: every pixel, every sample. `progress` is told the fraction done.
///
/// # Errors
/// The backend's, once smaller portions no longer help.
pub fn frame<T: Trace>(stages: &mut T, tables: &Tables, progress: &mut dyn FnMut(f64)) -> Result<Film, T::Error> {
    let mut film = Film::new(tables.view.width, tables.view.height);
    let total = film.pixels();
    let mut first = 0;
    while first < total {
        let pixels = first..total.min(first + stages.most_pixels().max(1));
        let mut share = |part: f64| {
            progress((f64::from(pixels.start) + part * pixels.len() as f64) / f64::from(total));
        };
        match run(stages, tables, pixels.clone(), &mut share) {
            Ok(paths) => {
                film.put(pixels.start, &paths.sums, &paths.ids);
                first = pixels.end;
            }
            Err(error) => stages.ease(error)?,
        }
    }
    progress(1.0);
    Ok(film)
}

/// A run of pixels, from their first sample to their last.
fn run<T: Trace>(
    stages: &mut T,
    tables: &Tables,
    pixels: Range<u32>,
    progress: &mut dyn FnMut(f64),
) -> Result<Paths, T::Error> {
    let mut paths = stages.begin(pixels.clone())?;
    let mut done = 0;
    let mut rounds = 0_u32;
    while done < pixels.len() as u32 {
        let slice = Slice {
            first: pixels.start,
            count: pixels.len() as u32,
            samples: tables.samples,
            budget: stages.budget(),
        };
        for _ in 0..stages.rounds() {
            if tables.few {
                stages.few(&mut paths, &slice)?;
            } else {
                stages.cast(&mut paths, &slice)?;
                stages.follow(&mut paths, &slice)?;
                stages.gather(&mut paths, &slice)?;
            }
            rounds = rounds.saturating_add(1);
        }
        done += stages.settle(&mut paths)?;
        progress((f64::from(rounds) / f64::from(tables.samples)).min(0.99));
    }
    stages.end(paths)
}
