//! pixels of a scene of few primitives -> sums on the film: cast, follow and gather for sample after sample

use crate::cpu::trace::aim::Ray;
use crate::cpu::trace::cast::cast;
use crate::cpu::trace::gather::gather;
use crate::cpu::trace::tree::{go_on, lit, turn_back};
use crate::cpu::trace::unrolled::{free, nearest, surface_of};
use crate::cpu::witness::Witness;
use crate::tables::{NONE, Path, SEEK, Slice, Status, Tables, Waiting};

/// Renders pixel `i` of the slice, or as much of it as the budget allows: one turn for each sample and each ray.
#[expect(clippy::too_many_arguments, reason = "they are the kernel's, and who listens")]
pub fn few(
    tables: &Tables,
    slice: &Slice,
    i: u32,
    path: &mut Path,
    waiting: &mut [Waiting],
    film: (&mut [f32; 4], &mut f32, &mut u32),
    status: &mut Status,
    witness: &mut impl Witness,
) {
    let (sum, square, id) = film;
    let mut turns = 0;
    while path.sample < slice.samples && turns < slice.budget {
        turns += 1;
        cast(&tables.view, slice, i, path);
        while path.state == SEEK && turns < slice.budget {
            turns += 1;
            step(tables, slice, i, path, waiting, status, witness);
        }
        status.pixels += gather(slice, path, sum, square, id);
    }
    status.turns = status.turns.max(turns);
}

/// Follows one ray whole, with its shadow rays, and takes up the next: a turn in a scene of few primitives.
fn step(
    tables: &Tables,
    slice: &Slice,
    i: u32,
    path: &mut Path,
    waiting: &mut [Waiting],
    status: &mut Status,
    witness: &mut impl Witness,
) {
    let settings = &tables.settings;
    let ray = Ray { origin: path.origin, direction: path.direction, leaves: path.leaves };
    let found = nearest(tables, ray);
    path.hit = found.hit;
    if path.rays == 0 {
        path.seen = found.hit;
    }
    if found.hit == NONE {
        let light = path.weight * settings.background;
        witness.missed(path, light);
        path.radiance += light;
        turn_back(path, waiting);
        return;
    }
    let surface = surface_of(tables, ray, found.t, found.hit);
    witness.met(path, found.t, &surface);
    if path.inside == 0 {
        for source in &tables.lights {
            let asked = lit(tables, path, &surface, source);
            let arrives = asked.reach > 0.0 && free(tables, asked.shadow, asked.reach);
            witness.light(&asked, arrives);
            if arrives {
                path.radiance += asked.color;
            }
        }
    }
    go_on(tables, slice, i, &surface, path, waiting, status, witness);
}
