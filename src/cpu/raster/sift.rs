//! ids -> the runs of pixels that show a face, and those that show none

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use rayon::prelude::*;

use crate::tables::GROUP;

/// A run is so many pixels as a workgroup has lanes; both lists are in order.
#[must_use]
pub fn sift(ids: &[AtomicU32]) -> [Vec<u32>; 2] {
    let shows = |run: &[AtomicU32]| run.iter().any(|id| id.load(Relaxed) != 0);
    let (shown, bare): (Vec<_>, Vec<_>) =
        ids.par_chunks(GROUP as usize).map(shows).zip(0_u32..u32::MAX).partition(|(shows, _)| *shows);
    [shown, bare].map(|runs| runs.into_iter().map(|(_, run)| run).collect())
}
