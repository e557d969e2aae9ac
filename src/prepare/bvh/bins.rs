//! boxes -> the cheapest plane between bins of their middles
//!
//! Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007.

use glam::Vec4;
use rayon::prelude::*;

use super::Bounds;
use super::split::{CHUNK, Item};

/// Middles in bins below `bin` along `axis` lie left.
pub(super) struct Plane {
    axis: usize,
    bin: usize,
    low: f32,
    scale: f32,
    /// Around what lies on each side.
    pub(super) bounds: [Bounds; 2],
}

/// Added to a number of a bin, it leaves that number in the last bits.
const WHOLE: f32 = 8_388_608.0;

impl Plane {
    #[inline]
    pub(super) fn is_left(&self, item: &Item) -> bool {
        // With the bits that `Grid::bins` has on this axis.
        let middle = item.0.low[self.axis] + item.0.high[self.axis];
        let at = (middle - self.low) * self.scale + WHOLE;
        at.to_bits() as usize % MOST < self.bin
    }
}

/// Where the middle of the first bin is, and how many bins a unit holds.
#[derive(Clone, Copy)]
struct Grid {
    low: Vec4,
    scale: Vec4,
}

/// Many boxes have so many bins along each axis, some have half, and few a quarter as many.
const MOST: usize = 32;
const MANY: usize = 2048;
const SOME: usize = 192;

impl Grid {
    fn new(middles: Bounds, bins: usize) -> Self {
        let size = middles.high - middles.low;
        let scale = Vec4::splat((bins - 1) as f32) / size;
        // An axis without extent is none: all middles fall into its first bin.
        let scale = Vec4::select(size.cmpgt(Vec4::ZERO) & scale.cmplt(Vec4::INFINITY), scale, Vec4::ZERO);
        Self { low: middles.low, scale }
    }

    #[inline]
    fn bins(self, item: &Item) -> [usize; 3] {
        // What is not a number falls into some bin.
        let at = (item.0.middle() - self.low) * self.scale + WHOLE;
        [at.x, at.y, at.z].map(|at| at.to_bits() as usize % MOST)
    }
}

#[derive(Clone, Copy)]
struct Bin {
    bounds: Bounds,
    count: u32,
}

const EMPTY: Bin = Bin { bounds: Bounds::NOTHING, count: 0 };

impl Bin {
    #[inline]
    fn join(&self, other: &Self) -> Self {
        Self { bounds: self.bounds.join(other.bounds), count: self.count + other.count }
    }

    #[inline]
    fn cost(&self) -> f32 {
        self.bounds.half_area() * self.count as f32
    }
}

/// The plane between bins that is the cheapest; none if no plane parts the middles.
pub(super) fn best(items: &[Item], middles: Bounds) -> Option<Plane> {
    match items.len() {
        MANY.. => best_of::<MOST>(items, middles),
        SOME.. => best_of::<{ MOST / 2 }>(items, middles),
        _ => best_of::<{ MOST / 4 }>(items, middles),
    }
}

type Bins<const N: usize> = [[Bin; N]; 3];

fn best_of<const N: usize>(items: &[Item], middles: Bounds) -> Option<Plane> {
    let grid = Grid::new(middles, N);
    let bins = if items.len() < 2 * CHUNK {
        filled::<N>(items, grid)
    } else {
        // A union of boxes is the same in any order, to the bit.
        let both = |mut a: Bins<N>, b: Bins<N>| {
            for (a, b) in a.iter_mut().flatten().zip(b.iter().flatten()) {
                *a = a.join(b);
            }
            a
        };
        items.par_chunks(CHUNK).map(|items| filled::<N>(items, grid)).reduce(|| [[EMPTY; N]; 3], both)
    };
    let mut least = f32::INFINITY;
    let mut plane = None;
    for (axis, bins) in bins.iter().enumerate() {
        let mut right = [EMPTY; N];
        let mut sum = EMPTY;
        for i in (1..N).rev() {
            sum = sum.join(&bins[i]);
            right[i] = sum;
        }
        let mut left = EMPTY;
        for bin in 1..N {
            left = left.join(&bins[bin - 1]);
            let both = left.cost() + right[bin].cost();
            if both < least && left.count > 0 && right[bin].count > 0 {
                least = both;
                let (low, scale) = (grid.low[axis], grid.scale[axis]);
                plane = Some(Plane { axis, bin, low, scale, bounds: [left.bounds, right[bin].bounds] });
            }
        }
    }
    plane
}

fn filled<const N: usize>(items: &[Item], grid: Grid) -> Bins<N> {
    let mut bins = [[EMPTY; N]; 3];
    for item in items {
        for (bins, i) in bins.iter_mut().zip(grid.bins(item)) {
            let bin = &mut bins[i % N];
            bin.bounds = bin.bounds.join(item.0);
            bin.count += 1;
        }
    }
    bins
}
