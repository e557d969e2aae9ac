//! eight pixels of a scene of few primitives -> sums on the film: eight times `cpu/trace/few.rs`, sample by sample

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch, f32x8, mask32x8, u32x8};
use glam::Vec3;

use super::meet::{Rays, free, nearest};
use super::shade::{Ways, phong, scatter, surfaces_at};
use super::{LANES, Vec3s};
use crate::cpu::trace::primary::place;
use crate::math::vector::luminance;
use crate::tables::{FAR, NONE, POINT, STACK_FULL, Slice, Status, Tables, View, Waiting};

/// Eight ray trees in progress: [`Path`](crate::tables::Path), lane by lane.
struct Trees<'a, S: Simd> {
    rays: Rays<S>,
    way: Ways<S>,
    depth: u32x8<S>,
    radiance: Vec3s<S>,
    active: mask32x8<S>,
    /// Rays taken up so far.
    taken: u32x8<S>,
    waiting: [usize; LANES],
    stacks: &'a mut [Waiting],
}

/// At most eight pixels of the film.
pub(in crate::cpu) struct Strip<'a> {
    /// The first of them.
    pub(in crate::cpu) first: u32,
    pub(in crate::cpu) sums: &'a mut [[f32; 4]],
    pub(in crate::cpu) squares: &'a mut [f32],
    pub(in crate::cpu) ids: &'a mut [u32],
}

/// Renders at most eight pixels from sample `next` on, and says which is the next then: as many samples as the slice
/// has, or as its budget allows. `stacks` has `max_depth` places for each pixel.
pub(in crate::cpu) fn few(
    tables: &Tables,
    next: &mut u32,
    slice: &Slice,
    stacks: &mut [Waiting],
    film: Strip<'_>,
    status: &mut Status,
) {
    dispatch!(Level::new(), simd => pixels(simd, tables, next, slice, stacks, film, status));
}

#[inline(always)]
fn pixels<S: Simd>(
    simd: S,
    tables: &Tables,
    next: &mut u32,
    slice: &Slice,
    stacks: &mut [Waiting],
    film: Strip<'_>,
    status: &mut Status,
) {
    let Strip { first, sums, squares, ids } = film;
    let view = &tables.view;
    let count = sums.len();
    let mut turns = 0;
    let pixel = |i: usize| first + i.min(count - 1) as u32;
    let column = f32x8::from_fn(simd, |i| (pixel(i) % view.width) as f32);
    let row = f32x8::from_fn(simd, |i| (view.height - 1 - pixel(i) / view.width) as f32);
    let zero = Vec3s::splat(simd, Vec3::ZERO);
    while *next < slice.samples {
        let sample = *next;
        let direction = primary(simd, view, column, row, sample);
        let none = u32x8::splat(simd, NONE);
        let mut trees = Trees {
            rays: Rays { origin: Vec3s::splat(simd, view.eye), direction, leaves: none },
            way: Ways {
                direction,
                weight: Vec3s::splat(simd, Vec3::ONE),
                inside: mask32x8::splat(simd, view.inside == 1),
            },
            depth: u32x8::splat(simd, 1),
            radiance: zero,
            active: mask32x8::from_bitmask(simd, (1 << count) - 1),
            taken: u32x8::splat(simd, 0),
            waiting: [0; LANES],
            stacks: &mut *stacks,
        };
        turns += 1;
        let begin = turns;
        while trees.active.any_true() && turns < slice.budget {
            let seen = trees.step(simd, tables, status, pixel, sample);
            if sample == 0 && turns == begin {
                ids.copy_from_slice(&seen.to_array()[..count]);
            }
            turns += 1;
        }
        if trees.active.any_true() {
            break;
        }
        *next += 1;
        for (i, (sum, square)) in sums.iter_mut().zip(&mut *squares).enumerate() {
            let light = trees.radiance.lane(i);
            let luminance = luminance(light);
            *square += luminance * luminance;
            for (sum, one) in sum.iter_mut().zip([light.x, light.y, light.z, 1.0]) {
                *sum += one;
            }
        }
    }
    status.turns = status.turns.max(turns);
    if *next == slice.samples {
        status.pixels += count as u32;
    }
}

/// Twin of [`primary`](crate::cpu::trace::primary::primary).
#[inline(always)]
fn primary<S: Simd>(simd: S, view: &View, column: f32x8<S>, row: f32x8<S>, sample: u32) -> Vec3s<S> {
    let at = place(view, sample);
    let x = (column + at.x) / view.width as f32 - 0.5;
    let y = (row + at.y) / view.height as f32 - 0.5;
    let [right, up, back] = [view.right, view.up, view.back].map(|v| Vec3s::splat(simd, v));
    right.scaled(x).plus(up.scaled(y)).minus(back).unit()
}

