//! a node's children -> their boxes in bytes, each in the place from which rays find the near ones first

use glam::Vec4;

use super::Bounds;
use super::split::Part;
use crate::tables::Node;

/// Children in their places.
pub(super) type Places<'a> = [Option<&'a Part>; 8];

/// Gives child after child the place whose direction it lies farthest along: the greedy way of Ylitie et al., 3.2.
///
/// Place 7 lies towards +x +y +z. A ray asks the places in the order of `place ^ octant`.
pub(super) fn places<'a>(parts: &'a [Part], whole: Bounds) -> Places<'a> {
    let mut costs: Vec<(f32, usize, usize)> = Vec::with_capacity(64);
    for (i, part) in parts.iter().enumerate() {
        let from_middle = part.bounds.middle() - whole.middle();
        for place in 0..8 {
            let side = |bit: usize, x: f32| if place & bit == 0 { x } else { -x };
            let [x, y, z, _] = from_middle.to_array();
            costs.push((side(4, x) + side(2, y) + side(1, z), i, place));
        }
    }
    costs.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let mut taken: Places<'a> = [None; 8];
    let mut placed = [false; 8];
    for (_, i, place) in costs {
        if taken[place].is_none() && !placed[i] {
            taken[place] = Some(&parts[i]);
            placed[i] = true;
        }
    }
    taken
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
        ..bytemuck::Zeroable::zeroed()
    };
    let mut leaves = 0;
    for (i, part) in places.iter().enumerate() {
        let Some(part) = part else { continue };
        let low = ((part.bounds.low - whole.low) / step).floor().to_array().map(|q| q as u8);
        let high = ((part.bounds.high - whole.low) / step).ceil().to_array().map(|q| q as u8);
        let (word, shift) = (i / 4, 8 * (i % 4));
        let put = |to: &mut [u32; 2], byte: u8| to[word] |= u32::from(byte) << shift;
        put(&mut node.low_x, low[0]);
        put(&mut node.low_y, low[1]);
        put(&mut node.low_z, low[2]);
        put(&mut node.high_x, high[0]);
        put(&mut node.high_y, high[1]);
        put(&mut node.high_z, high[2]);
        if part.is_leaf() {
            let count = part.items.len() as u8;
            put(&mut node.kinds, ((1 << count) - 1) << 5 | leaves);
            leaves += count;
        } else {
            put(&mut node.kinds, 1 << 5 | (24 + i as u8));
            node.steps |= 1 << (24 + i);
        }
    }
    node
}
