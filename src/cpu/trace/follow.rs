//! rays -> ray trees followed to their end, or for as long as the budget lasts

use crate::cpu::trace::meet::Ray;
use crate::cpu::trace::surface::surface_at;
use crate::cpu::trace::tree::{go_on, lit, turn_back};
use crate::cpu::trace::walk::{Found, primitives, walk};
use crate::tables::{CUT_SHORT, LIT, NONE, Path, SEEK, Slice, Status, Tables, Waiting};

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
