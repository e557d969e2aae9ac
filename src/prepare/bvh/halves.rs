//! boxes -> a tree of two children a node: the one to read first, and to check the other by

use std::ops::ControlFlow;

use super::binary::{Binary, Branch, Kind};
use super::count::Count;
use super::split::{Halved, Item, Part};
use super::ways::{AS_ONE, LEAF, Ways};
use super::{Bounds, Builder, MOST_IN_LEAF, Tree, grow};

/// The longest side is halved, so that there are as many boxes on its left as on its right.
#[derive(Debug, Clone, Copy, Default)]
pub struct Halves;

impl Builder for Halves {
    fn build(&self, boxes: Vec<Bounds>) -> Tree {
        if boxes.is_empty() {
            return Tree::empty();
        }
        let count = Count::new(&|_| ControlFlow::Continue(()), boxes.len());
        let binary = Binary::new(boxes, &halves, &count);
        let ways = Ways::new(&binary);
        keep(&binary, binary.root, &ways);
        grow::tree(&binary, &ways)
    }
}

fn halves(items: &mut [Item], whole: &Part, _level: u32) -> Halved {
    let size = whole.bounds.high - whole.bounds.low;
    let axis = (0..3).fold(0, |longest, axis| if size[axis] > size[longest] { axis } else { longest });
    items.sort_by(|a, b| a.0.middle()[axis].total_cmp(&b.0.middle()[axis]));
    Halved::at(items.len() / 2, items)
}

/// Keeps all nodes but those of leaves; says how many boxes are below.
fn keep(tree: &Binary, branch: Branch, ways: &Ways) -> usize {
    let Kind::Node(at, two) = tree.kind(branch) else { return 1 };
    let boxes = keep(tree, two.left, ways) + keep(tree, two.right, ways);
    if boxes > MOST_IN_LEAF {
        // One root from the left branch, and the right one is better one root than seven.
        ways.say(at, LEAF & !AS_ONE);
    }
    boxes
}
