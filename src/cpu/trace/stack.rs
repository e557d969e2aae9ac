//! a walk's nodes with children still to be asked -> the last of them, taken up again

#![expect(clippy::inline_always, reason = "see `aim`")]

use crate::tables::STACK_FULL;

/// Instances that are still to be asked, in the place of children.
pub const INSTANCES: u32 = 0x8000_0000;

/// The children of a node that are still to be asked, or instances.
#[derive(Debug, Clone, Copy)]
pub struct Group {
    /// Where all of the node's children begin; or the primitives among which the instances are, with [`INSTANCES`].
    pub begin: u32,
    /// A bit for each child that is still to be asked.
    pub left: u32,
    /// A bit for each child that is a node; or for each instance that is still to be asked.
    pub nodes: u32,
}

impl Group {
    /// Nothing.
    pub const NONE: Self = Self { begin: 0, left: 0, nodes: 0 };

    /// A root, the only child of nothing.
    #[inline(always)]
    #[must_use]
    pub fn root(node: u32) -> Self {
        Self { begin: node, left: 0x80, nodes: 0 }
    }

    /// As a stack has it.
    #[inline(always)]
    #[must_use]
    pub fn of([begin, bits]: [u32; 2]) -> Self {
        Self { begin, left: bits >> 24, nodes: bits & 0x00ff_ffff }
    }

    /// Whether there is anything left to ask.
    #[inline(always)]
    #[must_use]
    pub fn is_open(self) -> bool {
        self.left != 0 || (self.begin >= INSTANCES && self.nodes != 0)
    }

    /// The place of the child that is asked first, of a group of nodes.
    #[inline(always)]
    #[must_use]
    pub fn first(self, octant: u32) -> u32 {
        u32::from(FIRST[octant as usize % 8][self.left as usize % 256])
    }
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
    stack[size] = [group.begin, group.left << 24 | group.nodes];
    size + 1
}
