//! image -> of each cell of 8 x 8 pixels the farthest

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use crate::tables::{CELL, Lens};

/// One cell.
#[must_use]
pub fn far(lens: &Lens, nears: &[AtomicU32], cell: u32) -> u32 {
    let across = lens.cells()[1];
    let last = [lens.width - 1, lens.height - 1];
    let [x, y] = [(cell % across * CELL).min(last[0]), (cell / across * CELL).min(last[1])];
    let rows = y..=(y + CELL - 1).min(last[1]);
    let pixels = rows.flat_map(|y| (x..=(x + CELL - 1).min(last[0])).map(move |x| lens.first + y * lens.width + x));
    pixels.map(|pixel| nears[pixel as usize].load(Relaxed)).min().unwrap_or(0)
}
