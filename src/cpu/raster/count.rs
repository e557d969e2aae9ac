//! pieces -> how many of them each list has

use super::reach::each_list;
use crate::tables::{Lens, Piece};

/// Two numbers a tile.
#[must_use]
pub fn count(lens: &Lens, pieces: &[Piece]) -> Vec<u32> {
    let mut counts = vec![0; 2 * lens.tiles() as usize];
    for piece in pieces {
        each_list(lens, piece, |list| counts[list] += 1);
    }
    counts
}