impl<S: Simd> Trees<'_, S> {
    /// Follows each tree's ray in hand with its shadow rays, and takes up the next; returns what was hit.
    #[inline(always)]
    fn step(
        &mut self,
        simd: S,
        tables: &Tables,
        status: &mut Status,
        pixel: impl Fn(usize) -> u32,
        sample: u32,
    ) -> u32x8<S> {
        let settings = &tables.settings;
        let background = Vec3s::splat(simd, settings.background);
        let found = nearest(simd, tables, self.rays);
        let past = self.active & found.hit.simd_eq(NONE);
        let met = self.active & !past;
        self.add(past, self.way.weight.times(background));

        let surface = surfaces_at(simd, tables, self.rays, found);
        // Inside an object no light is asked (spec 2.1, step 2).
        let asking = met & !self.way.inside;
        for source in &tables.lights {
            let place = Vec3s::splat(simd, source.place);
            let (toward, reach) =
                if source.kind == POINT { (place.minus(surface.point), 1.0) } else { (place, FAR) };
            let l = toward.unit();
            let mut lit = asking & l.dot(surface.normal).simd_gt(0.0);
            if !lit.any_true() {
                continue;
            }
            let shadow = Rays { origin: surface.point, direction: toward, leaves: found.hit };
            lit = free(simd, tables, shadow, reach, lit);
            if lit.any_true() {
                let terms = phong(simd, &surface, l, self.rays.direction.negated(), settings.specular);
                let power = Vec3s::splat(simd, source.power).scaled(surface.local_weight * terms);
                self.add(lit, self.way.weight.times(surface.color.times(power)));
            }
        }

        let taken = self.taken.to_array();
        let seed = |i: usize| [pixel(i), sample, taken[i], tables.view.seed];
        let inside = self.way.inside;
        let [mut heavy, mut light] = scatter(simd, self.rays.direction, inside, &surface, met, seed);
        heavy.weight = heavy.weight.times(self.way.weight);
        light.weight = light.weight.times(self.way.weight);
        let swap = light.weight.largest().simd_gt(heavy.weight.largest());
        (heavy, light) = (Ways::choose(swap, light, heavy), Ways::choose(swap, heavy, light));
        let last = met & self.depth.simd_ge(settings.max_depth);
        self.add(last, heavy.weight.plus(light.weight).times(background));

        let on = met & !last & heavy.weight.largest().simd_gt(settings.cutoff);
        let forks = on & light.weight.largest().simd_gt(settings.cutoff);
        if forks.any_true() {
            self.put_aside(forks, &surface.point, &found.hit, &light, settings.max_depth as usize, status);
        }
        self.rays.origin = Vec3s::choose(on, surface.point, self.rays.origin);
        self.rays.leaves = on.select(found.hit, self.rays.leaves);
        self.way = Ways::choose(on, heavy, self.way);
        self.depth = on.select(self.depth + 1, self.depth);
        self.taken += 1;

        let back = self.active & !on;
        self.active = on;
        if back.any_true() {
            self.turn_back(back, settings.max_depth as usize);
        }
        self.rays.direction = self.way.direction;
        found.hit
    }

    #[inline(always)]
    fn add(&mut self, lanes: mask32x8<S>, light: Vec3s<S>) {
        self.radiance = Vec3s::choose(lanes, self.radiance.plus(light), self.radiance);
    }

    /// Lets the lighter branches wait.
    fn put_aside(
        &mut self,
        forks: mask32x8<S>,
        point: &Vec3s<S>,
        hit: &u32x8<S>,
        light: &Ways<S>,
        max_depth: usize,
        status: &mut Status,
    ) {
        for i in (0..LANES).filter(|&i| forks.test(i)) {
            if self.waiting[i] >= max_depth {
                status.flags |= STACK_FULL;
                continue;
            }
            self.stacks[i * max_depth + self.waiting[i]] = Waiting {
                origin: point.lane(i),
                leaves: hit[i],
                direction: light.direction.lane(i),
                depth: self.depth[i] + 1,
                weight: light.weight.lane(i),
                inside: u32::from(light.inside.test(i)),
            };
            self.waiting[i] += 1;
        }
    }

    /// Takes up rays that wait; a tree without any is at its end.
    fn turn_back(&mut self, back: mask32x8<S>, max_depth: usize) {
        for i in (0..LANES).filter(|&i| back.test(i)) {
            let Some(top) = self.waiting[i].checked_sub(1) else { continue };
            self.waiting[i] = top;
            let ray = self.stacks[i * max_depth + top];
            self.rays.origin.set_lane(i, ray.origin);
            self.rays.leaves[i] = ray.leaves;
            self.way.direction.set_lane(i, ray.direction);
            self.way.weight.set_lane(i, ray.weight);
            self.way.inside.set(i, ray.inside == 1);
            self.depth[i] = ray.depth;
            self.active.set(i, true);
        }
    }
}
