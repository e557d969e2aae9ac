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
pub(super) fn area(bounds: Bounds) -> f32 {
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

#[cfg(test)]
pub(super) mod tests {
    use std::ops::ControlFlow;

    use glam::Vec3;

    use super::*;
    use crate::math::random::{pcg4d, unit_float};
    use crate::prepare::bvh::count::Count;
    use crate::prepare::bvh::split::{Halved, Item, Part};

    /// So many boxes of all sizes, parted anywhere.
    pub(in crate::prepare::bvh) fn random(number: u32, boxes: u32) -> Binary {
        let one = |i: u32| {
            let [a, b, c, d] = pcg4d([number, i, 0, 0]).map(unit_float);
            let low = Vec3::new(a, b, c);
            Bounds::around([low, low + Vec3::new(d * d, a * d, 0.1 * b)])
        };
        let count = Count::new(&|_| ControlFlow::Continue(()), boxes as usize);
        let anywhere = |items: &mut [Item], _: &Part, level: u32| {
            let dice = pcg4d([number, items.len() as u32, level, 1])[0] as usize;
            Halved::at(1 + dice % (items.len() - 1), items)
        };
        Binary::new((0..boxes).map(one).collect(), &anywhere, &count)
    }

    fn boxes(tree: &Binary, branch: Branch) -> usize {
        match tree.kind(branch) {
            Kind::Box(_) => 1,
            Kind::Node(_, two) => boxes(tree, two.left) + boxes(tree, two.right),
        }
    }

    fn leaf(tree: &Binary, branch: Branch) -> f32 {
        PRIMITIVE * area(tree.bounds(branch)) * boxes(tree, branch) as f32
    }

    /// Every way to make a branch one to eight roots.
    fn forests(tree: &Binary, branch: Branch) -> Vec<Vec<Branch>> {
        let mut all = vec![vec![branch]];
        if let Kind::Node(_, two) = tree.kind(branch) {
            let (left, right) = (forests(tree, two.left), forests(tree, two.right));
            all.extend(left.iter().flat_map(|l| right.iter().map(|r| [&l[..], r].concat())));
        }
        all.retain(|roots| roots.len() <= 8);
        all
    }

    /// What a branch costs at least as one root: each forest below it tried.
    fn cheapest(tree: &Binary, branch: Branch) -> f32 {
        let few = boxes(tree, branch) <= MOST_IN_LEAF;
        let all = forests(tree, branch).into_iter().filter(|roots| roots.len() > 1);
        let node = |roots: Vec<Branch>| {
            area(tree.bounds(branch)) + roots.into_iter().map(|root| cheapest(tree, root)).sum::<f32>()
        };
        all.map(node).fold(if few { leaf(tree, branch) } else { FAR }, f32::min)
    }

    /// What it costs as it is kept.
    fn kept(tree: &Binary, ways: &Ways, branch: Branch) -> f32 {
        let children = ways.children(tree, branch);
        assert!(children.len() <= 8);
        let below = |child: &super::super::ways::Child| {
            assert!(usize::from(child.boxes) <= MOST_IN_LEAF);
            if child.is_leaf() { leaf(tree, child.branch) } else { kept(tree, ways, child.branch) }
        };
        area(tree.bounds(branch)) + children.iter().map(below).sum::<f32>()
    }

    #[test]
    fn no_other_nodes_cost_less() {
        for number in 0..400 {
            let tree = random(number, 4 + number % 11);
            let (kept, best) = (kept(&tree, &collapse(&tree), tree.root), cheapest(&tree, tree.root));
            // Three bits of each sum hold what was chosen.
            assert!(kept <= best * 1.00001, "tree {number}: {kept} where {best} is the least");
        }
    }
}
