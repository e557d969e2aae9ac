//! rays -> ray trees followed to their end, or for as long as the budget lasts

use crate::cpu::trace::aim::Ray;
use crate::cpu::trace::instanced::primitive_at;
use crate::cpu::trace::surface::{Surface, surface_at};
use crate::cpu::trace::tree::{Lit, go_on, lit, turn_back};
use crate::cpu::trace::walk::Walk;
use crate::cpu::witness::Witness;
use crate::tables::{LIT, NONE, Path, SEEK, Slice, Status, Tables, Waiting};

/// What was looked up of the hit in hand: its pictures are read once, however many lights are asked.
#[derive(Debug, Clone, Copy, Default)]
pub struct Known {
    surface: Option<Surface>,
    /// The light whose shadow ray was put down.
    asked: Option<Lit>,
}

/// Follows the tree of pixel `i` of the slice; `waiting` is its stack, `max_depth` long; `walk` goes on from where a
/// walk is, for any hit or for the nearest. A tree that is put down and gone on with may keep what is `known`, or not.
#[expect(clippy::too_many_arguments, reason = "they are the kernel's, and who listens")]
pub fn follow(
    tables: &Tables,
    slice: &Slice,
    i: u32,
    path: &mut Path,
    waiting: &mut [Waiting],
    known: &mut Known,
    mut walk: impl FnMut(Ray, Walk, bool) -> Walk,
    status: &mut Status,
    witness: &mut impl Witness,
) {
    let settings = &tables.settings;
    let mut turns = 0_u32;
    while (path.state == SEEK || path.state == LIT) && turns < slice.budget {
        let mut asked = None;
        if path.state == LIT {
            let own_ray = Ray { origin: path.origin, direction: path.direction, leaves: path.leaves };
            let surface =
                &*known.surface.get_or_insert_with(|| surface_at(tables, own_ray, path.t, path.hit, witness));
            witness.met(path, path.t, surface);
            asked = known.asked.take();
            while path.light < settings.lights && turns < slice.budget && asked.is_none() {
                turns += 1;
                let light = lit(tables, path, surface, &tables.lights[path.light as usize]);
                if light.reach == 0.0 {
                    witness.light(&light, false);
                    path.light += 1;
                } else {
                    asked = Some(light);
                }
            }
            if asked.is_none() && path.light < settings.lights {
                break;
            }
            if asked.is_none() {
                go_on(tables, slice, i, surface, path, waiting, status, witness);
                known.surface = None;
            }
        }
        // The tree's own ray, or a shadow ray of its hit.
        let own = path.state == SEEK;
        let (ray, t, hit) = match &asked {
            Some(asked) => (asked.shadow, asked.reach, NONE),
            None if own => {
                let ray = Ray { origin: path.origin, direction: path.direction, leaves: path.leaves };
                (ray, path.t, path.hit)
            }
            None => break,
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
            known.asked = asked;
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
        } else if let Some(asked) = &asked {
            witness.light(asked, found.hit == NONE);
            if found.hit == NONE {
                path.radiance += asked.color;
            }
            path.light += 1;
        }
    }
    status.turns = status.turns.max(turns);
}
