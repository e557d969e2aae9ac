//! rays -> ray trees that end at once, in the color of how many steps their walk takes

use crate::cpu::shade::scale::heat_of;
use crate::cpu::trace::aim::Ray;
use crate::cpu::trace::instanced::primitive_at;
use crate::cpu::trace::walk::{Walk, walk};
use crate::tables::{DONE, NONE, Path, SEEK, Status, Tables};

/// The scale's last color: more steps look the same, and so no walk has to be put down.
const MOST_STEPS: u32 = 1024;

/// Ends a path that has not met anything yet; `stack` is a walk's, `deep` long.
pub fn steps(tables: &Tables, path: &mut Path, stack: &mut [[u32; 2]], status: &mut Status) {
    if path.state != SEEK {
        return;
    }
    let ray = Ray { origin: path.origin, direction: path.direction, leaves: path.leaves };
    let start = Walk { t: path.t, hit: path.hit, next: 0, turns: 0, flags: 0 };
    let found = walk(tables, stack, ray, start, MOST_STEPS, false);
    if found.hit != NONE {
        path.seen = primitive_at(tables, found.hit).leaf.id;
    }
    path.radiance = heat_of(found.turns);
    path.state = DONE;
    status.flags |= found.flags;
    status.turns = status.turns.max(found.turns);
}
