//! boxes that have found their place -> what is told of them, and whether to go on

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use super::Told;

/// Boxes that have found their place.
pub(super) struct Count<'a> {
    told: &'a Told<'a>,
    all: usize,
    done: AtomicUsize,
    over: AtomicBool,
}

impl<'a> Count<'a> {
    pub(super) fn new(told: &'a Told<'a>, all: usize) -> Self {
        Self { told, all, done: AtomicUsize::new(0), over: AtomicBool::new(false) }
    }

    pub(super) fn add(&self, more: usize) {
        let done = self.done.fetch_add(more, Ordering::Relaxed) + more;
        if (self.told)(done as f64 / self.all as f64).is_break() {
            self.over.store(true, Ordering::Relaxed);
        }
    }

    /// Whether what is made is of no use any more.
    pub(super) fn is_over(&self) -> bool {
        self.over.load(Ordering::Relaxed)
    }
}
