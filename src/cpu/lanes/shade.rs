//! eight hits -> surfaces, light and the ways on: eight times `surface`, `phong` and `scatter`

use fearless_simd::prelude::*;
use fearless_simd::{f32x8, mask32x8, u32x8};
use glam::Vec3;

use super::meet::{Founds, Rays};
use super::{LANES, Vec3s};
use crate::math::power::LOG2_SERIES;
use crate::math::random::{pcg4d, unit_float};
use crate::math::sphere::on_sphere;
use crate::tables::{BLINN, DIFFUSE, GLASS, Material, Tables};

/// Where eight rays have met primitives, and what these are made of.
#[derive(Debug, Clone, Copy)]
pub(super) struct Surfaces<S: Simd> {
    pub(super) point: Vec3s<S>,
    pub(super) normal: Vec3s<S>,
    pub(super) color: Vec3s<S>,
    pub(super) local_weight: f32x8<S>,
    pub(super) exponent: f32x8<S>,
    tint: Vec3s<S>,
    reflect_weight: f32x8<S>,
    refract_weight: f32x8<S>,
    index: f32x8<S>,
    behavior: u32x8<S>,
}

impl<S: Simd> Surfaces<S> {
    /// Sets the lanes of `here` to one primitive's.
    #[inline(always)]
    fn put(&mut self, simd: S, here: mask32x8<S>, point: Vec3s<S>, normal: Vec3s<S>, of: &Material) {
        let one = |value: f32, old: f32x8<S>| here.select(f32x8::splat(simd, value), old);
        let three = |value: Vec3, old: Vec3s<S>| Vec3s::choose(here, Vec3s::splat(simd, value), old);
        self.point = Vec3s::choose(here, point, self.point);
        self.normal = Vec3s::choose(here, normal, self.normal);
        self.color = three(of.color, self.color);
        self.local_weight = one(of.local_weight, self.local_weight);
        self.exponent = one(of.exponent, self.exponent);
        self.tint = three(of.tint, self.tint);
        self.reflect_weight = one(of.reflect_weight, self.reflect_weight);
        self.refract_weight = one(of.refract_weight, self.refract_weight);
        self.index = one(of.index, self.index);
        self.behavior = here.select(u32x8::splat(simd, of.behavior), self.behavior);
    }
}

#[inline(always)]
pub(super) fn surfaces_at<S: Simd>(simd: S, tables: &Tables, rays: Rays<S>, found: Founds<S>) -> Surfaces<S> {
    let along = rays.origin.plus(rays.direction.scaled(found.t));
    let zero = f32x8::splat(simd, 0.0);
    let mut all = Surfaces {
        point: along,
        normal: along,
        color: along,
        local_weight: zero,
        exponent: zero,
        tint: along,
        reflect_weight: zero,
        refract_weight: zero,
        index: zero,
        behavior: u32x8::splat(simd, 0),
    };
    // Neighbors mostly hit the same primitive, so that few of them need be looked at.
    for (sphere, i) in tables.spheres.iter().zip(0_u32..) {
        let here = found.hit.simd_eq(i);
        if here.any_true() {
            let center = Vec3s::splat(simd, sphere.center);
            let normal = along.minus(center).unit();
            let point = center.plus(normal.scaled(f32x8::splat(simd, sphere.radius)));
            all.put(simd, here, point, normal, &tables.materials[sphere.material as usize]);
        }
    }
    for (plane, i) in tables.planes.iter().zip(tables.settings.spheres..) {
        let here = found.hit.simd_eq(i);
        if here.any_true() {
            let normal = Vec3s::splat(simd, plane.normal);
            let above = normal.dot(along.minus(Vec3s::splat(simd, plane.point)));
            let point = along.minus(normal.scaled(above));
            all.put(simd, here, point, normal, &tables.materials[plane.material as usize]);
        }
    }
    let behind = all.normal.dot(rays.direction).simd_gt(0.0);
    all.normal = Vec3s::choose(behind, all.normal.negated(), all.normal);
    all
}

