//! boxes -> a tree of nodes with up to eight children each
//!
//! ```text
//! boxes -> binary (split in two, and again) -> reinsert (large branches, to where they cost the least)
//!       -> collapse (which of these nodes to keep) -> grow (the kept ones, packed) -> Tree
//! ```
//!
//! Any tree will do whose boxes hold what lies below them: a walk finds the same primitive at the same distance, to
//! the bit, in every one.

mod binary;
mod binned;
mod bins;
mod collapse;
mod count;
mod grow;
mod halves;
mod kept;
mod pack;
mod reinsert;
mod sides;
mod sound;
mod split;
mod ways;

pub use binned::{Binned, Watched};
pub use halves::Halves;
pub use kept::{Kept, LEAST_KEPT};

use std::ops::ControlFlow;

use bytemuck::{Pod, Zeroable};
use glam::{Vec3, Vec4};

use crate::tables::Node;

/// The smallest box around something, whose sides are those of the world.
///
/// The fourth parts count for nothing: with them, three sides are one SIMD register.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct Bounds {
    /// The lower corner.
    pub low: Vec4,
    /// The upper corner.
    pub high: Vec4,
}

impl Bounds {
    /// Around nothing: any box joined with it is itself.
    pub const NOTHING: Self = Self { low: Vec4::INFINITY, high: Vec4::NEG_INFINITY };

    /// Around some points.
    pub fn around(points: impl IntoIterator<Item = Vec3>) -> Self {
        let grown = |b: Self, p: Vec3| Self { low: b.low.min(p.extend(0.0)), high: b.high.max(p.extend(0.0)) };
        points.into_iter().fold(Self::NOTHING, grown)
    }

    /// Around one point, whose fourth part may be anything.
    fn at(point: Vec4) -> Self {
        Self { low: point, high: point }
    }

    /// Around both.
    #[must_use]
    pub fn join(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Half its surface, in square units: what the number of rays that meet it is in proportion to.
    #[must_use]
    pub fn half_area(self) -> f32 {
        let size = self.high - self.low;
        size.x * size.y + size.y * size.z + size.z * size.x
    }

    /// The sum of its corners: twice its middle.
    fn middle(self) -> Vec4 {
        self.low + self.high
    }
}

/// Nodes over numbered boxes.
#[derive(Debug, Clone, PartialEq)]
pub struct Tree {
    /// The root is the first; there is always one.
    pub nodes: Vec<Node>,
    /// The boxes' numbers, as the nodes' leaves count them.
    pub order: Vec<u32>,
    /// Nodes on the longest way from the root down.
    pub deep: u32,
    /// Around all boxes.
    pub bounds: Bounds,
}

impl Tree {
    /// A node without children.
    fn empty() -> Self {
        Self { nodes: vec![Node::zeroed()], order: Vec::new(), deep: 1, bounds: Bounds::NOTHING }
    }
}

/// The most primitives that a child of a node may have.
pub const MOST_IN_LEAF: usize = 3;

/// Hears, on any thread, what share of the boxes is in leaves, and may stop the work: what comes of it then is of no use.
pub type Told<'a> = dyn Fn(f64) -> ControlFlow<()> + Sync + 'a;

/// One way to build a tree.
pub trait Builder {
    /// A tree over boxes, which are around something: no corner is NaN.
    fn build(&self, boxes: Vec<Bounds>) -> Tree;
}
