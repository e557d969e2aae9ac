//! boxes -> a tree of two children a node: the one to read first, and to check the other by

use super::grow::{Grown, fill};
use super::split::{Item, Part};
use super::{Bounds, Builder, Tree};

/// The longest side is halved, so that there are as many boxes on its left as on its right.
#[derive(Debug, Clone, Copy, Default)]
pub struct Halves;

impl Builder for Halves {
    fn build(&self, boxes: Vec<Bounds>) -> Tree {
        let mut items: Vec<Item> = boxes.into_iter().zip(0..).map(|(b, i)| Item::new(b, i)).collect();
        let whole = Part::new(&items, 0..items.len());
        let bounds = whole.bounds;
        let mut grown = Grown::new();
        if !items.is_empty() {
            fill(&mut grown, 0, &mut items, whole, 0, &halves);
        }
        Tree { nodes: grown.nodes, order: grown.order, deep: grown.deep, bounds }
    }
}

fn halves(items: &mut [Item], whole: Part, _level: u32) -> Vec<Part> {
    if whole.is_leaf() {
        return vec![whole];
    }
    let size = whole.bounds.high - whole.bounds.low;
    let axis = (0..3).fold(0, |longest, axis| if size[axis] > size[longest] { axis } else { longest });
    items[whole.items.clone()].sort_by(|a, b| a.0.middle()[axis].total_cmp(&b.0.middle()[axis]));
    let middle = whole.items.start + whole.items.len() / 2;
    [whole.items.start..middle, middle..whole.items.end].map(|range| Part::new(items, range)).into()
}
