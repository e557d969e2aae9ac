//! how many pieces each list has -> where it begins, and the tiles that have any

use crate::tables::Tally;

/// The sums of all counts before each and of all together, and the tiles; the tally gets what it counts of them.
#[must_use]
pub fn scan(counts: &[u32], tally: &mut Tally) -> (Vec<u32>, Vec<u32>) {
    let mut starts = vec![0];
    for count in counts {
        tally.entries += count;
        tally.longest = tally.longest.max(*count);
        starts.push(tally.entries);
    }
    let tiles = counts.chunks_exact(2).zip(0..);
    let busy: Vec<_> = tiles.filter(|(lists, _)| lists.iter().any(|n| *n > 0)).map(|(_, tile)| tile).collect();
    tally.busy = busy.len() as u32;
    (starts, busy)
}
