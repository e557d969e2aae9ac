//! eight rays that go the same way, and the scene -> what each of them finds, node by node together
//!
//! Neighbors ask the same nodes: a node is fetched once for all of them, and none of its eight boxes has to wait for
//! another. Where only one of the rays is left, it goes on alone.

use fearless_simd::prelude::*;
use fearless_simd::{dispatch, f32x8, mask32x8, u32x8};

use super::LANES;
use super::pack::{Founds, Pack};
use super::walk::{Walker, below};
use super::wide::Wides;
use crate::cpu::trace::aim::Ray;
use crate::cpu::trace::instanced::{primitive_at, ray_within};
use crate::cpu::trace::seat::Seat;
use crate::cpu::trace::walk::{Walk, past_planes};
use crate::tables::{INSTANCE, NONE, Tables};

/// A node that some of the rays are still to ask.
#[derive(Debug, Clone, Copy)]
pub(super) struct Open {
    /// Where each ray enters; infinity for those that do not.
    enter: [f32; LANES],
    /// Where the first of those that do does: the nearest node is asked first.
    first: f32,
    node: u32,
}

impl Open {
    pub(super) const NOTHING: Self = Self { enter: [f32::INFINITY; LANES], first: f32::INFINITY, node: 0 };
}

/// Walks of at most eight rays; beyond the last there are copies of it.
struct Asked<'a> {
    rays: [Ray; LANES],
    walks: &'a mut [Walk],
    /// The numbers of what the walks have found before.
    ids: [u32; LANES],
    any: bool,
}

impl Walker<'_> {
    /// [`walk`](Self::walk) for ray after ray, from what each has found before; eight at once where they go the same
    /// way, as neighbors do.
    pub fn walk_all(&mut self, rays: &[Ray], walks: &mut [Walk], any: bool) {
        for (rays, walks) in rays.chunks(LANES).zip(walks.chunks_mut(LANES)) {
            if rays.len() < 2 || !self.walk_together(rays, walks, any) {
                for (ray, walk) in rays.iter().zip(walks) {
                    *walk = self.walk(*ray, *walk, any);
                }
            }
        }
    }

    /// At most eight walks; `false` if they are left to be done one by one.
    fn walk_together(&mut self, rays: &[Ray], walks: &mut [Walk], any: bool) -> bool {
        let signs = |ray: &Ray| ray.direction.is_negative_bitmask();
        if rays.iter().any(|ray| signs(ray) != signs(&rays[0])) {
            return false;
        }
        let (tables, wides) = (self.tables, self.wides);
        let mut asked =
            Asked { rays: std::array::from_fn(|i| rays[i.min(rays.len() - 1)]), walks, ids: [0; LANES], any };
        for ((ray, walk), id) in rays.iter().zip(&mut *asked.walks).zip(&mut asked.ids) {
            *walk = past_planes(tables, *ray, *walk, u32::MAX, any);
            if walk.hit != NONE {
                *id = primitive_at(tables, walk.hit).leaf.id;
            }
        }
        let stacks = Stacks { open: &mut self.open, alone: &mut self.stack };
        let done = if tables.instances.is_empty() {
            dispatch!(self.level, simd => together::<_, false>(simd, tables, wides, &mut asked, stacks))
        } else {
            dispatch!(self.level, simd => together::<_, true>(simd, tables, wides, &mut asked, stacks))
        };
        if done {
            for walk in asked.walks {
                walk.turns += 1;
                walk.next = tables.settings.planes + 1;
            }
        }
        done
    }
}

/// All below the world's root; `false` if the rays' ways part at once.
#[inline(always)]
fn together<S: Simd, const INSTANCES: bool>(
    simd: S,
    tables: &Tables,
    wides: &Wides,
    asked: &mut Asked<'_>,
    stacks: Stacks<'_>,
) -> bool {
    let (low, high) = (tables.settings.low, tables.settings.high);
    let seat = Seat::in_world(tables, asked.rays[0]);
    let Some(pack) = Pack::new(simd, &asked.rays, seat, low, high) else { return false };
    // Beyond the last ray, and where any hit will do and is known, there is nothing to look for.
    let (mut t, mut reach, mut hit) = ([0.0; LANES], [-1.0; LANES], [NONE; LANES]);
    for (i, walk) in asked.walks.iter().enumerate() {
        (t[i], hit[i]) = (walk.t, walk.hit);
        reach[i] = if asked.any && walk.hit != NONE { -1.0 } else { walk.t };
    }
    let mut found = Founds {
        t: f32x8::simd_from(simd, t),
        reach: f32x8::simd_from(simd, reach),
        hit: u32x8::simd_from(simd, hit),
        id: u32x8::simd_from(simd, asked.ids),
        any: asked.any,
    };
    let asking = found.reach.simd_ge(0.0);
    below_all::<S, INSTANCES>(tables, wides, &pack, 0, asking, stacks, &mut found);
    for (i, walk) in asked.walks.iter_mut().enumerate() {
        (walk.t, walk.hit) = (found.t[i], found.hit[i]);
    }
    true
}

