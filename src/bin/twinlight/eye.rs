//! a frame in the making -> progress, the runs that are kept of it, and whether to go on

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use twinlight::film::ledger::Ledger;
use twinlight::film::{Run, Watch};

use crate::progress::Progress;
use crate::stop::Stop;

/// What a process that is killed may lose.
const EVERY: Duration = Duration::from_secs(2);
/// Bytes that wait to be kept: of a large picture much is made within that time.
const MOST_WAITING: usize = 64 << 20;

/// Looks on while a frame is made.
pub(crate) struct Eye<'a> {
    stop: &'a Stop,
    progress: &'a mut Progress,
    number: usize,
    count: usize,
    /// Where runs are kept for a later try.
    pub(crate) ledger: Option<Ledger>,
    flushed: Instant,
    /// All runs, where they are wanted.
    pub(crate) runs: Option<Vec<Run>>,
}

impl<'a> Eye<'a> {
    /// For picture `number` of `count`.
    pub(crate) fn new(stop: &'a Stop, progress: &'a mut Progress, number: usize, count: usize) -> Self {
        Self { stop, progress, number, count, ledger: None, flushed: Instant::now(), runs: None }
    }

    /// Writes what is kept; a folder that refuses costs no picture.
    pub(crate) fn flush(&mut self) {
        self.flushed = Instant::now();
        if let Some(Err(error)) = self.ledger.as_mut().map(Ledger::flush) {
            self.progress.say(&format!("warning: what is done cannot be kept for a later try: {error}"));
            self.ledger.take().into_iter().for_each(Ledger::forget);
        }
    }
}

impl Watch for Eye<'_> {
    fn done(&mut self, fraction: f64) -> ControlFlow<()> {
        self.progress.done((self.number as f64 + fraction) / self.count as f64);
        if self.flushed.elapsed() > EVERY {
            self.flush();
        }
        if self.stop.why().is_some() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    fn kept(&mut self, first: u32) -> Option<Run> {
        self.ledger.as_mut()?.kept(first)
    }

    fn keep(&mut self, run: &Run) {
        if let Some(runs) = &mut self.runs {
            runs.push(run.clone());
        }
        if let Some(ledger) = &mut self.ledger {
            ledger.keep(run);
            if ledger.waiting() > MOST_WAITING {
                self.flush();
            }
        }
    }
}
