//! a node's children -> their boxes in bytes, each in the place from which rays find the near ones first

use glam::Vec4;

use super::Bounds;
use super::ways::Child;
use crate::tables::Node;

/// Children in their places.
pub(super) type Places<'a> = [Option<&'a Child>; 8];

/// Gives child after child the place whose direction it lies farthest along: the greedy way of Ylitie et al., 3.2.
///
/// Place 7 lies towards +x +y +z. A ray asks the places in the order of `place ^ octant`.
pub(super) fn places<'a>(children: &'a [Child], whole: Bounds) -> Places<'a> {
    // How far a child lies from the middle, against the direction of each place; the pair's number is in the last bits.
    let mut costs = [[f32::INFINITY; 8]; 8];
    for ((child, costs), i) in children.iter().zip(&mut costs).zip(0..) {
        let [x, y, z, _] = (child.bounds.middle() - whole.middle()).to_array();
        for (cost, place) in costs.iter_mut().zip(0..) {
            let side = |bit: u32, x: f32| if place & bit == 0 { x } else { -x };
            let far = side(4, x) + side(2, y) + side(1, z);
            // What is not a number is far, too.
            let far = if far < FAR { far.max(-FAR) } else { FAR };
            *cost = f32::from_bits(far.to_bits() & !63 | i << 3 | place);
        }
    }
    let mut taken: Places<'a> = [None; 8];
    let mut open = [0.0; 8];
    for _ in children {
        let mut least = [f32::INFINITY; 8];
        for costs in &costs[..children.len()] {
            least = std::array::from_fn(|place| lesser(least[place], costs[place]));
        }
        let least = std::array::from_fn::<_, 8, _>(|place| least[place] + open[place]);
        // In pairs, none of which waits for another.
        let four: [f32; 4] = std::array::from_fn(|i| lesser(least[i], least[i + 4]));
        let pair = lesser(lesser(four[0], four[2]), lesser(four[1], four[3])).to_bits();
        let [i, place] = [pair >> 3, pair].map(|bits| bits as usize % 8);
        taken[place] = Some(&children[i]);
        open[place] = f32::INFINITY;
        costs[i] = [f32::INFINITY; 8];
    }
    taken
}

/// Less than infinite, in the sum with an open place's nothing too.
const FAR: f32 = 1e38;

/// One instruction, other than `f32::min`, which minds what is not a number.
fn lesser(a: f32, b: f32) -> f32 {
    if b < a { b } else { a }
}

/// A bit for each place that has a node.
pub(super) fn inner(places: &Places<'_>) -> u32 {
    (0..8).filter(|&i| places[i].is_some_and(|child| !child.is_leaf())).map(|i| 1 << i).sum()
}

/// A set of places as rays of the first four octants have it, a byte each, at `place ^ octant`.
pub(super) fn in_octants(set: u32) -> u32 {
    let turned = |octant: u32| (0..8).map(|place| (set >> place & 1) << (place ^ octant)).sum::<u32>();
    (0..4).map(|octant| turned(octant) << (8 * octant)).sum()
}

/// The node; its children and leaves are counted from the numbers given.
///
/// A box grows outwards to whole steps. What rounding may still take off it is less than a walk adds: see `aim`.
pub(super) fn pack(places: &Places<'_>, whole: Bounds, first_child: u32, first_leaf: u32) -> Node {
    // The least power of two of which 255 reach across: the biased exponent, rounded up.
    let steps = ((whole.high - whole.low) / 255.0).to_array().map(|step| {
        let exponent = (step.to_bits() + 0x007f_ffff) >> 23;
        exponent.clamp(1, 254)
    });
    let [x, y, z, _] = steps.map(|e| f32::from_bits(e << 23));
    let step = Vec4::new(x, y, z, 1.0);
    let mut node = Node {
        corner: whole.low.truncate(),
        steps: steps[0] | steps[1] << 8 | steps[2] << 16,
        children: first_child,
        leaves: first_leaf,
        inner: in_octants(inner(places)),
        ..bytemuck::Zeroable::zeroed()
    };
    for (i, child) in places.iter().enumerate() {
        let Some(child) = child else { continue };
        let low = ((child.bounds.low - whole.low) / step).floor().to_array().map(|q| q as u8);
        let high = ((child.bounds.high - whole.low) / step).ceil().to_array().map(|q| q as u8);
        let (word, shift) = (i / 4, 8 * (i % 4));
        let put = |to: &mut [u32; 2], byte: u8| to[word] |= u32::from(byte) << shift;
        put(&mut node.low_x, low[0]);
        put(&mut node.low_y, low[1]);
        put(&mut node.low_z, low[2]);
        put(&mut node.high_x, high[0]);
        put(&mut node.high_y, high[1]);
        put(&mut node.high_z, high[2]);
        if child.is_leaf() {
            node.held |= ((1 << child.boxes) - 1) << (3 * i);
        }
    }
    node
}