/// Twin of [`power`](crate::math::power::power).
#[inline(always)]
fn power<S: Simd>(simd: S, x: f32x8<S>, k: f32x8<S>) -> f32x8<S> {
    let bits: u32x8<S> = x.to_bits().bitcast();
    let exponent: f32x8<S> = (bits >> 23).to_float();
    let mantissa: f32x8<S> = ((bits & 0x007f_ffff) | 0x3f80_0000).bitcast();
    let over = mantissa.simd_gt(1.414_213_5);
    let m = over.select(mantissa * 0.5, mantissa);
    let exponent = over.select(exponent - 126.0, exponent - 127.0);
    let s = (m - 1.0) / (m + 1.0);
    let q = s * s;
    let [a, b, c, d] = LOG2_SERIES;
    let log2 = exponent + s * (q * (q * (q * d + c) + b) + a);

    let y = k * log2;
    let top = y.simd_lt(127.0).select(y, f32x8::splat(simd, 127.0));
    // A lane below the normal numbers is zero in the end, whatever comes of it here.
    let biased: fearless_simd::i32x8<S> = (top + 127.5).to_int();
    let whole: f32x8<S> = (biased - 127).to_float();
    let f = top - whole;
    let series = f
        * (f * (f * (f * (f * (f * 0.000_154_04 + 0.001_333_36) + 0.009_618_13) + 0.055_504_11) + 0.240_226_51)
            + 0.693_147_2)
        + 1.0;
    let scale: f32x8<S> = (biased << 23).bitcast();
    let zero = (x.simd_le(0.0) | y.simd_lt(-126.0)) & !k.simd_eq(0.0);
    let power = zero.select(f32x8::splat(simd, 0.0), series * scale);
    k.simd_eq(0.0).select(f32x8::splat(simd, 1.0), power)
}

/// Twin of [`phong`](crate::cpu::shade::phong::phong), its two terms added.
#[inline(always)]
pub(super) fn phong<S: Simd>(simd: S, surface: &Surfaces<S>, l: Vec3s<S>, v: Vec3s<S>, specular: u32) -> f32x8<S> {
    let n = surface.normal;
    let cosine = if specular == BLINN { l.plus(v).unit().dot(n) } else { l.mirrored(n).dot(v) };
    let positive = |x: f32x8<S>| x.simd_gt(0.0).select(x, f32x8::splat(simd, 0.0));
    positive(n.dot(l)) + power(simd, positive(cosine), surface.exponent)
}

/// Eight rays to come.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ways<S: Simd> {
    pub(super) direction: Vec3s<S>,
    pub(super) weight: Vec3s<S>,
    pub(super) inside: mask32x8<S>,
}

impl<S: Simd> Ways<S> {
    #[inline(always)]
    pub(super) fn choose(mask: mask32x8<S>, a: Self, b: Self) -> Self {
        Self {
            direction: Vec3s::choose(mask, a.direction, b.direction),
            weight: Vec3s::choose(mask, a.weight, b.weight),
            inside: (mask & a.inside) | (!mask & b.inside),
        }
    }
}

/// Reflected and refracted; `seed` tells each lane's own random numbers.
#[inline(always)]
pub(super) fn scatter<S: Simd>(
    simd: S,
    direction: Vec3s<S>,
    inside: mask32x8<S>,
    surface: &Surfaces<S>,
    active: mask32x8<S>,
    seed: impl Fn(usize) -> [u32; 4],
) -> [Ways<S>; 2] {
    let zero = Vec3s::splat(simd, Vec3::ZERO);
    let three = |x: f32x8<S>| Vec3s { x, y: x, z: x };
    let n = surface.normal;
    let reflection = direction.negated().mirrored(n);
    let mut reflected = Ways { direction: reflection, weight: three(surface.reflect_weight), inside };
    let mut refracted = Ways { direction: reflection, weight: zero, inside };

    let diffuse = surface.behavior.simd_eq(DIFFUSE) & active;
    if diffuse.any_true() {
        let mut free = zero;
        for i in (0..LANES).filter(|&i| diffuse.test(i)) {
            let bits = pcg4d(seed(i));
            free.set_lane(i, on_sphere(unit_float(bits[0]), unit_float(bits[1])));
        }
        let cosine = free.dot(reflection);
        let direction = Vec3s::choose(cosine.simd_lt(0.0), free.negated(), free);
        let weight = surface.tint.scaled(surface.reflect_weight * cosine.abs());
        reflected.direction = Vec3s::choose(diffuse, direction, reflected.direction);
        reflected.weight = Vec3s::choose(diffuse, weight, reflected.weight);
    }

    let glass = surface.behavior.simd_eq(GLASS) & active;
    if glass.any_true() {
        let ratio = inside.select(surface.index, 1.0 / surface.index);
        let cosine = direction.dot(n);
        let root = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
        let total = root.simd_lt(0.0);
        let all = three(surface.reflect_weight + surface.refract_weight);
        reflected.weight = Vec3s::choose(glass & total, all, reflected.weight);
        let through = glass & !total;
        let bent = direction.scaled(ratio).minus(n.scaled(ratio * cosine + root.sqrt())).unit();
        let passed = Ways { direction: bent, weight: three(surface.refract_weight), inside: !inside };
        refracted = Ways::choose(through, passed, refracted);
    }
    [reflected, refracted]
}
