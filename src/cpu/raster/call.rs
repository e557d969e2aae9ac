//! what is counted -> how many workgroups the stages have that work on it

use crate::tables::{GROUP, Tally};

/// More in one dimension are not valid.
const MOST_GROUPS: u32 = 65_535;

fn fold(groups: u32) -> [u32; 4] {
    [groups.min(MOST_GROUPS), groups.div_ceil(MOST_GROUPS), 1, 0]
}

/// Columns and rows of workgroups, 1, and nothing: for cut of whole faces and of torn ones, for count and fill, for cover, for shade and
/// ground.
///
/// `room` is that of the faces' list and of the pieces'. A list without room has torn faces among the whole ones: nothing
/// is cut of it.
#[must_use]
pub fn call(tally: &Tally, room: [u32; 2]) -> [[u32; 4]; 6] {
    let fits = tally.late.iter().sum::<u32>() <= room[0];
    let [whole, torn] = tally.late.map(|faces| fold(if fits { faces.div_ceil(GROUP) } else { 0 }));
    [
        whole,
        torn,
        fold(tally.pieces.min(room[1]).div_ceil(GROUP)),
        fold(tally.busy),
        fold(tally.shown),
        fold(tally.bare),
    ]
}
