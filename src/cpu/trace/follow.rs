//! rays -> ray trees followed to their end, or for as long as the budget lasts

use glam::{Vec2, Vec3};

use crate::cpu::shade::phong::phong;
use crate::cpu::trace::meet::Ray;
use crate::cpu::trace::scatter::{Branch, scatter};
use crate::cpu::trace::surface::{Surface, surface_at};
use crate::cpu::trace::walk::{Found, primitives, walk};
use crate::math::random::{pcg4d, unit_float};
use crate::math::vector::{largest, unit};
use crate::tables::{
    CUT_SHORT, DONE, FAR, LIT, Light, NONE, POINT, Path, SEEK, STACK_FULL, Slice, Status, Tables, Waiting,
};

/// Takes up a ray that leaves the primitive in hand.
fn take(path: &mut Path, origin: Vec3, branch: Branch, depth: u32, leaves: u32) {
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
fn turn_back(path: &mut Path, waiting: &[Waiting]) {
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
fn go_on(
    tables: &Tables,
    slice: &Slice,
    i: u32,
    surface: &Surface,
    path: &mut Path,
    waiting: &mut [Waiting],
    status: &mut Status,
) {
    let settings = &tables.settings;
    let bits = pcg4d([slice.first + i, path.sample, path.rays, tables.view.seed]);
    let random = Vec2::new(unit_float(bits[0]), unit_float(bits[1]));
    let branches = scatter(path.direction, path.inside, surface, random);
    let (mut heavy, mut light) = (branches.reflected, branches.refracted);
    heavy.weight *= path.weight;
    light.weight *= path.weight;
    if largest(light.weight) > largest(heavy.weight) {
        std::mem::swap(&mut heavy, &mut light);
    }
    if path.depth >= settings.max_depth {
        path.radiance += (heavy.weight + light.weight) * settings.background;
        turn_back(path, waiting);
        return;
    }
    if largest(light.weight) > settings.cutoff {
        if path.waiting >= settings.max_depth {
            status.flags |= STACK_FULL;
        } else {
            waiting[path.waiting as usize] = Waiting {
                origin: surface.point,
                leaves: path.hit,
                direction: light.direction,
                depth: path.depth + 1,
                weight: light.weight,
                inside: light.inside,
            };
            path.waiting += 1;
        }
    }
    if largest(heavy.weight) > settings.cutoff {
        take(path, surface.point, heavy, path.depth + 1, path.hit);
    } else {
        turn_back(path, waiting);
    }
}

/// The light that reaches the eye from one light source, before anything that stands between.
struct Lit {
    color: Vec3,
    shadow: Ray,
    /// The shadow ray counts up to here.
    reach: f32,
}

fn lit(tables: &Tables, path: &Path, surface: &Surface, source: &Light) -> Lit {
    let point_light = source.kind == POINT;
    let toward = if point_light { source.place - surface.point } else { source.place };
    let shadow = Ray { origin: surface.point, direction: toward, leaves: path.hit };
    let l = unit(toward);
    // A comparison that a light in the very point fails too: its direction is not a number.
    let lights = l.dot(surface.normal) > 0.0;
    if !lights {
        return Lit { color: Vec3::ZERO, shadow, reach: 0.0 };
    }
    let material = &surface.material;
    let [diffuse, specular] =
        phong(surface.normal, l, -path.direction, material.exponent, tables.settings.specular);
    let strength = material.local_weight * (diffuse + specular);
    let color = path.weight * (material.color * (source.power * strength));
    Lit { color, shadow, reach: if point_light { 1.0 } else { FAR } }
}

/// Follows one ray whole, with its shadow rays, and takes up the next: a turn in a scene of few primitives.
pub fn step(tables: &Tables, slice: &Slice, i: u32, path: &mut Path, waiting: &mut [Waiting], status: &mut Status) {
    let settings = &tables.settings;
    let ray = Ray { origin: path.origin, direction: path.direction, leaves: path.leaves };
    let found = walk(tables, ray, Found { t: FAR, hit: NONE, next: 0 }, primitives(tables), false);
    path.hit = found.hit;
    if path.rays == 0 {
        path.seen = found.hit;
    }
    if found.hit == NONE {
        path.radiance += path.weight * settings.background;
        turn_back(path, waiting);
        return;
    }
    let surface = surface_at(tables, ray, found.t, found.hit);
    if path.inside == 0 {
        for source in &tables.lights {
            let asked = lit(tables, path, &surface, source);
            let start = Found { t: asked.reach, hit: NONE, next: 0 };
            if asked.reach > 0.0 && walk(tables, asked.shadow, start, primitives(tables), true).hit == NONE {
                path.radiance += asked.color;
            }
        }
    }
    go_on(tables, slice, i, &surface, path, waiting, status);
}

/// Follows the tree of pixel `i` of the slice; `waiting` is its stack, `max_depth` long.
pub fn follow(
    tables: &Tables,
    slice: &Slice,
    i: u32,
    path: &mut Path,
    waiting: &mut [Waiting],
    status: &mut Status,
) {
    let settings = &tables.settings;
    let mut turns = 0_u32;
    let mut spent = false;
    while path.state == SEEK || path.state == LIT {
        turns += 1;
        if turns >= slice.budget {
            break;
        }
        let ray = Ray { origin: path.origin, direction: path.direction, leaves: path.leaves };
        if path.state == SEEK {
            let from_here = path.next;
            let end = primitives(tables).min(from_here.saturating_add(slice.budget - turns));
            let found = walk(tables, ray, Found { t: path.t, hit: path.hit, next: from_here }, end, false);
            path.t = found.t;
            path.hit = found.hit;
            path.next = found.next;
            turns += found.next - from_here;
            if found.next < end {
                status.flags |= CUT_SHORT;
            }
            if found.next < primitives(tables) {
                break;
            }
            if path.rays == 0 {
                path.seen = found.hit;
            }
            if found.hit == NONE {
                path.radiance += path.weight * settings.background;
                turn_back(path, waiting);
                continue;
            }
            path.state = LIT;
            path.next = 0;
            // Inside an object no light is asked (spec 2.1, step 2).
            path.light = if path.inside == 1 { settings.lights } else { 0 };
        }

        let surface = surface_at(tables, ray, path.t, path.hit);
        while path.light < settings.lights {
            turns += 1;
            if turns >= slice.budget {
                spent = true;
                break;
            }
            let asked = lit(tables, path, &surface, &tables.lights[path.light as usize]);
            if asked.reach > 0.0 {
                let from_here = path.next;
                let end = primitives(tables).min(from_here.saturating_add(slice.budget - turns));
                let start = Found { t: asked.reach, hit: NONE, next: from_here };
                let found = walk(tables, asked.shadow, start, end, true);
                turns += found.next - from_here;
                if found.hit == NONE {
                    if found.next < primitives(tables) {
                        path.next = found.next;
                        spent = true;
                        break;
                    }
                    path.radiance += asked.color;
                }
            }
            path.light += 1;
            path.next = 0;
        }
        if spent {
            break;
        }
        go_on(tables, slice, i, &surface, path, waiting, status);
    }
    status.turns = status.turns.max(turns);
}
