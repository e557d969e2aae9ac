//! a walk's nodes with children still to be asked -> the last of them, taken up again

#![expect(clippy::inline_always, reason = "see `aim`")]

use crate::tables::STACK_FULL;

/// Instances that are still to be asked, in the place of children.
pub const INSTANCES: u32 = 0x8000_0000;

/// Whether there is anything left to ask.
#[inline(always)]
#[must_use]
pub fn is_open(group: [u32; 2]) -> bool {
    group[1] >= 1 << 24 || (group[0] >= INSTANCES && group[1] != 0)
}

/// Of each set of places the one that is asked first: whose `place ^ octant` is the highest.
const FIRST: [[u8; 256]; 8] = {
    let mut all = [[0; 256]; 8];
    let mut i = 0;
    // In the order of `place ^ octant`, so that the last one stays.
    while i < 8 * 256 * 8 {
        let (octant, set, place) = (i >> 11, i >> 3 & 255, (i & 7) ^ (i >> 11));
        if set >> place & 1 == 1 {
            all[octant][set] = place as u8;
        }
        i += 1;
    }
    all
};

/// The place of the child that is asked first, of a group of nodes.
#[inline(always)]
#[must_use]
pub fn first_of(group: [u32; 2], octant: u32) -> u32 {
    u32::from(FIRST[octant as usize % 8][(group[1] >> 24) as usize])
}

/// Keeps what is left of a group for later; how much is on the stack then. It holds `room` groups.
#[inline(always)]
#[must_use]
pub fn put(stack: &mut [[u32; 2]], room: usize, group: [u32; 2], size: usize, flags: &mut u32) -> usize {
    if !is_open(group) {
        return size;
    }
    if size >= room {
        *flags |= STACK_FULL;
        return size;
    }
    stack[size] = group;
    size + 1
}
