//! pixels of a scene of few primitives -> sums on the film: cast, follow and gather for sample after sample

use crate::cpu::trace::cast::cast;
use crate::cpu::trace::follow::step;
use crate::cpu::trace::gather::gather;
use crate::tables::{Path, SEEK, Slice, Status, Tables, Waiting};

/// Renders pixel `i` of the slice, or as much of it as the budget allows: one turn for each sample and each ray.
pub fn few(
    tables: &Tables,
    slice: &Slice,
    i: u32,
    path: &mut Path,
    waiting: &mut [Waiting],
    film: (&mut [f32; 4], &mut u32),
    status: &mut Status,
) {
    let (sum, id) = film;
    let mut turns = 0;
    while path.sample < slice.samples && turns < slice.budget {
        turns += 1;
        cast(&tables.view, slice, i, path);
        while path.state == SEEK && turns < slice.budget {
            turns += 1;
            step(tables, slice, i, path, waiting, status);
        }
        status.pixels += gather(slice, path, sum, id);
    }
    status.turns = status.turns.max(turns);
}
