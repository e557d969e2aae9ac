//! a ray tree, a surface -> the light asked for there, and the next ray of the tree

use glam::{Vec2, Vec3};

use crate::cpu::shade::phong::phong;
use crate::cpu::trace::aim::Ray;
use crate::cpu::trace::scatter::{Branch, scatter};
use crate::cpu::trace::surface::{Surface, start_of};
use crate::cpu::witness::{Fork, Witness};
use crate::math::random::{pcg4d, unit_float};
use crate::math::vector::{largest, unit};
use crate::tables::{DONE, FAR, Light, NONE, POINT, Path, SEEK, STACK_FULL, Slice, Status, Tables, Waiting};

/// Takes up a ray that leaves the primitive in hand.
pub fn take(path: &mut Path, origin: Vec3, branch: Branch, depth: u32, leaves: u32) {
    path.origin = origin;
    path.leaves = leaves;
    path.direction = branch.direction;
    path.weight = branch.weight;
    path.inside = branch.inside;
    path.depth = depth;
    path.t = FAR;
    path.hit = NONE;
    path.next = 0;
    path.rays += 1;
    path.state = SEEK;
}

/// The next ray that waits, or the tree's end.
pub fn turn_back(path: &mut Path, waiting: &[Waiting]) {
    if path.waiting == 0 {
        path.state = DONE;
        return;
    }
    path.waiting -= 1;
    let back = waiting[path.waiting as usize];
    let branch = Branch { direction: back.direction, weight: back.weight, inside: back.inside };
    take(path, back.origin, branch, back.depth, back.leaves);
}

/// Follows the heavier branch and lets the lighter one wait: at most one waits for each level of the tree.
#[expect(clippy::too_many_arguments, reason = "they are the kernel's, and who listens")]
pub fn go_on(
    tables: &Tables,
    slice: &Slice,
    i: u32,
    surface: &Surface,
    path: &mut Path,
    waiting: &mut [Waiting],
    status: &mut Status,
    witness: &mut impl Witness,
) {
    let settings = &tables.settings;
    let bits = pcg4d([slice.first + i, path.sample, path.rays, tables.view.seed]);
    let random = Vec2::new(unit_float(bits[0]), unit_float(bits[1]));
    let branches = scatter(path.direction, path.inside, surface, random);
    let (mut heavy, mut light) = (branches.reflected, branches.refracted);
    heavy.weight *= path.weight;
    light.weight *= path.weight;
    let swapped = largest(light.weight) > largest(heavy.weight);
    if swapped {
        std::mem::swap(&mut heavy, &mut light);
    }
    let ways = [heavy, light];
    let [heavy_goes, light_goes] = ways.map(|way| largest(way.weight) > settings.cutoff);
    if path.depth >= settings.max_depth {
        let rest = (heavy.weight + light.weight) * settings.background;
        witness.fork(&Fork { random, ways, swapped, goes: [false; 2], ends: Some(rest) });
        path.radiance += rest;
        turn_back(path, waiting);
        return;
    }
    witness.fork(&Fork { random, ways, swapped, goes: [heavy_goes, light_goes], ends: None });
    if light_goes {
        if path.waiting >= settings.max_depth {
            status.flags |= STACK_FULL;
        } else {
            waiting[path.waiting as usize] = Waiting {
                origin: start_of(surface, light.direction),
                leaves: path.hit,
                direction: light.direction,
                depth: path.depth + 1,
                weight: light.weight,
                inside: light.inside,
            };
            path.waiting += 1;
        }
    }
    if heavy_goes {
        take(path, start_of(surface, heavy.direction), heavy, path.depth + 1, path.hit);
    } else {
        turn_back(path, waiting);
    }
}

/// The light that reaches the eye from one light source, before anything that stands between.
#[derive(Debug, Clone, Copy)]
pub struct Lit {
    /// Times the path's weight.
    pub color: Vec3,
    /// From the surface to the light.
    pub shadow: Ray,
    /// The shadow ray counts up to here.
    pub reach: f32,
    /// cos theta and cos^k alpha.
    pub phong: [f32; 2],
}

/// What `source` gives at the surface; a `reach` of 0 if it lies behind it.
#[must_use]
pub fn lit(tables: &Tables, path: &Path, surface: &Surface, source: &Light) -> Lit {
    let point_light = source.kind == POINT;
    // A light behind the surface is not asked: the ray starts before it.
    let origin = start_of(surface, surface.normal);
    let toward = if point_light { source.place - origin } else { source.place };
    let shadow = Ray { origin, direction: toward, leaves: path.hit };
    let l = unit(toward);
    // A comparison that a light in the very point fails too: its direction is not a number.
    let lights = l.dot(surface.normal) > 0.0 && l.dot(surface.shading) > 0.0;
    if !lights {
        return Lit { color: Vec3::ZERO, shadow, reach: 0.0, phong: [0.0; 2] };
    }
    let material = &surface.material;
    let [diffuse, specular] =
        phong(surface.shading, l, -path.direction, material.exponent, tables.settings.specular);
    let strength = material.local_weight * (Vec3::splat(diffuse) + surface.specular * specular);
    let color = path.weight * (material.color * (source.power * strength));
    Lit { color, shadow, reach: if point_light { 1.0 } else { FAR }, phong: [diffuse, specular] }
}
