//! how many faces each tile has -> the color of its pixels

use crate::tables::{Lens, TILE};

/// None, 1, 2 and 3, and so on: each begins at twice the number of the one before, and the last has no end.
pub const HEATS: [[f32; 3]; 12] = [
    [0.0, 0.0, 0.0],
    [0.01, 0.01, 0.06],
    [0.02, 0.03, 0.2],
    [0.03, 0.1, 0.5],
    [0.02, 0.3, 0.6],
    [0.02, 0.45, 0.3],
    [0.15, 0.6, 0.05],
    [0.6, 0.7, 0.02],
    [0.9, 0.45, 0.02],
    [0.9, 0.15, 0.02],
    [0.7, 0.02, 0.15],
    [1.0, 0.75, 0.9],
];

/// Adds a sample to one pixel; the counts are two a tile.
pub fn heat(lens: &Lens, counts: &[u32], pixel: u32, sum: &mut [f32; 4]) {
    let (column, row) = (pixel % lens.width / TILE, pixel / lens.width / TILE);
    let at = 2 * (row * lens.columns + column) as usize;
    let doublings = 32 - (counts[at] + counts[at + 1]).leading_zeros();
    let [red, green, blue] = HEATS[doublings.min(11) as usize];
    for (sum, part) in sum.iter_mut().zip([red, green, blue, 1.0]) {
        *sum += part;
    }
}
