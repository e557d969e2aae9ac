//! boxes -> all nodes, the children of each next to each other

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use rayon::prelude::*;

use super::pack::{Places, pack, places};
use super::split::{Item, Part, children};
use super::{Bounds, Builder, Told, Tree};
use crate::tables::Node;

/// The surface area heuristic in bins, eight children at once, over all cores. The tree does not depend on how many.
#[derive(Debug, Clone, Copy, Default)]
pub struct Binned;

/// The same tree, for who waits for it.
#[derive(Clone, Copy)]
pub struct Watched<'a>(pub &'a Told<'a>);

/// Parts with fewer boxes than this are not worth a task.
const TASK: usize = 2048;

impl Builder for Binned {
    fn build(&self, boxes: Vec<Bounds>) -> Tree {
        Watched(&|_| ControlFlow::Continue(())).build(boxes)
    }
}

impl Builder for Watched<'_> {
    fn build(&self, boxes: Vec<Bounds>) -> Tree {
        let mut items: Vec<Item> = boxes.into_iter().zip(0..).map(|(b, i)| Item::new(b, i)).collect();
        let count =
            Count { told: self.0, all: items.len(), done: AtomicUsize::new(0), over: AtomicBool::new(false) };
        let whole = Part::new(&items, 0..items.len());
        // Without a number in it.
        let bounds = Bounds { low: whole.bounds.low.truncate().extend(0.0), ..whole.bounds };
        let grown = if items.is_empty() { Grown::new() } else { grow(&mut items, whole, 0, &count) };
        Tree { nodes: grown.nodes, order: grown.order, deep: grown.deep, bounds }
    }
}

/// Boxes that are in leaves.
struct Count<'a> {
    told: &'a Told<'a>,
    all: usize,
    done: AtomicUsize,
    over: AtomicBool,
}

impl Count<'_> {
    fn add(&self, more: usize) {
        let done = self.done.fetch_add(more, Ordering::Relaxed) + more;
        if more > 0 && (self.told)(done as f64 / self.all as f64).is_break() {
            self.over.store(true, Ordering::Relaxed);
        }
    }
}

/// A node, the first, and all that lies below it.
pub(super) struct Grown {
    pub(super) nodes: Vec<Node>,
    pub(super) order: Vec<u32>,
    pub(super) deep: u32,
}

impl Grown {
    /// A node without children.
    pub(super) fn new() -> Self {
        Self { nodes: vec![bytemuck::Zeroable::zeroed()], order: Vec::new(), deep: 1 }
    }
}

/// How the items of a node are shared among its children, at a level of the tree.
type Split = dyn Fn(&mut [Item], Part, u32) -> Vec<Part>;

/// Grows a part: large children as tasks of their own, whose nodes are put together afterwards.
fn grow(items: &mut [Item], whole: Part, level: u32, count: &Count<'_>) -> Grown {
    let mut grown = Grown::new();
    if count.over.load(Ordering::Relaxed) {
        return grown;
    }
    if whole.items.len() <= TASK {
        fill(&mut grown, 0, items, whole, level, &children);
        count.add(items.len());
        return grown;
    }
    let bounds = whole.bounds;
    let parts = children(items, whole, level);
    let places = places(&parts, bounds);
    grown.nodes[0] = begin(&mut grown, &places, bounds, items);
    count.add(grown.order.len());
    let mut tasks: Vec<(usize, &Part, &mut [Item])> = Vec::new();
    let mut in_order: Vec<(usize, &Part)> =
        places.iter().enumerate().filter_map(|(i, part)| Some((i, (*part)?))).collect();
    in_order.sort_by_key(|(_, part)| part.items.start);
    let mut rest = items;
    for (i, part) in in_order {
        let (own, after) = rest.split_at_mut(part.items.len());
        rest = after;
        if !part.is_leaf() {
            tasks.push((i, part, own));
        }
    }
    tasks.sort_by_key(|(i, ..)| *i);
    let below: Vec<Grown> =
        tasks.into_par_iter().map(|(_, part, items)| grow(items, part.alone(), level + 1, count)).collect();
    for (below, child) in below.into_iter().zip(1..) {
        let (first_node, first_leaf) = (grown.nodes.len() as u32 - 1, grown.order.len() as u32);
        let moved =
            |node: &Node| Node { children: node.children + first_node, leaves: node.leaves + first_leaf, ..*node };
        let mut nodes = below.nodes.iter().map(moved);
        grown.nodes[child] = nodes.next().unwrap_or_else(bytemuck::Zeroable::zeroed);
        grown.nodes.extend(nodes);
        grown.order.extend(below.order);
        grown.deep = grown.deep.max(1 + below.deep);
    }
    grown
}

/// Grows a part at a node that has its place already.
pub(super) fn fill(
    grown: &mut Grown,
    at: usize,
    items: &mut [Item],
    whole: Part,
    level: u32,
    split: &Split,
) -> u32 {
    let bounds = whole.bounds;
    let parts = split(items, whole, level);
    let places = places(&parts, bounds);
    let first = grown.nodes.len();
    grown.nodes[at] = begin(grown, &places, bounds, items);
    let inner = places.iter().flatten().filter(|part| !part.is_leaf());
    let mut deep = 0;
    for (part, child) in inner.zip(first..) {
        deep = deep.max(fill(grown, child, items, (*part).clone(), level + 1, split));
    }
    grown.deep = grown.deep.max(deep + 1);
    deep + 1
}

/// A node, with room for its children and its leaves in their order.
fn begin(grown: &mut Grown, places: &Places<'_>, bounds: Bounds, items: &[Item]) -> Node {
    let node = pack(places, bounds, grown.nodes.len() as u32, grown.order.len() as u32);
    for part in places.iter().flatten() {
        if part.is_leaf() {
            grown.order.extend(items[part.items.clone()].iter().map(Item::number));
        } else {
            grown.nodes.push(bytemuck::Zeroable::zeroed());
        }
    }
    node
}
