//! the boxes of a node -> its children, by the surface area heuristic in bins
//!
//! Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007.

use std::ops::Range;

use glam::Vec4;

use super::{Bounds, MOST_IN_LEAF};

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
        let (bounds, middles) = items[range.clone()].iter().fold(nothing, |(bounds, middles), item| {
            let middle = item.0.middle();
            (bounds.join(item.0), middles.join(Bounds { low: middle, high: middle }))
        });
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
    let mut parts = Vec::with_capacity(CHILDREN);
    parts.push(whole);
    while parts.len() < CHILDREN {
        // What is left as a leaf costs no node: it is split only where there is room to spare.
        let largest = |parts: &[Part], least: usize| {
            let open = parts.iter().enumerate().filter(|(_, part)| part.items.len() > least);
            open.max_by(|a, b| a.1.bounds.half_area().total_cmp(&b.1.bounds.half_area())).map(|(i, _)| i)
        };
        let Some(i) = largest(&parts, MOST_IN_LEAF).or_else(|| largest(&parts, 1)) else { break };
        let (left, right) = halves(items, &parts[i], level >= STEEP);
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
    let nothing = Part { items: 0..0, bounds: Bounds::NOTHING, middles: Bounds::NOTHING };
    let (mut left, mut right) = (nothing.clone(), nothing);
    let put = |part: &mut Part, item: &Item| {
        let middle = item.0.middle();
        part.middles = part.middles.join(Bounds { low: middle, high: middle });
    };
    let (mut i, mut j) = (start, end);
    while i < j {
        if plane.is_left(&items[i]) {
            put(&mut left, &items[i]);
            i += 1;
        } else {
            put(&mut right, &items[i]);
            j -= 1;
            items.swap(i, j);
        }
    }
    [left.bounds, right.bounds] = plane.bounds;
    (left.items, right.items) = (start..i, i..end);
    (left, right)
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

/// Middles in bins below `bin` along `axis` lie left.
struct Plane {
    axis: usize,
    bin: usize,
    grid: Grid,
    bounds: [Bounds; 2],
}

impl Plane {
    fn is_left(&self, item: &Item) -> bool {
        self.grid.bins(item)[self.axis] < self.bin
    }
}

/// Where the middle of the first bin is, and how many bins a unit holds.
#[derive(Clone, Copy)]
struct Grid {
    low: Vec4,
    scale: Vec4,
}

const BINS: usize = 16;

impl Grid {
    #[inline]
    fn bins(self, item: &Item) -> [usize; 3] {
        // The last bits of a number this large count whole ones; what is not a number falls into some bin.
        let at = (item.0.middle() - self.low) * self.scale + 8_388_608.0;
        [at.x, at.y, at.z].map(|at| at.to_bits() as usize % BINS)
    }
}

#[derive(Clone, Copy)]
struct Bin {
    bounds: Bounds,
    count: usize,
}

const EMPTY: Bin = Bin { bounds: Bounds::NOTHING, count: 0 };

/// The plane between bins that is the cheapest; none if no plane parts the middles.
fn best(items: &[Item], middles: Bounds) -> Option<Plane> {
    // A few boxes need few bins.
    let count = items.len().clamp(4, BINS);
    let size = middles.high - middles.low;
    let scale = Vec4::splat((count - 1) as f32) / size;
    // An axis without extent is none: all middles fall into its first bin.
    let scale = Vec4::select(size.cmpgt(Vec4::ZERO) & scale.cmplt(Vec4::INFINITY), scale, Vec4::ZERO);
    let grid = Grid { low: middles.low, scale };
    let mut bins = [[EMPTY; BINS]; 3];
    for item in items {
        for (bins, i) in bins.iter_mut().zip(grid.bins(item)) {
            bins[i].bounds = bins[i].bounds.join(item.0);
            bins[i].count += 1;
        }
    }
    let mut least = f32::INFINITY;
    let mut plane = None;
    for (axis, bins) in bins.iter().enumerate() {
        let mut right = [EMPTY; BINS];
        let mut sum = EMPTY;
        for i in (1..count).rev() {
            sum = Bin { bounds: sum.bounds.join(bins[i].bounds), count: sum.count + bins[i].count };
            right[i] = sum;
        }
        let mut left = EMPTY;
        for bin in 1..count {
            left = Bin { bounds: left.bounds.join(bins[bin - 1].bounds), count: left.count + bins[bin - 1].count };
            let cost = |b: &Bin| b.bounds.half_area() * b.count as f32;
            let both = cost(&left) + cost(&right[bin]);
            if left.count > 0 && right[bin].count > 0 && both < least {
                least = both;
                plane = Some(Plane { axis, bin, grid, bounds: [left.bounds, right[bin].bounds] });
            }
        }
    }
    plane
}
