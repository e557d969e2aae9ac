//! how many pieces each tile has -> where its list begins

use crate::tables::Tally;

/// The sums of all counts before each, with their total and the largest of them in the tally.
#[must_use]
pub fn scan(counts: &[u32], tally: &mut Tally) -> Vec<u32> {
    let mut sum = 0;
    let starts = counts.iter().map(|&count| {
        let start = sum;
        sum += count;
        tally.longest = tally.longest.max(count);
        start
    });
    let starts = starts.collect();
    tally.entries = sum;
    starts
}
