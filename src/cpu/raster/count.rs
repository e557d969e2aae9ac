//! pieces -> how many of them each tile has

use super::reach::each_tile;
use crate::tables::{Lens, Piece};

/// One number a tile.
#[must_use]
pub fn count(lens: &Lens, pieces: &[Piece]) -> Vec<u32> {
    let mut counts = vec![0; lens.tiles() as usize];
    for piece in pieces {
        each_tile(lens, piece, |tile| counts[tile] += 1);
    }
    counts
}
