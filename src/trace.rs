//! What a traced frame is: the stages, and their order.
//!
//! ```text
//! pixels -> [cast -> follow -> gather] x rounds -> Film    (or steps in the place of follow, or few of all three)
//! ```
//!
//! A pixel's ray tree lives in a [`Path`](crate::tables::Path) and can be put down after any loop turn. So one round
//! of the three stages starts the pixels that are idle, follows every tree for as long as a budget of loop turns lasts,
//! and gathers the trees that are finished; rounds are repeated until every pixel has all its samples. Neither the
//! budget nor the number of pixels in hand can show in the picture.
//!
//! Samples are summed in blocks of [`BLOCK`], and the blocks' sums are added in order. So a frame that is stopped,
//! resumed, or made in parts on many machines ([`Part`]) has the bits of one that was made at once.

pub mod grow;
mod passes;
mod paths;

pub use passes::{Until, passes};
pub use paths::Paths;

use std::ops::{ControlFlow, Range};

use crate::film::{Band, Film, Run, Share, Watch, split};
use crate::tables::{Slice, Tables};

/// A method for each stage but lay, which is [`grow::Grow`]'s: `wgsl/trace/NAME.wgsl` and `cpu/trace/NAME.rs` do the
/// same.
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

    /// Pixels that have the samples of `run`, which are of one block or none, and get those up to `end`.
    ///
    /// # Errors
    /// If there is no room for them.
    fn begin(&mut self, run: &Run, end: u32) -> Result<Self::Paths, Self::Error>;

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

    /// rays -> ray trees that end at once, in the color of how many steps their walk takes
    ///
    /// # Errors
    /// If the stage cannot be started.
    fn steps(&mut self, paths: &mut Self::Paths, slice: &Slice) -> Result<(), Self::Error>;

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

/// Samples that are summed on their own before they are added to those before them.
pub const BLOCK: u32 = 64;

/// The part of a frame that is made: a rectangle of it, and of each pixel some samples.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Part {
    /// Columns from the left.
    pub columns: Range<u32>,
    /// Rows from the top.
    pub rows: Range<u32>,
    /// Samples; from a multiple of [`BLOCK`].
    pub samples: Range<u32>,
}

impl Part {
    /// All of a frame.
    #[must_use]
    pub fn whole(tables: &Tables) -> Self {
        Self { columns: 0..tables.view.width, rows: 0..tables.view.height, samples: 0..tables.samples }
    }

    /// Pixels that follow each other: rows that are wanted whole do, of others each is a run of its own.
    fn runs(&self, tables: &Tables) -> Vec<Range<u32>> {
        let width = tables.view.width;
        let row = |row: u32| row * width + self.columns.start..row * width + self.columns.end;
        if self.columns.len() as u32 == width {
            return std::iter::once(row(self.rows.start).start..row(self.rows.end).start).collect();
        }
        self.rows.clone().map(row).collect()
    }
}

/// One frame: every pixel, every sample. `watch` is told the fraction done, and may stop it.
///
/// # Errors
/// The backend's, once smaller portions no longer help.
pub fn frame<T: Trace>(stages: &mut T, tables: &Tables, watch: &mut dyn Watch) -> Result<Film, T::Error> {
    part(stages, tables, &Part::whole(tables), watch)
}

/// A part of a frame, so many rows at a time, from the top.
///
/// # Errors
/// The backend's, once smaller portions no longer help.
pub fn bands<T: Trace>(
    stages: &mut T,
    tables: &Tables,
    whole: &Part,
    height: u32,
    watch: &mut dyn Watch,
    each: &mut dyn FnMut(Band) -> ControlFlow<()>,
) -> Result<(), T::Error> {
    let all = whole.rows.len() as f64;
    for rows in split(&whole.rows, height) {
        let before = f64::from(rows.start - whole.rows.start) / all;
        let mut share = Share::new(watch, before, rows.len() as f64 / all);
        let film = part(stages, tables, &Part { rows: rows.clone(), ..whole.clone() }, &mut share)?;
        if share.stopped || each(Band { top: rows.start - whole.rows.start, film }).is_break() {
            return Ok(());
        }
    }
    Ok(())
}

