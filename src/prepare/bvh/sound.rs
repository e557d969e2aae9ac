//! a tree from elsewhere -> whether a walk through it ends, and meets each box once

use super::{MOST_IN_LEAF, Tree};
use crate::tables::Node;

/// Whether all that a tree's nodes and order say is there, once, and as deep as it says.
pub(super) fn is_sound(tree: &Tree) -> bool {
    let mut left = Left { nodes: vec![true; tree.nodes.len()], leaves: vec![true; tree.order.len()] };
    let mut order = vec![true; tree.order.len()];
    let mut deep = 0;
    let mut ahead = vec![(0, 1)];
    while let Some((at, level)) = ahead.pop() {
        let Some(node) = take(&mut left.nodes, at).and_then(|()| tree.nodes.get(at)) else { return false };
        deep = deep.max(level);
        let Some(children) = left.children(node) else { return false };
        ahead.extend(children.into_iter().map(|child| (child, level + 1)));
    }
    let all = tree.order.iter().all(|&i| take(&mut order, i as usize).is_some());
    all && deep == tree.deep && left.nodes.iter().chain(&left.leaves).all(|left| !left)
}

/// Takes what is there still.
fn take(left: &mut [bool], at: usize) -> Option<()> {
    left.get_mut(at).is_some_and(std::mem::take).then_some(())
}

/// What no node has had yet.
struct Left {
    nodes: Vec<bool>,
    leaves: Vec<bool>,
}

impl Left {
    /// Takes a node's leaves, and says which nodes are its children; nothing if it has what it cannot have.
    fn children(&mut self, node: &Node) -> Option<Vec<usize>> {
        let mut children = Vec::new();
        let inner = node.steps >> 24;
        for place in 0..8 {
            let kind = (node.kinds[place / 4] >> (8 * (place % 4)) & 255) as usize;
            let is_node = kind == 1 << 5 | (24 + place);
            if is_node != (inner >> place & 1 == 1) {
                return None;
            }
            if is_node {
                children.push((node.children as usize).checked_add(children.len())?);
                continue;
            }
            let count = (kind >> 5).trailing_ones() as usize;
            let right = kind >> 5 == (1 << count) - 1 && count <= MOST_IN_LEAF && (count > 0 || kind == 0);
            let first = node.leaves as usize + kind % 32;
            if !right || (first..first + count).any(|i| take(&mut self.leaves, i).is_none()) {
                return None;
            }
        }
        Some(children)
    }
}
