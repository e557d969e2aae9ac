//! a tree from elsewhere -> whether a walk through it ends, and meets each box once

use bytemuck::Zeroable as _;

use super::Tree;
use super::pack::in_octants;
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
    // Between nodes lie places of none.
    let none = tree.nodes.iter().zip(&left.nodes).all(|(node, left)| !left || *node == Node::zeroed());
    all && deep == tree.deep && none && left.leaves.iter().all(|left| !left)
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
        let within = node.children as usize <= self.nodes.len() && node.leaves as usize <= self.leaves.len();
        if !within || node.inner != in_octants(node.inner & 255) || node.held >> 24 != 0 {
            return None;
        }
        let (mut children, mut leaves) = (Vec::new(), node.leaves as usize);
        for place in 0..8 {
            let held = node.held >> (3 * place) & 7;
            let count = held.trailing_ones();
            let is_node = node.inner >> place & 1 == 1;
            if held >> count != 0 || (is_node && held != 0) {
                return None;
            }
            if is_node {
                children.push((node.children as usize).checked_add(place)?);
            }
            for _ in 0..count {
                take(&mut self.leaves, leaves)?;
                leaves += 1;
            }
        }
        Some(children)
    }
}
