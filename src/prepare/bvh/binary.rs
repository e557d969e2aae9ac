//! boxes -> a tree of two children a node, down to single boxes
//!
//! A box takes 64 bytes here, until the wide nodes are made: its own 32, and as many for the node that parts it from the
//! next; and 4 more while these are weighed.

use glam::Vec3;

use super::Bounds;
use super::count::Count;
use super::split::{Halved, Item, Part};

/// A node, or a box, by its number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Branch(u32);

const BOX: u32 = 0x8000_0000;

/// What a branch is.
pub(super) enum Kind<'a> {
    Box(&'a Item),
    Node(usize, &'a Two),
}

/// A node: the box around its two branches, and these.
#[derive(Debug, Clone, Copy)]
pub(super) struct Two {
    low: Vec3,
    pub(super) left: Branch,
    high: Vec3,
    pub(super) right: Branch,
}

impl Two {
    const OPEN: Self = Self { low: Vec3::ZERO, left: Branch(0), high: Vec3::ZERO, right: Branch(0) };

    pub(super) fn bounds(&self) -> Bounds {
        Bounds { low: self.low.extend(0.0), high: self.high.extend(0.0) }
    }
}

/// A tree over at least one box.
pub(super) struct Binary {
    items: Vec<Item>,
    /// One less than boxes.
    pub(super) nodes: Vec<Two>,
    pub(super) root: Branch,
}

/// Parts with fewer boxes than this are not worth a task.
pub(super) const TASK: usize = 2048;

impl Binary {
    /// Grown by parting boxes in two; the number beside them is that of the level.
    pub(super) fn new<H>(boxes: Vec<Bounds>, halves: &H, count: &Count<'_>) -> Self
    where
        H: Fn(&mut [Item], &Part, u32) -> Halved + Sync,
    {
        let mut items: Vec<Item> = boxes.into_iter().zip(0..).map(|(b, i)| Item::new(b, i)).collect();
        let mut nodes = vec![Two::OPEN; items.len() - 1];
        let whole = Part::new(&items);
        let sprout = Sprout { items: &mut items, nodes: &mut nodes, item: 0, node: 0 };
        let root = sprout.branch();
        sprout.grow(&whole, 0, halves, count);
        Self { items, nodes, root }
    }

    pub(super) fn kind(&self, branch: Branch) -> Kind<'_> {
        let at = (branch.0 & !BOX) as usize;
        if branch.0 & BOX == 0 { Kind::Node(at, &self.nodes[at]) } else { Kind::Box(&self.items[at]) }
    }

    /// Gives a node other branches.
    pub(super) fn set(&mut self, node: Branch, bounds: Bounds, [left, right]: [Branch; 2]) {
        let Bounds { low, high } = bounds;
        self.nodes[node.0 as usize] = Two { low: low.truncate(), left, high: high.truncate(), right };
    }

    pub(super) fn bounds(&self, branch: Branch) -> Bounds {
        match self.kind(branch) {
            Kind::Box(item) => item.0,
            Kind::Node(_, two) => two.bounds(),
        }
    }
}

/// Some boxes, room for the nodes over them, and the numbers of the first of both.
struct Sprout<'a> {
    items: &'a mut [Item],
    nodes: &'a mut [Two],
    item: u32,
    node: u32,
}

impl Sprout<'_> {
    fn branch(&self) -> Branch {
        Branch(if self.nodes.is_empty() { BOX | self.item } else { self.node })
    }

    /// Large parts as tasks of their own.
    fn grow<H>(mut self, part: &Part, level: u32, halves: &H, count: &Count<'_>)
    where
        H: Fn(&mut [Item], &Part, u32) -> Halved + Sync,
    {
        if count.is_over() {
            return;
        }
        let boxes = self.items.len();
        if boxes <= TASK {
            self.fill(part, level, halves);
            count.add(boxes);
        } else if let Some([(left, left_part), (right, right_part)]) = self.fork(part, level, halves) {
            rayon::join(
                || left.grow(&left_part, level + 1, halves, count),
                || right.grow(&right_part, level + 1, halves, count),
            );
        }
    }

    fn fill<H>(&mut self, part: &Part, level: u32, halves: &H)
    where
        H: Fn(&mut [Item], &Part, u32) -> Halved,
    {
        let Some([(mut left, left_part), (mut right, right_part)]) = self.fork(part, level, halves) else { return };
        // A single box is not worth the call.
        if !left.nodes.is_empty() {
            left.fill(&left_part, level + 1, halves);
        }
        if !right.nodes.is_empty() {
            right.fill(&right_part, level + 1, halves);
        }
    }

    /// Parts the boxes; a node stands before its left branch, and that before its right one.
    fn fork<H>(&mut self, part: &Part, level: u32, halves: &H) -> Option<[(Sprout<'_>, Part); 2]>
    where
        H: Fn(&mut [Item], &Part, u32) -> Halved,
    {
        let (two, nodes) = self.nodes.split_first_mut()?;
        let Halved { left: count, parts: [left_part, right_part] } = halves(self.items, part, level);
        let (left, right) = self.items.split_at_mut(count);
        let (left_nodes, right_nodes) = nodes.split_at_mut(count - 1);
        let left = Sprout { items: left, nodes: left_nodes, item: self.item, node: self.node + 1 };
        let [item, node] = [self.item, self.node].map(|first| first + count as u32);
        let right = Sprout { items: right, nodes: right_nodes, item, node };
        let Bounds { low, high } = part.bounds;
        *two = Two { low: low.truncate(), left: left.branch(), high: high.truncate(), right: right.branch() };
        Some([(left, left_part), (right, right_part)])
    }
}
