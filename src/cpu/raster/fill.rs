//! pieces -> the lists of each tile, in any order

use super::reach::each_list;
use crate::tables::{Lens, Piece};

/// All lists, one after the other, of numbers of pieces.
#[must_use]
pub fn fill(lens: &Lens, pieces: &[Piece], starts: &[u32], entries: u32) -> Vec<u32> {
    let mut next = starts.to_vec();
    let mut lists = vec![0; entries as usize];
    for (piece, i) in pieces.iter().zip(0..) {
        each_list(lens, piece, |list| {
            lists[next[list] as usize] = i;
            next[list] += 1;
        });
    }
    lists
}
