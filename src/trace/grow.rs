//! What a frame is that somebody looks at while it is made: all pixels get a sample, then all of them more.
//!
//! ```text
//! pixels -> [[cast -> follow -> gather] x rounds, run by run -> lay] x passes -> sums
//! ```
//!
//! The blocks of samples are those of a frame that is made at once, so the last picture has its bits.

use std::ops::Range;

use super::{BLOCK, Trace, round};
use crate::tables::Tables;

/// One that keeps the sums of a whole film between passes.
pub trait Grow: Trace {
    /// The sums of the blocks before the one in hand, those of the one in hand, and both together.
    type Sums;

    /// Sums of so many pixels, all of them zero.
    ///
    /// # Errors
    /// If there is no room.
    fn sums(&mut self, pixels: u32) -> Result<Self::Sums, Self::Error>;

    /// A run of pixels whose sums go on from where the film's are.
    ///
    /// # Errors
    /// If there is no room.
    fn resume(
        &mut self,
        sums: &Self::Sums,
        pixels: Range<u32>,
        samples: Range<u32>,
    ) -> Result<Self::Paths, Self::Error>;

    /// Puts a finished run's sums onto the film.
    ///
    /// # Errors
    /// If it cannot be done.
    fn keep(&mut self, paths: Self::Paths, sums: &mut Self::Sums) -> Result<(), Self::Error>;

    /// the sums of a block and of those before it -> all sums
    ///
    /// # Errors
    /// If the stage cannot be done.
    fn lay(&mut self, sums: &mut Self::Sums) -> Result<(), Self::Error>;

    /// All sums are those before the next block.
    fn turn(&mut self, sums: &mut Self::Sums);
}

/// A frame in the making.
#[derive(Debug)]
pub struct Growth<P, S> {
    sums: S,
    pixels: u32,
    /// Samples that all pixels have.
    has: u32,
    /// Samples that it ends with.
    target: u32,
    /// The first pixel that is not as far as this pass goes.
    next: u32,
    /// The run in hand: its end, its paths, and how many of its pixels are done.
    run: Option<(u32, P, u32)>,
}

impl<P, S> Growth<P, S> {
    /// A film without light, on its way to so many samples a pixel.
    ///
    /// # Errors
    /// If there is no room for it.
    pub fn new<T: Grow<Paths = P, Sums = S>>(stages: &mut T, pixels: u32, target: u32) -> Result<Self, T::Error> {
        Ok(Self { sums: stages.sums(pixels)?, pixels, has: 0, target, next: 0, run: None })
    }

    /// Samples that all pixels have.
    #[must_use]
    pub fn has(&self) -> u32 {
        self.has
    }

    /// Whether it has all its samples.
    #[must_use]
    pub fn done(&self) -> bool {
        self.has >= self.target
    }

    /// What the pixels' samples add up to.
    #[must_use]
    pub fn sums(&self) -> &S {
        &self.sums
    }

    /// As many samples as there are, and as many more again; one at first, and no further than to the end of a block.
    fn goal(&self) -> u32 {
        (2 * self.has).max(1).min((self.has / BLOCK + 1) * BLOCK).min(self.target)
    }

    /// One slice of work; whether all pixels have got more samples with it.
    ///
    /// # Errors
    /// The backend's, once smaller portions no longer help.
    pub fn step<T>(&mut self, stages: &mut T, tables: &Tables) -> Result<bool, T::Error>
    where
        T: Grow<Paths = P, Sums = S>,
    {
        if self.done() {
            return Ok(false);
        }
        let done = self.advance(stages, tables);
        done.or_else(|error| {
            // What is in hand is begun anew.
            self.run = None;
            stages.ease(error).map(|()| false)
        })
    }

    fn advance<T>(&mut self, stages: &mut T, tables: &Tables) -> Result<bool, T::Error>
    where
        T: Grow<Paths = P, Sums = S>,
    {
        let goal = self.goal();
        let (end, mut paths, mut done) = if let Some(run) = self.run.take() {
            run
        } else {
            let end = self.pixels.min(self.next.saturating_add(stages.most_pixels().max(1)));
            (end, stages.resume(&self.sums, self.next..end, self.has..goal)?, 0)
        };
        let pixels = self.next..end;
        done += round(stages, tables, &mut paths, &pixels, goal)?;
        if done < pixels.len() as u32 {
            self.run = Some((end, paths, done));
            return Ok(false);
        }
        stages.keep(paths, &mut self.sums)?;
        self.next = end;
        if end < self.pixels {
            return Ok(false);
        }
        stages.lay(&mut self.sums)?;
        (self.has, self.next) = (goal, 0);
        if goal.is_multiple_of(BLOCK) {
            stages.turn(&mut self.sums);
        }
        Ok(true)
    }
}
