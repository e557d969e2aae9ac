//! pieces -> the list of each tile, in any order

use super::reach::each_tile;
use crate::tables::{Lens, Piece};

/// All lists, one after the other, of numbers of pieces.
#[must_use]
pub fn fill(lens: &Lens, pieces: &[Piece], starts: &[u32], entries: u32) -> Vec<u32> {
    let mut next = starts.to_vec();
    let mut lists = vec![0; entries as usize];
    for (piece, i) in pieces.iter().zip(0..) {
        each_tile(lens, piece, |tile| {
            lists[next[tile] as usize] = i;
            next[tile] += 1;
        });
    }
    lists
}
