//! a film in the making -> how far it is, what is kept of it, and whether to go on

use std::ops::{ControlFlow, Range};

/// A run of pixels with the sums of some of their samples.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// Which pixels, counted along rows from the top left.
    pub pixels: Range<u32>,
    /// Which samples are in the sums.
    pub samples: Range<u32>,
    /// Red, green, blue and the number of samples in the sum.
    pub sums: Vec<[f32; 4]>,
    /// Of the samples' luminances, summed.
    pub squares: Vec<f32>,
    /// What the first ray of sample 0 met.
    pub ids: Vec<u32>,
    /// Pixels that get no more samples; empty if all do.
    pub ended: Vec<bool>,
}

impl Run {
    /// Pixels without light, before sample `first`.
    #[must_use]
    pub fn new(pixels: Range<u32>, first: u32) -> Self {
        let count = pixels.len();
        let (sums, ids) = (vec![[0.0; 4]; count], vec![crate::tables::NONE; count]);
        Self { pixels, samples: first..first, sums, squares: vec![0.0; count], ids, ended: Vec::new() }
    }

    /// Adds the sums of the samples up to `end`.
    pub fn add(&mut self, end: u32, sums: &[[f32; 4]], squares: &[f32], ids: &[u32]) {
        for (sum, more) in self.sums.iter_mut().zip(sums) {
            for (sum, more) in sum.iter_mut().zip(more) {
                *sum += more;
            }
        }
        for (square, more) in self.squares.iter_mut().zip(squares) {
            *square += more;
        }
        if self.samples.start == 0 && self.samples.is_empty() {
            self.ids.copy_from_slice(ids);
        }
        self.samples.end = end;
    }

    /// Whether a pixel, counted from its first, gets no more samples.
    #[must_use]
    pub fn has_ended(&self, pixel: usize) -> bool {
        self.ended.get(pixel).is_some_and(|ended| *ended)
    }

    /// How many of its pixels get more samples.
    #[must_use]
    pub fn going(&self) -> u32 {
        (0..self.sums.len()).filter(|&pixel| !self.has_ended(pixel)).count() as u32
    }

    /// Some of its pixels, counted from its first.
    #[must_use]
    pub fn cut(&self, range: Range<u32>) -> Self {
        let within = range.start as usize..range.end as usize;
        Self {
            pixels: self.pixels.start + range.start..self.pixels.start + range.end,
            samples: self.samples.clone(),
            sums: self.sums[within.clone()].to_vec(),
            squares: self.squares[within.clone()].to_vec(),
            ids: self.ids[within.clone()].to_vec(),
            ended: self.ended.get(within).unwrap_or_default().to_vec(),
        }
    }
}

/// Whoever waits for a film: any `FnMut(f64)` that is told the fraction done is one who waits to the end.
pub trait Watch {
    /// Told the fraction done; says whether to go on. A film that was stopped is returned as far as it is.
    fn done(&mut self, fraction: f64) -> ControlFlow<()>;

    /// What an earlier try has kept of the pixels from `first` on.
    fn kept(&mut self, first: u32) -> Option<Run> {
        let _ = first;
        None
    }

    /// Offered each run of pixels as it grows.
    fn keep(&mut self, run: &Run) {
        let _ = run;
    }
}

impl<F: FnMut(f64)> Watch for F {
    fn done(&mut self, fraction: f64) -> ControlFlow<()> {
        self(fraction);
        ControlFlow::Continue(())
    }
}

/// One who watches the whole, seen from a part of it.
pub struct Share<'a> {
    watch: &'a mut dyn Watch,
    /// The fraction of the whole that is before the part, and the part's own.
    before: f64,
    length: f64,
    /// Whether the whole was stopped here.
    pub stopped: bool,
}

impl<'a> Share<'a> {
    /// A part that begins at one fraction of the whole and is so long.
    pub fn new(watch: &'a mut dyn Watch, before: f64, length: f64) -> Self {
        Self { watch, before, length, stopped: false }
    }
}

impl Watch for Share<'_> {
    fn done(&mut self, fraction: f64) -> ControlFlow<()> {
        let flow = self.watch.done(self.before + fraction * self.length);
        // What is done cannot be stopped any more.
        self.stopped |= flow.is_break() && fraction < 1.0;
        flow
    }

    fn kept(&mut self, first: u32) -> Option<Run> {
        self.watch.kept(first)
    }

    fn keep(&mut self, run: &Run) {
        self.watch.keep(run);
    }
}
