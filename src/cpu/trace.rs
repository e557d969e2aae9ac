//! Twins of `wgsl/trace`: the ray tracer's stages, over all cores.

pub mod aim;
pub mod boxes;
pub mod cast;
pub mod detail;
pub mod few;
pub mod follow;
pub mod gather;
pub mod hold;
pub mod instanced;
pub mod lay;
pub mod meet;
pub mod primary;
pub mod scatter;
pub mod seat;
pub mod solid;
pub mod stack;
pub mod steps;
pub mod surface;
pub mod tree;
pub mod triangle;
pub mod unrolled;
pub mod walk;

use std::convert::Infallible;
use std::sync::Arc;

use rayon::prelude::*;

use crate::cpu::lanes::few::Strip;
use crate::cpu::lanes::{self, LANES, Walker, Wides};
use crate::film::Run;
use crate::tables::{GROUP, IDLE, Slice, Status, Tables};
use crate::trace::{Paths, Trace};

/// Loop turns of a tree in a slice of which nobody counts them: it takes seconds at most, however many rays a tree has.
const TURNS: u32 = 1 << 12;

/// Whether a slice's trees may be followed side by side, which does not count turns as the kernels do; and the slice.
fn in_lanes(slice: &Slice) -> (bool, Slice) {
    (slice.budget == u32::MAX, Slice { budget: slice.budget.min(TURNS), ..*slice })
}

/// The ray tracer on the CPU.
#[derive(Debug)]
pub struct CpuTrace<'a> {
    tables: &'a Tables,
    wides: Arc<Wides>,
    status: Status,
}

impl<'a> CpuTrace<'a> {
    /// A tracer of one scene.
    #[must_use]
    pub fn new(tables: &'a Tables) -> Self {
        Self::with(tables, Arc::new(Wides::new(tables)))
    }

    /// The same with the tree that was made wide before, of tables with the same one.
    #[must_use]
    pub fn with(tables: &'a Tables, wides: Arc<Wides>) -> Self {
        Self { tables, wides, status: SILENT }
    }

    /// What the stages have told since the last [`Trace::settle`].
    #[must_use]
    pub fn status(&self) -> Status {
        self.status
    }
}

fn both(a: Status, b: Status) -> Status {
    Status {
        groups: a.groups + b.groups,
        pixels: a.pixels + b.pixels,
        flags: a.flags | b.flags,
        turns: a.turns.max(b.turns),
    }
}

const SILENT: Status = Status { groups: 0, pixels: 0, flags: 0, turns: 0 };
const ONE_GROUP: Status = Status { groups: 1, ..SILENT };

