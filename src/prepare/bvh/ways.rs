//! a node of two children -> the eight that it has in the end, by what was found best

use std::sync::atomic::{AtomicU32, Ordering};

use super::Bounds;
use super::binary::{Binary, Branch, Kind};

/// How each node is best made one to seven roots of smaller trees: a word with three bits for each number of roots.
///
/// The first are for one root, which is a leaf (all bits), or else a wide node: these bits are how many of its eight
/// children, less one, come from the left branch. The others say the same of as many roots; all bits: one is better.
pub(super) struct Ways(Vec<AtomicU32>);

pub(super) const AS_ONE: u32 = 7;
/// There are more boxes below than a task has.
pub(super) const LARGE: u32 = 1 << 31;
/// One root, and a leaf.
pub(super) const LEAF: u32 = !LARGE;

/// A child of a node.
pub(super) struct Child {
    pub(super) branch: Branch,
    pub(super) bounds: Bounds,
    /// How many boxes a leaf has; none: it is a node.
    pub(super) boxes: u8,
}

impl Child {
    pub(super) fn is_leaf(&self) -> bool {
        self.boxes > 0
    }
}

impl Ways {
    /// Of nodes which are leaves, all of them, until more is said.
    pub(super) fn new(tree: &Binary) -> Self {
        Self(tree.nodes.iter().map(|_| AtomicU32::new(LEAF)).collect())
    }

    pub(super) fn say(&self, at: usize, word: u32) {
        self.0[at].store(word, Ordering::Relaxed);
    }

    fn word(&self, at: usize) -> u32 {
        self.0[at].load(Ordering::Relaxed)
    }

    /// Whether a branch is worth a task.
    pub(super) fn is_large(&self, tree: &Binary, branch: Branch) -> bool {
        matches!(tree.kind(branch), Kind::Node(at, _) if self.word(at) & LARGE != 0)
    }

    /// At most eight; a leaf is its own child.
    pub(super) fn children(&self, tree: &Binary, branch: Branch) -> Vec<Child> {
        let mut children = Vec::with_capacity(8);
        match tree.kind(branch) {
            Kind::Node(at, two) if self.left(at, 0) != AS_ONE => {
                let left = self.left(at, 0);
                self.roots(tree, two.left, left, &mut children);
                self.roots(tree, two.right, 6 - left, &mut children);
            }
            _ => self.roots(tree, branch, 0, &mut children),
        }
        children
    }

    fn left(&self, at: usize, more: u32) -> u32 {
        self.word(at) >> (3 * more) & AS_ONE
    }

    /// One root of a branch, or up to so many more.
    fn roots(&self, tree: &Binary, branch: Branch, more: u32, children: &mut Vec<Child>) {
        let (at, two) = match tree.kind(branch) {
            Kind::Box(item) => return children.push(Child { branch, bounds: item.0, boxes: 1 }),
            Kind::Node(at, two) => (at, two),
        };
        let left = self.left(at, more);
        if more > 0 && left != AS_ONE {
            self.roots(tree, two.left, left, children);
            self.roots(tree, two.right, more - 1 - left, children);
            return;
        }
        let is_box = |branch| matches!(tree.kind(branch), Kind::Box(_));
        let boxes = match self.left(at, 0) {
            AS_ONE if is_box(two.left) && is_box(two.right) => 2,
            AS_ONE => 3,
            _ => 0,
        };
        children.push(Child { branch, bounds: two.bounds(), boxes });
    }
}
