//! eight rays that go the same way -> their distances to one box or one primitive, all at once
//!
//! Other than `walk.rs`, which asks eight boxes for one ray.

use fearless_simd::prelude::*;
use fearless_simd::{f32x8, mask32x8, u32x8};
use glam::Vec3;

use super::LANES;
use super::meet::Seen;
use super::walk::Found;
use super::wide::Wide;
use crate::cpu::trace::aim::{Aim, Ray};
use crate::cpu::trace::seat::Seat;
use crate::cpu::trace::walk::Walk;
use crate::tables::{Leaf, PLANE, SPHERE, Tables};

/// What the rays have found so far.
pub(super) struct Founds<S: Simd> {
    pub(super) t: f32x8<S>,
    /// Only what is nearer than this counts; nothing is, where a ray that asks for any hit has one.
    pub(super) reach: f32x8<S>,
    pub(super) hit: u32x8<S>,
    /// The numbers of the hits.
    pub(super) id: u32x8<S>,
    pub(super) any: bool,
}

/// Rays whose directions have the same signs and the same longest axis: [`Seat`], lane by lane.
pub(super) struct Pack<'a, S: Simd> {
    pub(super) simd: S,
    seat: Seat,
    pub(super) rays: &'a [Ray; LANES],
    leaves: u32x8<S>,
    origin: [f32x8<S>; 3],
    inverse: [f32x8<S>; 3],
    shear: [f32x8<S>; 3],
    own: [f32x8<S>; 3],
    slack: [f32x8<S>; 3],
    /// See `walk::Eyes`.
    near_from: [f32x8<S>; 3],
    far_from: [f32x8<S>; 3],
    near: [usize; 3],
}

/// The same for x, y and z, written out: what `map` is given would be compiled for no SIMD level.
macro_rules! each {
    ($axis:ident => $e:expr) => {
        [
            {
                let $axis = 0;
                $e
            },
            {
                let $axis = 1;
                $e
            },
            {
                let $axis = 2;
                $e
            },
        ]
    };
}

/// What is said of all lanes, if the same is.
#[inline(always)]
fn alike<S: Simd>(lanes: mask32x8<S>) -> Option<bool> {
    if lanes.all_true() { Some(true) } else { (!lanes.any_true()).then_some(false) }
}

#[inline(always)]
fn each_of<T: Copy + Default>(rays: &[Ray; LANES], f: impl Fn(&Ray) -> T) -> [T; LANES] {
    let mut all = [T::default(); LANES];
    for (one, ray) in all.iter_mut().zip(rays) {
        *one = f(ray);
    }
    all
}

/// Twin of that of `aim`: no part closer to zero than this.
#[inline(always)]
fn apart<S: Simd>(x: f32x8<S>, least: f32x8<S>) -> f32x8<S> {
    x.abs().simd_ge(least).select(x, x.simd_lt(0.0).select(-least, least))
}

impl<'a, S: Simd> Pack<'a, S> {
    /// Rays in a tree that reaches from `low` to `high`, the first of them in its seat; none if their ways part at once.
    #[inline(always)]
    pub(super) fn new(simd: S, rays: &'a [Ray; LANES], seat: Seat, low: Vec3, high: Vec3) -> Option<Self> {
        let direction = each!(axis => f32x8::simd_from(simd, each_of(rays, |ray| ray.direction[axis])));
        let back_x = alike(direction[0].simd_lt(0.0))?;
        let back_y = alike(direction[1].simd_lt(0.0))?;
        let back_z = alike(direction[2].simd_lt(0.0))?;
        let size = each!(axis => direction[axis].abs());
        let axis = if alike(size[0].simd_gt(size[1]) & size[0].simd_gt(size[2]))? {
            0
        } else if alike(size[1].simd_gt(size[2]))? {
            1
        } else {
            2
        };
        let origin = each!(axis => f32x8::simd_from(simd, each_of(rays, |ray| ray.origin[axis])));
        // From here on as in `aim_of`.
        let (dx, dy, dz) = (direction[(axis + 1) % 3], direction[(axis + 2) % 3], direction[axis]);
        let least = dz.abs() * 9.313226e-10;
        let inverse = each!(axis => 1.0 / apart(direction[axis], least));
        let away = each!(axis => {
            let below = (f32x8::splat(simd, low[axis]) - origin[axis]).abs();
            below.max((f32x8::splat(simd, high[axis]) - origin[axis]).abs())
        });
        let reach = away[0].max(away[1].max(away[2]));
        let per_side = each!(axis => inverse[axis].abs() * reach);
        let slack = each!(axis => per_side[axis] * 3.8146973e-6);
        let from = each!(axis => origin[axis] * inverse[axis]);
        let more = each!(axis => slack[axis] + from[axis].abs() * 3.8146973e-6);
        Some(Self {
            simd,
            seat,
            rays,
            leaves: u32x8::simd_from(simd, each_of(rays, |ray| ray.leaves)),
            origin,
            inverse,
            shear: [dx / dz, dy / dz, 1.0 / dz],
            own: each!(axis => per_side[axis] * 9.536743e-7),
            slack,
            near_from: each!(axis => from[axis] + more[axis]),
            far_from: each!(axis => from[axis] - more[axis]),
            near: [usize::from(back_x), 2 + usize::from(back_y), 4 + usize::from(back_z)],
        })
    }