impl Trace for CpuTrace<'_> {
    type Paths = Paths;
    type Error = Infallible;

    fn most_pixels(&self) -> u32 {
        // 1.5 MiB of paths stay in the cache from stage to stage.
        1 << 14
    }

    fn budget(&self) -> u32 {
        u32::MAX
    }

    fn rounds(&self) -> u32 {
        1
    }

    fn begin(&mut self, run: &Run, end: u32) -> Result<Paths, Infallible> {
        Ok(Paths::of(run, end, self.tables))
    }

    fn cast(&mut self, paths: &mut Paths, slice: &Slice) -> Result<(), Infallible> {
        let group = GROUP as usize;
        let view = &self.tables.view;
        let told = paths.paths.par_chunks_mut(group).enumerate().map(|(g, paths)| {
            for (path, i) in paths.iter_mut().zip(g as u32 * GROUP..) {
                cast::cast(view, slice, i, path);
            }
            ONE_GROUP
        });
        self.status = both(self.status, told.reduce(|| SILENT, both));
        Ok(())
    }

    fn follow(&mut self, paths: &mut Paths, slice: &Slice) -> Result<(), Infallible> {
        let group = GROUP as usize;
        let (in_lanes, slice) = in_lanes(slice);
        let depth = self.tables.settings.max_depth as usize;
        let tables = self.tables;
        let deep = tables.deep as usize;
        let wides = &*self.wides;
        let stacks = paths.waiting.par_chunks_mut(group * depth).zip(paths.walks.par_chunks_mut(group * deep));
        let told =
            paths.paths.par_chunks_mut(group).zip(stacks).enumerate().map(|(g, (paths, (waiting, walks)))| {
                let mut status = ONE_GROUP;
                let first = g as u32 * GROUP;
                if in_lanes {
                    let mut walker = Walker::new(tables, wides);
                    lanes::follow::follow_all(tables, &slice, first, paths, waiting, &mut walker, &mut status);
                    return status;
                }
                let stacks = waiting.chunks_mut(depth).zip(walks.chunks_mut(deep));
                for ((path, (waiting, walk)), i) in paths.iter_mut().zip(stacks).zip(first..) {
                    let walk = |ray, start, any| walk::walk(tables, walk, ray, start, slice.budget, any);
                    let known = &mut follow::Known::default();
                    follow::follow(tables, &slice, i, path, waiting, known, walk, &mut status, &mut ());
                }
                status
            });
        self.status = both(self.status, told.reduce(|| SILENT, both));
        Ok(())
    }

    fn steps(&mut self, paths: &mut Paths, _slice: &Slice) -> Result<(), Infallible> {
        let group = GROUP as usize;
        let tables = self.tables;
        let deep = tables.deep as usize;
        let stacks = paths.walks.par_chunks_mut(group * deep);
        let told = paths.paths.par_chunks_mut(group).zip(stacks).map(|(paths, stacks)| {
            let mut status = ONE_GROUP;
            for (path, stack) in paths.iter_mut().zip(stacks.chunks_mut(deep)) {
                steps::steps(tables, path, stack, &mut status);
            }
            status
        });
        self.status = both(self.status, told.reduce(|| SILENT, both));
        Ok(())
    }

    fn gather(&mut self, paths: &mut Paths, slice: &Slice) -> Result<(), Infallible> {
        let group = GROUP as usize;
        let film = paths.sums.par_chunks_mut(group).zip(paths.squares.par_chunks_mut(group));
        let film = film.zip(paths.ids.par_chunks_mut(group));
        let told = paths.paths.par_chunks_mut(group).zip(film).map(|(paths, ((sums, squares), ids))| {
            let mut status = ONE_GROUP;
            for (((path, sum), square), id) in paths.iter_mut().zip(sums).zip(squares).zip(ids) {
                status.pixels += gather::gather(slice, path, sum, square, id);
            }
            status
        });
        self.status = both(self.status, told.reduce(|| SILENT, both));
        Ok(())
    }

    fn few(&mut self, paths: &mut Paths, slice: &Slice) -> Result<(), Infallible> {
        let (in_lanes, slice) = in_lanes(slice);
        let depth = self.tables.settings.max_depth as usize;
        let tables = self.tables;
        let group = GROUP as usize;
        let stacks = paths.waiting.par_chunks_mut(group * depth);
        let film = paths.sums.par_chunks_mut(group).zip(paths.squares.par_chunks_mut(group));
        let film = film.zip(paths.ids.par_chunks_mut(group));
        let work = paths.paths.par_chunks_mut(group).zip(stacks).zip(film).enumerate();
        let told = work.map(|(g, ((paths, stacks), ((sums, squares), ids)))| {
            let mut status = ONE_GROUP;
            let first = g as u32 * GROUP;
            let film = sums.chunks_mut(LANES).zip(squares.chunks_mut(LANES)).zip(ids.chunks_mut(LANES));
            let eights = paths.chunks_mut(LANES).zip(stacks.chunks_mut(depth * LANES)).zip(film);
            for (((paths, stacks), ((sums, squares), ids)), i) in eights.zip(0..) {
                let first = first + i * LANES as u32;
                let from = paths[0].sample;
                let together = paths.iter().all(|path| path.sample == from && path.state == IDLE);
                if together && in_lanes && from < slice.samples {
                    let film = Strip {
                        first: slice.first + first,
                        sums: &mut *sums,
                        squares: &mut *squares,
                        ids: &mut *ids,
                    };
                    let mut end = from;
                    lanes::few::few(tables, &mut end, &slice, stacks, film, &mut status);
                    for path in paths.iter_mut() {
                        path.sample = end;
                    }
                    // A sample of more turns than a slice has is put down and gone on with, pixel by pixel.
                    if end > from {
                        continue;
                    }
                }
                let film = sums.iter_mut().zip(squares).zip(ids).map(|((sum, square), id)| (sum, square, id));
                let stacks = stacks.chunks_mut(depth);
                for (((path, stack), film), i) in paths.iter_mut().zip(stacks).zip(film).zip(first..) {
                    few::few(tables, &slice, i, path, stack, film, &mut status, &mut ());
                }
            }
            status
        });
        self.status = both(self.status, told.reduce(|| SILENT, both));
        Ok(())
    }

    fn settle(&mut self, _paths: &mut Paths) -> Result<u32, Infallible> {
        let done = self.status.pixels;
        self.status = SILENT;
        Ok(done)
    }

    fn end(&mut self, paths: Paths) -> Result<Paths, Infallible> {
        Ok(paths)
    }

    fn ease(&mut self, error: Infallible) -> Result<(), Infallible> {
        Err(error)
    }
}
