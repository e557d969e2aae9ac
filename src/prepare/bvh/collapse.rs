//! a tree of two children a node -> which of its nodes to keep, so that nodes of eight children cost the least
//!
//! Ylitie, Karras and Laine, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", HPG 2017, 3.1.

use super::binary::{Binary, Branch, Kind, TASK};
use super::ways::{AS_ONE, LARGE, LEAF, Ways};
use super::{Bounds, MOST_IN_LEAF};

/// What a primitive costs a walk, beside a node.
const PRIMITIVE: f32 = 0.3;

/// What one to seven roots cost at least; the eighth counts for nothing.
type Costs = [f32; 8];

/// Beyond any sum of costs.
const FAR: f32 = 1e38;

/// What is below a branch.
struct Below {
    costs: Costs,
    boxes: usize,
}

/// On so many levels branches are weighed as tasks of their own.
const TASKS: u32 = 8;

/// The ways that cost the least.
pub(super) fn collapse(tree: &Binary) -> Ways {
    let ways = Ways::new(tree);
    weigh(tree, tree.root, 0, &ways);
    ways
}

fn weigh(tree: &Binary, branch: Branch, level: u32, ways: &Ways) -> Below {
    match tree.kind(branch) {
        Kind::Box(item) => Below { costs: [PRIMITIVE * area(item.0); 8], boxes: 1 },
        Kind::Node(at, two) => {
            let left = || weigh(tree, two.left, level + 1, ways);
            let right = || weigh(tree, two.right, level + 1, ways);
            let (left, right) = if level < TASKS { rayon::join(left, right) } else { (left(), right()) };
            let (word, below) = weighed(area(two.bounds()), &left, &right);
            ways.say(at, word);
            below
        }
    }
}

/// So that no sum of them is infinite.
fn area(bounds: Bounds) -> f32 {
    let area = bounds.half_area();
    if area < 1e28 { area } else { 1e28 }
}

/// The cheapest ways of a node with such an area, and what is below it.
fn weighed(area: f32, left: &Below, right: &Below) -> (u32, Below) {
    let boxes = left.boxes + right.boxes;
    let leaf = PRIMITIVE * area * boxes as f32;
    if boxes == 2 {
        // As below, where there is not much to choose.
        let apart = left.costs[0] + right.costs[0];
        let (word, more) = if apart <= leaf { (AS_ONE, apart) } else { (LEAF, leaf) };
        let mut costs = [more; 8];
        costs[0] = leaf;
        return (word, Below { costs, boxes });
    }
    let parted = least(&left.costs, &right.costs);
    let (mut word, one) =
        if boxes <= MOST_IN_LEAF { (AS_ONE, leaf) } else { (parted[6].to_bits() & AS_ONE, area + parted[6]) };
    let mut costs = [one; 8];
    for (i, parted) in (1..7).zip(parted) {
        let is_better = parted <= one;
        word |= if is_better { parted.to_bits() & AS_ONE } else { AS_ONE } << (3 * i);
        costs[i] = if is_better { parted } else { one };
    }
    word |= if boxes > TASK { LARGE } else { 0 };
    (word, Below { costs, boxes })
}

/// What two to eight roots of two branches cost at least; how many of them, less one, are the left one's stands in the
/// last bits.
fn least(left: &Costs, right: &Costs) -> Costs {
    let mut shifted = [FAR; 16];
    shifted[8..].copy_from_slice(right);
    let mut least = [FAR; 8];
    for (k, left) in left.iter().enumerate().take(7) {
        for (least, right) in least.iter_mut().zip(&shifted[8 - k..]) {
            let cost = f32::from_bits((left + right).to_bits() & !AS_ONE | k as u32);
            *least = if cost < *least { cost } else { *least };
        }
    }
    least
}
