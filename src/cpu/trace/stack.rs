//! a walk's nodes with children still to be asked -> the last of them, taken up again

#![expect(clippy::inline_always, reason = "see `aim`")]

use crate::tables::STACK_FULL;

/// Instances that are still to be asked, in the place of children.
pub const INSTANCES: u32 = 0x8000_0000;

/// The children of a node that are still to be asked, or instances.
#[derive(Debug, Clone, Copy)]
pub struct Group {
    /// Where the node's places begin; or the primitives among which the instances are, with [`INSTANCES`].
    pub begin: u32,
    /// A bit for each child that is still to be asked, at `place ^ octant`; or for each instance.
    pub left: u32,
}

impl Group {
    /// Nothing.
    pub const NONE: Self = Self { begin: 0, left: 0 };

    /// A root, the only child of nothing, in place 0.
    #[inline(always)]
    #[must_use]
    pub fn root(node: u32, octant: u32) -> Self {
        Self { begin: node, left: 1 << octant }
    }

    /// Whether there is anything left to ask.
    #[inline(always)]
    #[must_use]
    pub fn is_open(self) -> bool {
        self.left != 0
    }
}

/// Keeps what is left of a group for later; how much is on the stack then. It holds `room` groups.
#[inline(always)]
#[must_use]
pub fn put(stack: &mut [[u32; 2]], room: usize, group: Group, size: usize, flags: &mut u32) -> usize {
    if !group.is_open() {
        return size;
    }
    if size >= room {
        *flags |= STACK_FULL;
        return size;
    }
    stack[size] = [group.begin, group.left];
    size + 1
}
