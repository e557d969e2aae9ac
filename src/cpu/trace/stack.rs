//! a walk's nodes with children still to be asked -> the last of them, taken up again

#![expect(clippy::inline_always, reason = "see `aim`")]

use crate::tables::STACK_FULL;

/// A child that is a node, and no primitive.
pub const NODES: u32 = 0xff00_0000;

/// Instances that are still to be asked, in the place of children.
pub const INSTANCES: u32 = 0x8000_0000;

/// Whether there is anything left to ask.
#[inline(always)]
#[must_use]
pub fn is_open(group: [u32; 2]) -> bool {
    group[1] >= 1 << 24 || (group[0] >= INSTANCES && group[1] != 0)
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
