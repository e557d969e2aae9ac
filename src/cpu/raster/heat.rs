//! how many faces each tile has -> the color of its pixels

use crate::cpu::shade::scale::heat_of;
use crate::tables::{Lens, TILE};

/// Adds a sample to one pixel; the counts are two a tile.
pub fn heat(lens: &Lens, counts: &[u32], pixel: u32, sum: &mut [f32; 4]) {
    let (column, row) = (pixel % lens.width / TILE, pixel / lens.width / TILE);
    let at = 2 * (row * lens.columns + column) as usize;
    let heat = heat_of(counts[at] + counts[at + 1]);
    for (sum, part) in sum.iter_mut().zip([heat.x, heat.y, heat.z, 1.0]) {
        *sum += part;
    }
}
