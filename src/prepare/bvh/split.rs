//! the boxes of a part -> those of two parts, by the surface area heuristic

use rayon::prelude::*;

use super::bins::best;
use super::{Bounds, sides};

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

/// What some boxes, next to each other, lie in.
#[derive(Debug, Clone, Copy)]
pub(super) struct Part {
    /// Around all of them.
    pub(super) bounds: Bounds,
    /// Around twice their middles.
    pub(super) middles: Bounds,
}

impl Part {
    const NOTHING: Self = Self { bounds: Bounds::NOTHING, middles: Bounds::NOTHING };

    pub(super) fn new(items: &[Item]) -> Self {
        let some = |items: &[Item]| items.iter().fold(Self::NOTHING, Self::with);
        if items.len() < 2 * CHUNK {
            return some(items);
        }
        items.par_chunks(CHUNK).map(some).reduce(|| Self::NOTHING, Self::join)
    }

    fn with(self, item: &Item) -> Self {
        self.join(Self { bounds: item.0, middles: Bounds::at(item.0.middle()) })
    }

    fn join(self, other: Self) -> Self {
        Self { bounds: self.bounds.join(other.bounds), middles: self.middles.join(other.middles) }
    }
}

/// How many boxes are left, the first in their order now, and where they and the others lie.
pub(super) struct Halved {
    pub(super) left: usize,
    pub(super) parts: [Part; 2],
}

impl Halved {
    pub(super) fn at(left: usize, items: &[Item]) -> Self {
        Self { left, parts: [Part::new(&items[..left]), Part::new(&items[left..])] }
    }
}

/// Beyond so many levels parts are halved, so that no input makes a tree that is much deeper.
pub(super) const STEEP: u32 = 48;

/// Sorts the items of a part, of which there are two at least, into two.
pub(super) fn halves(items: &mut [Item], part: &Part, level: u32) -> Halved {
    if level >= STEEP {
        return Halved::at(items.len() / 2, items);
    }
    if items.len() <= FEW {
        return few(items);
    }
    let Some(plane) = best(items, part.middles) else { return Halved::at(items.len() / 2, items) };
    let sides = sides::sort(items, &plane);
    let [left, right] = [0, 1].map(|side| Part { bounds: plane.bounds[side], middles: sides.middles[side] });
    Halved { left: sides.left, parts: [left, right] }
}

/// Parts of so few boxes are sorted instead.
const FEW: usize = 12;

/// The cheapest place to part a few boxes at, along the axis on which their middles lie widest apart.
fn few(items: &mut [Item]) -> Halved {
    let count = items.len();
    let part = |bounds| Part { bounds, middles: Bounds::NOTHING };
    if count == 2 {
        return Halved { left: 1, parts: [part(items[0].0), part(items[1].0)] };
    }
    let middles = items.iter().fold(Bounds::NOTHING, |all, item| all.join(Bounds::at(item.0.middle())));
    let size = middles.high - middles.low;
    let axis = if size.x >= size.y && size.x >= size.z { 0 } else { 1 + usize::from(size.z > size.y) };
    // By insertion: what is equal stays in its order.
    let mut keys = [0.0; FEW];
    for i in 0..count {
        let item = items[i];
        let key = item.0.low[axis] + item.0.high[axis];
        let mut j = i;
        while j > 0 && key < keys[j - 1] {
            (keys[j], items[j]) = (keys[j - 1], items[j - 1]);
            j -= 1;
        }
        (keys[j], items[j]) = (key, item);
    }
    let mut right = [Bounds::NOTHING; FEW];
    let mut sum = Bounds::NOTHING;
    for (right, item) in right.iter_mut().zip(&*items).rev() {
        sum = sum.join(item.0);
        *right = sum;
    }
    let mut left = Bounds::NOTHING;
    let mut least = f32::INFINITY;
    let mut halved = Halved { left: count / 2, parts: [part(left); 2] };
    for i in 1..count {
        left = left.join(items[i - 1].0);
        let cost = left.half_area() * i as f32 + right[i].half_area() * (count - i) as f32;
        if cost < least {
            least = cost;
            halved = Halved { left: i, parts: [part(left), part(right[i])] };
        }
    }
    if least == f32::INFINITY { Halved::at(count / 2, items) } else { halved }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    #[test]
    fn parts_far_down_are_halved() {
        // All in one place but the last, which the cheapest plane parts from them.
        let place = |i: u32| Vec3::splat(if i == 40 { 1e6 } else { i as f32 });
        let one = |i: u32| Item::new(Bounds::around([place(i), place(i) + 1.0]), i);
        let left = |level: u32| {
            let mut items: Vec<Item> = (0..41).map(one).collect();
            let whole = Part::new(&items);
            halves(&mut items, &whole, level).left
        };
        assert_eq!([left(0), left(STEEP - 1), left(STEEP), left(STEEP + 9)], [40, 40, 20, 20]);
    }
}