    /// One of the rays, alone.
    #[inline(always)]
    fn seat(&self, i: usize) -> Seat {
        let of = |lanes: &[f32x8<S>; 3]| Vec3::new(lanes[0][i], lanes[1][i], lanes[2][i]);
        let aim = Aim {
            shear: of(&self.shear),
            inverse: of(&self.inverse),
            own: of(&self.own),
            slack: of(&self.slack),
            ..self.seat.aim
        };
        let ray = self.rays[i];
        Seat { ray, aim, per_length_squared: 1.0 / ray.direction.dot(ray.direction), ..self.seat }
    }

    /// Twin of [`boxes_met`](crate::cpu::trace::boxes::boxes_met): where each ray enters a child's box, and who does.
    #[inline(always)]
    pub(super) fn enter(&self, node: &Wide, child: usize, reach: f32x8<S>) -> (f32x8<S>, mask32x8<S>) {
        let near = each!(axis => {
            let side = f32x8::splat(self.simd, node.sides[self.near[axis]][child]);
            side.mul_sub(self.inverse[axis], self.near_from[axis])
        });
        let far = each!(axis => {
            let side = f32x8::splat(self.simd, node.sides[self.near[axis] ^ 1][child]);
            side.mul_sub(self.inverse[axis], self.far_from[axis])
        });
        let enter = near[0].max(near[1]).max(near[2].max(f32x8::splat(self.simd, 0.0)));
        let leave = far[0].min(far[1]).min(far[2].min(reach));
        (enter, enter.simd_le(leave))
    }

    /// The distances to a triangle, and who of those that ask meets it.
    #[inline(always)]
    fn triangle(&self, leaf: &Leaf, asking: mask32x8<S>, reach: f32x8<S>) -> (f32x8<S>, mask32x8<S>) {
        let axes = self.seat.aim.axes;
        let a = each!(i => f32x8::splat(self.simd, leaf.a[axes[i]]) - self.origin[axes[i]]);
        let b = each!(i => f32x8::splat(self.simd, leaf.b[axes[i]]) - self.origin[axes[i]]);
        let c = each!(i => f32x8::splat(self.simd, leaf.c[axes[i]]) - self.origin[axes[i]]);
        let inverse = each!(i => self.inverse[axes[i]]);
        let own = each!(i => self.own[axes[i]]);
        Seen { corners: [a, b, c], shear: self.shear, inverse, own }.meet(asking, reach)
    }

    /// Asks a primitive that is no instance.
    #[inline(always)]
    pub(super) fn ask(&self, tables: &Tables, i: u32, asking: mask32x8<S>, found: &mut Founds<S>) {
        let simd = self.simd;
        let leaf = &tables.leaves[i as usize];
        let number = i.wrapping_add(self.seat.numbers);
        let id = leaf.id + self.seat.ids;
        let (t, met) = if leaf.kind == SPHERE {
            let bits = asking.to_bitmask();
            let mut t = [f32::INFINITY; LANES];
            for (i, t) in t.iter_mut().enumerate().filter(|(i, _)| bits & 1 << i != 0) {
                *t = self.seat(i).meet_sphere(leaf, number);
            }
            (f32x8::simd_from(simd, t), asking)
        } else {
            let (t, met) = self.triangle(leaf, asking, found.reach);
            (t, met & !self.leaves.simd_eq(number))
        };
        let wins = u32x8::splat(simd, id).simd_lt(found.id);
        let mut nearer = met & (t.simd_lt(found.reach) | (t.simd_eq(found.reach) & wins));
        if !nearer.any_true() {
            return;
        }
        if leaf.kind > PLANE {
            let mut bits = nearer.to_bitmask();
            for i in (0..LANES).filter(|i| nearer.test(*i)) {
                bits ^= u64::from(!self.seat(i).is_solid(tables, leaf, found.any)) << i;
            }
            nearer = mask32x8::from_bitmask(simd, bits);
        }
        let over = f32x8::splat(simd, -1.0);
        found.t = nearer.select(t, found.t);
        found.reach = nearer.select(if found.any { over } else { t }, found.reach);
        found.hit = nearer.select(u32x8::splat(simd, number), found.hit);
        found.id = nearer.select(u32x8::splat(simd, id), found.id);
    }

    /// Lets one of the rays do what is left below a node by itself.
    #[inline(always)]
    pub(super) fn alone(&self, i: usize, found: &mut Founds<S>, below: impl FnOnce(&Seat, &mut Found)) {
        let walk = Walk { hit: found.hit[i], ..Walk::new(found.reach[i]) };
        let mut one = Found { walk, id: found.id[i], any: found.any };
        below(&self.seat(i), &mut one);
        if one.walk.t.to_bits() != found.reach[i].to_bits() || one.walk.hit != found.hit[i] {
            found.t.as_mut_slice()[i] = one.walk.t;
            found.reach.as_mut_slice()[i] = if found.any { -1.0 } else { one.walk.t };
            found.hit.as_mut_slice()[i] = one.walk.hit;
            found.id.as_mut_slice()[i] = one.id;
        }
    }
}