/// Room for what is still to be asked, by all and by one alone.
struct Stacks<'a> {
    open: &'a mut [Open],
    alone: &'a mut [u64],
}

/// Asks all that lies below a node; instances only where there are any, and in no instance.
#[inline(always)]
fn below_all<S: Simd, const INSTANCES: bool>(
    tables: &Tables,
    wides: &Wides,
    pack: &Pack<'_, S>,
    root: u32,
    asking: mask32x8<S>,
    stacks: Stacks<'_>,
    found: &mut Founds<S>,
) {
    let Stacks { open, alone } = stacks;
    let (mut at, mut asking, mut size) = (root, asking, 0);
    loop {
        let bits = asking.to_bitmask() as u32;
        if bits.is_power_of_two() {
            pack.alone(bits.trailing_zeros() as usize % LANES, found, |seat, one| {
                below::<S, INSTANCES>(pack.simd, tables, wides, seat, at, alone, one);
            });
        } else if bits != 0 {
            let node = &wides.nodes[at as usize];
            let bottom = size;
            let mut left = node.taken;
            while left != 0 {
                let child = left.trailing_zeros() as usize % LANES;
                left &= left - 1;
                let (enter, met) = pack.enter(node, child, found.reach);
                let met = met & asking;
                let bits = met.to_bitmask() as u32;
                if bits == 0 {
                    continue;
                }
                let many = node.many >> (2 * child) & 3;
                for i in node.children[child]..node.children[child] + many {
                    if INSTANCES && tables.leaves[i as usize].kind == INSTANCE {
                        let stacks = Stacks { open: &mut open[size..], alone };
                        within(tables, wides, pack, i, met, stacks, found);
                    } else {
                        pack.ask(tables, i, met, found);
                    }
                }
                if many == 0 {
                    let enter = met.select(enter, f32x8::splat(pack.simd, f32::INFINITY)).to_array();
                    let first = enter[bits.trailing_zeros() as usize % LANES];
                    let mut i = size;
                    while i > bottom && open[i - 1].first < first {
                        open[i] = open[i - 1];
                        i -= 1;
                    }
                    open[i] = Open { enter, first, node: node.children[child] };
                    size += 1;
                }
            }
        }
        // The nearest of what is left that a ray enters before its reach.
        loop {
            if size == 0 {
                return;
            }
            size -= 1;
            asking = f32x8::from_slice(pack.simd, &open[size].enter).simd_le(found.reach);
            if asking.any_true() {
                at = open[size].node;
                break;
            }
        }
    }
}

/// Asks an instance, in which the rays' ways may part.
#[inline(always)]
fn within<S: Simd>(
    tables: &Tables,
    wides: &Wides,
    pack: &Pack<'_, S>,
    leaf: u32,
    asking: mask32x8<S>,
    stacks: Stacks<'_>,
    found: &mut Founds<S>,
) {
    let of = &tables.instances[tables.leaves[leaf as usize].material as usize];
    let asking = asking & found.reach.simd_ge(0.0);
    if asking.to_bitmask().count_ones() > 2 {
        let mut rays = *pack.rays;
        for ray in &mut rays {
            *ray = ray_within(*ray, of);
        }
        let seat = Seat::in_instance(tables, pack.rays[0], of);
        if let Some(inner) = Pack::new(pack.simd, &rays, seat, of.low, of.high) {
            below_all::<S, false>(tables, wides, &inner, of.root, asking, stacks, found);
            return;
        }
    }
    for i in (0..LANES).filter(|i| asking.test(*i)) {
        pack.alone(i, found, |seat, one| {
            let seat = Seat::in_instance(tables, seat.ray, of);
            below::<S, false>(pack.simd, tables, wides, &seat, of.root, stacks.alone, one);
        });
    }
}
