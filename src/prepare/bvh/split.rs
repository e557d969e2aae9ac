//! the boxes of a node -> its children, by the surface area heuristic

use std::ops::Range;

use rayon::prelude::*;

use super::bins::best;
use super::{Bounds, MOST_IN_LEAF, sides};

/// A box; its number stands in the bits of the fourth part of `low`, below those of a 2: subnormal numbers are slow.
#[derive(Debug, Clone, Copy)]
pub(super) struct Item(pub(super) Bounds);

const TWO: u32 = 0x4000_0000;

impl Item {
    pub(super) fn new(bounds: Bounds, number: u32) -> Self {
        Self(Bounds { low: bounds.low.truncate().extend(f32::from_bits(TWO | number)), high: bounds.high })
    }

    pub(super) fn number(&self) -> u32 {
        self.0.low.w.to_bits() ^ TWO
    }
}

/// Parts of at least two times so many items are worked at in chunks by all cores; what comes of that is the same with
/// any number of them.
pub(super) const CHUNK: usize = 1 << 12;

/// Some of a node's boxes, next to each other.
#[derive(Debug, Clone)]
pub(super) struct Part {
    /// Which items.
    pub(super) items: Range<usize>,
    /// Around all of them.
    pub(super) bounds: Bounds,
    /// Around twice their middles.
    middles: Bounds,
}

impl Part {
    pub(super) fn new(items: &[Item], range: Range<usize>) -> Self {
        let nothing = (Bounds::NOTHING, Bounds::NOTHING);
        let add = |(bounds, middles): (Bounds, Bounds), item: &Item| {
            (bounds.join(item.0), middles.join(Bounds::at(item.0.middle())))
        };
        let own = &items[range.clone()];
        let (bounds, middles) = if own.len() < 2 * CHUNK {
            own.iter().fold(nothing, add)
        } else {
            let chunks = own.par_chunks(CHUNK).map(|own| own.iter().fold(nothing, add));
            chunks.reduce(|| nothing, |a, b| (a.0.join(b.0), a.1.join(b.1)))
        };
        Self { items: range, bounds, middles }
    }

    /// The same part of its own items alone.
    pub(super) fn alone(&self) -> Self {
        Self { items: 0..self.items.len(), ..self.clone() }
    }

    pub(super) fn is_leaf(&self) -> bool {
        self.items.len() <= MOST_IN_LEAF
    }
}

/// Beyond so many levels parts are halved, so that no input makes a tree that is much deeper.
const STEEP: u32 = 24;
const CHILDREN: usize = 8;

/// Sorts the items of a part into at most eight.
pub(super) fn children(items: &mut [Item], whole: Part, level: u32) -> Vec<Part> {
    if whole.items.len() <= CHILDREN {
        let alone = |i: usize| Part { items: i..i + 1, bounds: items[i].0, middles: Bounds::NOTHING };
        return whole.items.map(alone).collect();
    }
    let mut parts = Vec::with_capacity(CHILDREN);
    let mut areas = [whole.bounds.half_area(); CHILDREN];
    parts.push(whole);
    while parts.len() < CHILDREN {
        // What is left as a leaf costs no node: it is split only where there is room to spare.
        let largest = |least: usize| {
            let open = parts.iter().zip(areas).enumerate().filter(|(_, (part, _))| part.items.len() > least);
            open.max_by(|a, b| a.1.1.total_cmp(&b.1.1)).map(|(i, _)| i)
        };
        let Some(i) = largest(MOST_IN_LEAF).or_else(|| largest(1)) else { break };
        let (left, right) = halves(items, &parts[i], level >= STEEP);
        (areas[i], areas[parts.len()]) = (left.bounds.half_area(), right.bounds.half_area());
        parts[i] = left;
        parts.push(right);
    }
    parts
}

fn halves(items: &mut [Item], part: &Part, steep: bool) -> (Part, Part) {
    let Range { start, end } = part.items;
    if end - start <= FEW && !steep {
        return few(items, part);
    }
    let plane = if steep { None } else { best(&items[start..end], part.middles) };
    let Some(plane) = plane else {
        let middle = start.midpoint(end);
        return (Part::new(items, start..middle), Part::new(items, middle..end));
    };
    let sides = sides::sort(&mut items[start..end], &plane);
    let middle = start + sides.left;
    let [left, right] = plane.bounds;
    let [left_middles, right_middles] = sides.middles;
    (
        Part { items: start..middle, bounds: left, middles: left_middles },
        Part { items: middle..end, bounds: right, middles: right_middles },
    )
}

/// Parts of so few boxes are sorted instead.
const FEW: usize = 8;

/// The cheapest place to part a few boxes at, along the axis on which their middles lie widest apart.
fn few(items: &mut [Item], part: &Part) -> (Part, Part) {
    let Range { start, end } = part.items;
    let size = part.middles.high - part.middles.low;
    let axis = if size.x >= size.y && size.x >= size.z { 0 } else { 1 + usize::from(size.z > size.y) };
    let own = &mut items[start..end];
    // By insertion: what is equal stays in its order.
    for i in 1..own.len() {
        let mut j = i;
        while j > 0 && own[j].0.middle()[axis] < own[j - 1].0.middle()[axis] {
            own.swap(j, j - 1);
            j -= 1;
        }
    }
    let mut right = [Bounds::NOTHING; FEW + 1];
    for (i, item) in own.iter().enumerate().rev() {
        right[i] = right[i + 1].join(item.0);
    }
    let mut left = Bounds::NOTHING;
    let mut least = f32::INFINITY;
    let mut middle = start.midpoint(end);
    for (i, item) in own.iter().enumerate().take(own.len() - 1) {
        left = left.join(item.0);
        let cost = left.half_area() * (i + 1) as f32 + right[i + 1].half_area() * (own.len() - i - 1) as f32;
        if cost < least {
            least = cost;
            middle = start + i + 1;
        }
    }
    (Part::new(items, start..middle), Part::new(items, middle..end))
}
