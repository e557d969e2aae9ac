//! a tree of two children a node -> all nodes, the children of each as far from each other as their places are

use bytemuck::Zeroable as _;
use rayon::prelude::*;

use super::binary::{Binary, Branch, Kind};
use super::pack::{self, Places, pack, places};
use super::ways::Ways;
use super::{Bounds, Tree};
use crate::tables::Node;

/// A node, the first, and, from the ninth on, all that lies below it.
struct Grown {
    nodes: Vec<Node>,
    order: Vec<u32>,
    deep: u32,
}

/// A root has eight places to itself, so that children never begin before the first node.
const BELOW: usize = 8;

/// The tree of those nodes that are to be kept.
pub(super) fn tree(binary: &Binary, ways: &Ways) -> Tree {
    let Bounds { low, high } = binary.bounds(binary.root);
    // Without a number in it.
    let bounds = Bounds { low: low.truncate().extend(0.0), high: high.truncate().extend(0.0) };
    let Grown { nodes, order, deep } = grow(binary, ways, binary.root);
    Tree { nodes, order, deep, bounds }
}

/// Grows a node: large children as tasks of their own, whose nodes are put together afterwards.
fn grow(binary: &Binary, ways: &Ways, branch: Branch) -> Grown {
    let mut grown = Grown { nodes: vec![Node::zeroed(); BELOW], order: Vec::new(), deep: 1 };
    if !ways.is_large(binary, branch) {
        fill(&mut grown, 0, binary, ways, branch);
        return grown;
    }
    let children = ways.children(binary, branch);
    let places = places(&children, binary.bounds(branch));
    grown.nodes[0] = begin(&mut grown, &places, binary, branch);
    let inner: Vec<(usize, Branch)> = inner(&grown.nodes[0], &places).collect();
    let below: Vec<_> = inner.into_par_iter().map(|(at, branch)| (at, grow(binary, ways, branch))).collect();
    for (at, below) in below {
        let (first_node, first_leaf) = ((grown.nodes.len() - BELOW) as u32, grown.order.len() as u32);
        let moved = |node: &Node| match node.inner | node.held {
            // A place of none.
            0 => *node,
            _ => Node { children: node.children + first_node, leaves: node.leaves + first_leaf, ..*node },
        };
        let mut nodes = below.nodes.iter().map(moved);
        grown.nodes[at] = nodes.next().unwrap_or_else(Node::zeroed);
        grown.nodes.extend(nodes.skip(BELOW - 1));
        grown.order.extend(below.order);
        grown.deep = grown.deep.max(1 + below.deep);
    }
    grown
}

/// Grows a node that has its place already; says how many are on the longest way down.
fn fill(grown: &mut Grown, at: usize, binary: &Binary, ways: &Ways, branch: Branch) -> u32 {
    let children = ways.children(binary, branch);
    let places = places(&children, binary.bounds(branch));
    let node = begin(grown, &places, binary, branch);
    grown.nodes[at] = node;
    let mut deep = 0;
    for (child, branch) in inner(&node, &places) {
        deep = deep.max(fill(grown, child, binary, ways, branch));
    }
    grown.deep = grown.deep.max(deep + 1);
    deep + 1
}

/// A node, with room for its children and its leaves in their order.
fn begin(grown: &mut Grown, places: &Places<'_>, binary: &Binary, branch: Branch) -> Node {
    let inner = pack::inner(places);
    let [first, end] = [inner.trailing_zeros() % 32, u32::BITS - inner.leading_zeros()];
    let children = grown.nodes.len() as u32 - first;
    let node = pack(places, binary.bounds(branch), children, grown.order.len() as u32);
    grown.nodes.resize((children + end) as usize, Node::zeroed());
    for child in places.iter().flatten().filter(|child| child.is_leaf()) {
        leaf(grown, binary, child.branch);
    }
    node
}

fn leaf(grown: &mut Grown, binary: &Binary, branch: Branch) {
    match binary.kind(branch) {
        Kind::Box(item) => grown.order.push(item.number()),
        Kind::Node(_, two) => [two.left, two.right].into_iter().for_each(|branch| leaf(grown, binary, branch)),
    }
}

/// The children that are nodes, and where they stand.
fn inner(node: &Node, places: &Places<'_>) -> impl Iterator<Item = (usize, Branch)> {
    let children = places.iter().zip(node.children as usize..);
    children.filter_map(|(child, at)| child.filter(|child| !child.is_leaf()).map(|child| (at, child.branch)))
}
