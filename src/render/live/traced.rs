//! the ray tracer: coarse pictures first, then finer ones, then sample after sample

use std::sync::Arc;
use std::time::{Duration, Instant};

use super::{Error, PORTION, Progress, Side, Wish};
use crate::cpu::film::develop::develop;
use crate::cpu::trace::CpuTrace;
use crate::cpu::{CpuSums, Wides};
use crate::gpu::wgsl::Sources;
use crate::gpu::{Gpu, GpuPaths, GpuSums, GpuTrace, Screen};
use crate::prepare::{repaint, view};
use crate::scene::{Scene, Show};
use crate::tables::{Print, Tables};
use crate::trace::Paths;
use crate::trace::grow::Growth;

/// Pixels of the picture, across and down, that one of the coarsest film stands for.
const COARSEST: u32 = 8;
/// What is ready within this after a move is seen as ready at once.
const AT_ONCE: Duration = Duration::from_millis(60);

#[derive(Debug)]
pub(super) struct Traced<'g> {
    tables: Tables,
    /// Of the picture.
    size: [u32; 2],
    on: On<'g>,
    /// Pixels of the picture, across and down, that one of the film in hand stands for.
    coarse: u32,
    /// The same of the first film after a move.
    first: u32,
    /// When the eye moved; nothing once its first film is seen.
    moved: Option<Instant>,
}

#[derive(Debug)]
enum On<'g> {
    Gpu(Box<GpuTrace<'g>>, Option<Growth<GpuPaths, GpuSums>>),
    Cpu(Arc<Wides>, Option<Growth<Paths, CpuSums>>),
}

impl<'g> Traced<'g> {
    pub(super) fn new(gpu: &'g Gpu, sources: &Sources, wish: &Wish, tables: Tables) -> Result<Self, Error> {
        let on = match wish.side {
            Side::Gpu => On::Gpu(Box::new(GpuTrace::new(gpu, sources, &tables)?.in_slices_of(PORTION)), None),
            Side::Cpu => On::Cpu(Arc::new(Wides::new(&tables)), None),
        };
        let (size, first) = (wish.scene.film.size, COARSEST);
        let mut traced = Self { tables, size, on, coarse: first, first, moved: None };
        traced.begin(first)?;
        Ok(traced)
    }

    pub(super) fn aim(&mut self, old: &Wish, new: &Wish) -> Result<bool, Error> {
        let (was, is) = (&old.scene, &new.scene);
        if was.is(is) {
            return Ok(true);
        }
        if !sees_the_same(was, is) {
            return Ok(false);
        }
        let background = |scene: &Scene| scene.film.background;
        if was.lights != is.lights || was.materials != is.materials || background(was) != background(is) {
            repaint(&mut self.tables, is);
            if let On::Gpu(stages, _) = &mut self.on {
                stages.repaint(&self.tables)?;
            }
        }
        self.tables.view = view(is);
        self.tables.samples = is.trace.samples;
        self.size = is.film.size;
        self.moved = Some(Instant::now());
        self.begin(self.first)?;
        Ok(true)
    }

    pub(super) fn again(&mut self) -> Result<(), Error> {
        self.begin(self.first)
    }

    /// Begins a film whose pixels stand for `coarse` x `coarse` of the picture.
    fn begin(&mut self, coarse: u32) -> Result<(), Error> {
        self.coarse = coarse;
        let view = &mut self.tables.view;
        [view.width, view.height] = self.size.map(|side| side.div_ceil(coarse));
        let pixels = view.width * view.height;
        let target = if coarse > 1 { 1 } else { self.tables.samples };
        match &mut self.on {
            On::Gpu(stages, growth) => {
                stages.aim(view);
                *growth = Some(Growth::new(&mut **stages, pixels, target)?);
            }
            On::Cpu(wides, growth) => {
                let Ok(fresh) = Growth::new(&mut CpuTrace::with(&self.tables, Arc::clone(wides)), pixels, target);
                *growth = Some(fresh);
            }
        }
        Ok(())
    }

    pub(super) fn step(&mut self) -> Result<bool, Error> {
        if self.coarse > 1 && self.grown() > 0 {
            self.begin(self.coarse / 2)?;
        }
        let better = match &mut self.on {
            On::Gpu(stages, Some(growth)) => growth.step(&mut **stages, &self.tables)?,
            On::Cpu(wides, Some(growth)) => {
                let Ok(better) = growth.step(&mut CpuTrace::with(&self.tables, Arc::clone(wides)), &self.tables);
                better
            }
            _ => false,
        };
        if better && let Some(moved) = self.moved.take() {
            let took = moved.elapsed();
            if took > AT_ONCE {
                self.first = (self.first * 2).min(COARSEST);
            } else if took * 5 < AT_ONCE {
                // Half as coarse is four times as much to do.
                self.first = (self.first / 2).max(1);
            }
        }
        Ok(better)
    }

    /// Samples that all pixels of the film in hand have.
    fn grown(&self) -> u32 {
        match &self.on {
            On::Gpu(_, growth) => growth.as_ref().map_or(0, Growth::has),
            On::Cpu(_, growth) => growth.as_ref().map_or(0, Growth::has),
        }
    }

    pub(super) fn progress(&self) -> Progress {
        let has = if self.coarse > 1 { 0 } else { self.grown() };
        let view = &self.tables.view;
        Progress { has, target: self.tables.samples, film: [view.width, view.height] }
    }

    pub(super) fn show(&self, gpu: &Gpu, screen: &Screen, print: &Print) -> Result<(), Error> {
        match &self.on {
            On::Gpu(_, Some(growth)) => screen.develop(gpu, print, &growth.sums().all)?,
            On::Cpu(_, Some(growth)) => screen.put(gpu, &develop(print, &growth.sums().all))?,
            _ => {}
        }
        Ok(())
    }
}

/// Whether all that differs is the eye, the film's size and background, the number of samples, and what the lights and the
/// materials are like: what a ray meets is the same, and so are the kernels.
fn sees_the_same(a: &Scene, b: &Scene) -> bool {
    let mut film = a.film.clone();
    (film.size, film.background) = (b.film.size, b.film.background);
    let mut trace = a.trace.clone();
    trace.samples = b.trace.samples;
    let steps = |scene: &Scene| scene.raster.show == Show::Steps;
    steps(a) == steps(b)
        && film == b.film
        && trace == b.trace
        && a.materials.len() == b.materials.len()
        && a.materials.iter().zip(&b.materials).all(|(a, b)| a.behavior == b.behavior && a.maps == b.maps)
        && a.lights.len() == b.lights.len()
        && a.planes == b.planes
}
