//! pixels -> primary rays

use crate::cpu::trace::primary::{primary, seed};
use crate::tables::{IDLE, Path, Slice, View};

/// Starts pixel `i` of the slice on its next sample, if it has one and is idle.
pub fn cast(view: &View, slice: &Slice, i: u32, path: &mut Path) {
    if path.state == IDLE && path.sample < slice.samples {
        *path = seed(view, path.sample, primary(view, slice.first + i, path.sample));
    }
}