/// A part of a frame, as a film of its rectangle.
///
/// # Errors
/// The backend's, once smaller portions no longer help.
pub fn part<T: Trace>(
    stages: &mut T,
    tables: &Tables,
    part: &Part,
    watch: &mut dyn Watch,
) -> Result<Film, T::Error> {
    let Part { columns, rows, samples } = part;
    let mut film = Film::new(columns.len() as u32, rows.len() as u32);
    let mut eased = false;
    let mut laid = 0;
    for Range { start, end } in part.runs(tables) {
        let mut first = start;
        while first < end {
            // What was kept before a failure is as long as what failed.
            let kept = if eased { None } else { watch.kept(first) };
            // Nor is what reaches beyond this part, which a try in other portions has kept.
            let kept = kept.filter(|run| run.pixels.end <= end);
            let most = stages.most_pixels().max(1);
            let run = kept.unwrap_or_else(|| Run::new(first..end.min(first + most), samples.start));
            let before = laid + (first - start);
            let all = f64::from(film.pixels());
            let (before_it, length_of_it) = (f64::from(before) / all, run.pixels.len() as f64 / all);
            let mut watch = Share::new(watch, before_it, length_of_it);
            match follow_up(stages, tables, run, samples.end, &mut watch) {
                Ok(Some(run)) => {
                    film.put(before, &run.sums, &run.ids);
                    film.put_squares(before, &run.squares);
                    first = run.pixels.end;
                    eased = false;
                }
                Ok(None) => return Ok(film),
                Err(error) => {
                    stages.ease(error)?;
                    eased = true;
                }
            }
        }
        laid += end - start;
    }
    let _ = watch.done(1.0);
    Ok(film)
}

/// A run of pixels up to sample `end`, block by block; nothing if it was stopped.
fn follow_up<T: Trace>(
    stages: &mut T,
    tables: &Tables,
    mut run: Run,
    end: u32,
    watch: &mut Share<'_>,
) -> Result<Option<Run>, T::Error> {
    let first = run.samples.start;
    while run.samples.end < end {
        let start = run.samples.end;
        let block = start..end.min((start / BLOCK + 1) * BLOCK);
        let mut within = |part: f64| {
            let done = f64::from(start - first) + part * block.len() as f64;
            watch.done(done / f64::from(end - first))
        };
        let empty = Run::new(run.pixels.clone(), block.start);
        let Some(paths) = self::block(stages, tables, &empty, block.end, &mut within)? else {
            return Ok(None);
        };
        run.add(block.end, &paths.sums, &paths.squares, &paths.ids);
        watch.keep(&run);
    }
    Ok(Some(run))
}

/// The samples of a block up to `end`, of pixels that have some of them; nothing if it was stopped.
fn block<T: Trace>(
    stages: &mut T,
    tables: &Tables,
    run: &Run,
    end: u32,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Option<Paths>, T::Error> {
    let (pixels, samples) = (run.pixels.clone(), run.samples.end..end);
    let mut paths = stages.begin(run, end)?;
    let mut done = 0;
    let mut rounds = 0_u32;
    while done < run.going() {
        rounds = rounds.saturating_add(stages.rounds());
        done += round(stages, tables, &mut paths, &pixels, samples.end)?;
        if progress((f64::from(rounds) / samples.len() as f64).min(0.99)).is_break() {
            return Ok(None);
        }
    }
    stages.end(paths).map(Some)
}

/// As many rounds of the stages as the backend wants at once; how many pixels have got their last sample.
fn round<T: Trace>(
    stages: &mut T,
    tables: &Tables,
    paths: &mut T::Paths,
    pixels: &Range<u32>,
    samples: u32,
) -> Result<u32, T::Error> {
    let slice = Slice { first: pixels.start, count: pixels.len() as u32, samples, budget: stages.budget() };
    for _ in 0..stages.rounds() {
        if tables.steps {
            stages.cast(paths, &slice)?;
            stages.steps(paths, &slice)?;
            stages.gather(paths, &slice)?;
        } else if tables.few {
            stages.few(paths, &slice)?;
        } else {
            stages.cast(paths, &slice)?;
            stages.follow(paths, &slice)?;
            stages.gather(paths, &slice)?;
        }
    }
    stages.settle(paths)
}
