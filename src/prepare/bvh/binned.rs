//! boxes -> their tree

use std::ops::ControlFlow;

use super::binary::Binary;
use super::collapse::collapse;
use super::count::Count;
use super::reinsert::reinsert;
use super::split::halves;
use super::{Bounds, Builder, Told, Tree, grow};

/// The surface area heuristic in bins, then the cheapest eight children a node, over all cores. The tree does not
/// depend on how many.
#[derive(Debug, Clone, Copy, Default)]
pub struct Binned;

/// The same tree, for who waits for it.
#[derive(Clone, Copy)]
pub struct Watched<'a>(pub &'a Told<'a>);

impl Builder for Binned {
    fn build(&self, boxes: Vec<Bounds>) -> Tree {
        Watched(&|_| ControlFlow::Continue(())).build(boxes)
    }
}

impl Builder for Watched<'_> {
    fn build(&self, boxes: Vec<Bounds>) -> Tree {
        if boxes.is_empty() {
            return Tree::empty();
        }
        let count = Count::new(self.0, boxes.len());
        let mut binary = Binary::new(boxes, &halves, &count);
        if count.is_over() {
            return Tree::empty();
        }
        reinsert(&mut binary);
        grow::tree(&binary, &collapse(&binary))
    }
}
