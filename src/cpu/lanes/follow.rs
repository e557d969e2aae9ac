//! rays -> ray trees followed to their end, or for as long as the budget lasts: each until it asks for a walk, and then
//! all these walks side by side

use super::Walker;
use crate::cpu::trace::aim::Ray;
use crate::cpu::trace::follow::{Known, follow};
use crate::cpu::trace::walk::Walk;
use crate::tables::{Path, Slice, Status, Tables, Waiting};

/// A walk that some tree waits for.
#[derive(Debug, Clone, Copy)]
struct Asked {
    tree: usize,
    ray: Ray,
    start: Walk,
}

/// Turns that a ray counts for, whatever its walk takes.
const RAY: u32 = 16;

/// Follows the trees of pixels from `first` on; `waiting` has `max_depth` places for each.
pub(in crate::cpu) fn follow_all(
    tables: &Tables,
    slice: &Slice,
    first: u32,
    paths: &mut [Path],
    waiting: &mut [Waiting],
    walker: &mut Walker<'_>,
    status: &mut Status,
) {
    let depth = tables.settings.max_depth as usize;
    let mut found: Vec<Option<Walk>> = vec![None; paths.len()];
    let mut known = vec![Known::default(); paths.len()];
    let mut open: Vec<usize> = (0..paths.len()).collect();
    // Those for the nearest hit, and those for any.
    let mut asked: [Vec<Asked>; 2] = Default::default();
    let (mut rays, mut walks) = (Vec::new(), Vec::new());
    // A walk that nobody goes on with is as good as put down.
    let mut turns = 0;
    while !open.is_empty() && turns < slice.budget {
        turns += RAY;
        for tree in open.drain(..) {
            let waiting = &mut waiting[tree * depth..][..depth];
            let mut found = found[tree].take();
            let walk = |ray, start: Walk, any| {
                if let Some(found) = found.take() {
                    return Walk { turns: start.turns + found.turns, ..found };
                }
                // As if the walk was put down before it began.
                asked[usize::from(any)].push(Asked { tree, ray, start });
                start
            };
            let (i, path, known) = (first + tree as u32, &mut paths[tree], &mut known[tree]);
            follow(tables, slice, i, path, waiting, known, walk, status, &mut ());
        }
        for (asked, any) in asked.iter_mut().zip([false, true]) {
            rays.clear();
            rays.extend(asked.iter().map(|asked| asked.ray));
            walks.clear();
            walks.extend(asked.iter().map(|asked| Walk { turns: 0, ..asked.start }));
            walker.walk_all(&rays, &mut walks, any);
            for (asked, walk) in asked.drain(..).zip(&walks) {
                found[asked.tree] = Some(*walk);
                open.push(asked.tree);
            }
        }
    }
}
