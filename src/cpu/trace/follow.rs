//! rays -> ray trees followed to their end, or for as long as the budget lasts

use glam::Vec3;

use crate::cpu::trace::aim::Ray;
use crate::cpu::trace::instanced::primitive_at;
use crate::cpu::trace::surface::surface_at;
use crate::cpu::trace::tree::{Lit, go_on, lit, turn_back};
use crate::cpu::trace::walk::Walk;
use crate::cpu::witness::Witness;
use crate::tables::{LIT, NONE, Path, SEEK, Slice, Status, Tables, Waiting};

/// Follows the tree of pixel `i` of the slice; `waiting` is its stack, `max_depth` long; `walk` goes on from where a
/// walk is, for any hit or for the nearest.
#[expect(clippy::too_many_arguments, reason = "they are the kernel's, and who listens")]
pub fn follow(
    tables: &Tables,
    slice: &Slice,
    i: u32,
    path: &mut Path,
    waiting: &mut [Waiting],
    mut walk: impl FnMut(Ray, Walk, bool) -> Walk,
    status: &mut Status,
    witness: &mut impl Witness,
) {
    let settings = &tables.settings;
    let mut turns = 0_u32;
    // Of the hit in hand: its pictures are read once, however many lights are asked.
    let mut known = None;
    while (path.state == SEEK || path.state == LIT) && turns < slice.budget {
        let own_ray = Ray { origin: path.origin, direction: path.direction, leaves: path.leaves };
        let mut asked = Lit { color: Vec3::ZERO, shadow: own_ray, reach: 0.0, phong: [0.0; 2] };
        if path.state == LIT {
            let surface = *known.get_or_insert_with(|| surface_at(tables, own_ray, path.t, path.hit, witness));
            witness.met(path, path.t, &surface);
            while path.light < settings.lights && turns < slice.budget && asked.reach == 0.0 {
                turns += 1;
                asked = lit(tables, path, &surface, &tables.lights[path.light as usize]);
                if asked.reach == 0.0 {
                    witness.light(&asked, false);
                    path.light += 1;
                }
            }
            if asked.reach == 0.0 && path.light < settings.lights {
                break;
            }
            if asked.reach == 0.0 {
                go_on(tables, slice, i, &surface, path, waiting, status, witness);
                known = None;
            }
        }
        // The tree's own ray, or a shadow ray of its hit.
        let own = path.state == SEEK;
        let (ray, t, hit) = if own {
            (Ray { origin: path.origin, direction: path.direction, leaves: path.leaves }, path.t, path.hit)
        } else if path.state == LIT {
            (asked.shadow, asked.reach, NONE)
        } else {
            break;
        };
        let start = Walk { t, hit, next: path.next, turns, flags: 0 };
        let found = walk(ray, start, !own);
        turns = found.turns;
        status.flags |= found.flags;
        if own {
            path.t = found.t;
            path.hit = found.hit;
        }
        if !found.over(tables, !own) {
            path.next = found.next;
            break;
        }
        path.next = 0;
        if own {
            if path.rays == 0 && found.hit != NONE {
                path.seen = primitive_at(tables, found.hit).leaf.id;
            }
            if found.hit == NONE {
                let light = path.weight * settings.background;
                witness.missed(path, light);
                path.radiance += light;
                turn_back(path, waiting);
            } else {
                path.state = LIT;
                // Inside an object no light is asked (spec 2.1, step 2).
                path.light = if path.inside == 1 { settings.lights } else { 0 };
            }
        } else {
            witness.light(&asked, found.hit == NONE);
            if found.hit == NONE {
                path.radiance += asked.color;
            }
            path.light += 1;
        }
    }
    status.turns = status.turns.max(turns);
}
