//! the rasterizer, with what it has drawn kept: lights' depths stay while neither lights nor things change

use std::sync::atomic::{AtomicU64, Ordering::Relaxed};
use std::time::{Duration, Instant};

use super::lights::{LightMap, light_maps};
use super::{Error, Progress, Wish};
use crate::cpu::film::develop::develop;
use crate::cpu::grays::grays;
use crate::cpu::raster::{CpuRaster, Image};
use crate::gpu::wgsl::Sources;
use crate::gpu::{Gpu, GpuImage, GpuRaster, Screen};
use crate::prepare::Scenery;
use crate::raster::{Look, Raster, draw, look};
use crate::scene::{Scene, Show};
use crate::tables::{Drawing, Lens, Print};

#[derive(Debug)]
pub(super) struct Drawn<'g> {
    scenery: Scenery,
    on: On<'g>,
    /// Lights' depths as they are to be; while the eye moves, those of infinite planes may be a little off.
    lit: Lit,
    /// Which drawing of the lights' depths this is, of all that were; 0 before the first.
    lightings: u64,
    /// Samples that are drawn.
    has: usize,
    moving: bool,
    /// Pixels of the picture, across and down, that one of the film stands for while the eye moves.
    coarse: u32,
    /// Samples that took too long, one after the other, and those that left room for a finer film.
    late: u32,
    early: u32,
}

/// Drawings of lights' depths are counted through.
static LIGHTINGS: AtomicU64 = AtomicU64::new(1);

/// The most of them.
const COARSEST: u32 = 4;
/// How long a sample may take while the eye moves: of 33 ms, 30 pictures in a second, the rest is for the window.
const AT_ONCE: Duration = Duration::from_millis(28);
/// Samples in a row that took longer before the film is made coarser: one alone may be another program's fault.
const LATE: u32 = 2;
/// Samples in a row that took a third of it before a finer film is tried: a second's.
const EARLY: u32 = 30;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Lit {
    No,
    Nearly,
    Yes,
}

#[derive(Debug)]
enum On<'g> {
    Gpu { stages: Box<GpuRaster<'g>>, shadows: GpuImage, image: GpuImage },
    Cpu { sums: Vec<[f32; 4]>, shadows: Image, image: Image },
}

impl<'g> Drawn<'g> {
    pub(super) fn new(gpu: &'g Gpu, sources: &Sources, wish: &Wish) -> Result<Self, Error> {
        let mut scenery = Scenery::new(&wish.scene);
        grays(&wish.scene, &mut scenery.drawing);
        let drawing = &scenery.drawing;
        let on = match wish.side {
            super::Side::Gpu => {
                let mut stages = Box::new(GpuRaster::new(gpu, sources, drawing)?);
                let (shadows, image) = images(&mut *stages, drawing)?;
                On::Gpu { stages, shadows, image }
            }
            super::Side::Cpu => {
                let Ok((shadows, image)) = images(&mut CpuRaster::new(drawing), drawing);
                On::Cpu { sums: Vec::new(), shadows, image }
            }
        };
        Ok(Self {
            scenery,
            on,
            lit: Lit::No,
            lightings: 0,
            has: 0,
            moving: wish.moving,
            coarse: 1,
            late: 0,
            early: 0,
        })
    }

    pub(super) fn aim(&mut self, old: &Wish, new: &Wish) -> Result<bool, Error> {
        let (was, is) = (&old.scene, &new.scene);
        let tiles = |scene: &Scene| scene.raster.show == Show::Tiles;
        if tiles(was) != tiles(is) {
            return Ok(false);
        }
        // A movement that begins tries a finer film again: the machine may have had something else to do.
        if new.moving && !self.moving {
            self.coarse = (self.coarse / 2).max(1);
        }
        let coarse = if new.moving { self.coarse } else { 1 };
        let size = is.film.size.map(|side| side.div_ceil(coarse));
        self.moving = new.moving;
        let fresh = self.lit != Lit::Nearly || self.moving;
        // A wish that only says that nothing moves any more.
        if was.is(is) && self.scenery.drawing.film() == size && fresh {
            return Ok(true);
        }
        let before = std::mem::take(&mut self.scenery.drawing.lenses);
        let mut scene = is.clone();
        scene.film.size = size;
        self.scenery.aim(&scene);
        grays(&scene, &mut self.scenery.drawing);
        let drawing = &self.scenery.drawing;
        // Where the holes of cut-out faces are, and with them their shadows, hangs on how pictures are read.
        let holes = was.raster.filter != is.raster.filter && drawing.laced();
        let lights = drawing.lenses != before || holes;
        match &mut self.on {
            On::Gpu { stages, shadows, image } => {
                stages.aim(drawing, self.scenery.solid())?;
                refit(&mut **stages, drawing, lights, shadows, image)?;
            }
            On::Cpu { shadows, image, .. } => {
                let Ok(()) = refit(&mut CpuRaster::new(drawing), drawing, lights, shadows, image);
            }
        }
        if lights {
            self.lit = Lit::No;
        } else if self.lit == Lit::Yes && !is.planes.is_empty() {
            self.lit = Lit::Nearly;
        }
        self.has = 0;
        Ok(true)
    }

    pub(super) fn again(&mut self) {
        (self.has, self.lit) = (0, Lit::No);
    }

    pub(super) fn step(&mut self) -> Result<bool, Error> {
        let drawing = &self.scenery.drawing;
        // What moves is drawn with one sample a pixel, again and again.
        if self.moving && self.has > 0 {
            return Ok(false);
        }
        let Some(eye) = drawing.eyes.get(self.has) else { return Ok(false) };
        let light = self.lit == Lit::No || (self.lit == Lit::Nearly && !self.moving);
        let start = Instant::now();
        match &mut self.on {
            On::Gpu { stages, shadows, image } => {
                if self.has == 0 {
                    stages.begin();
                }
                sample(&mut **stages, drawing, eye, light, shadows, image)?;
            }
            On::Cpu { sums, shadows, image } => {
                if self.has == 0 {
                    sums.clear();
                }
                let mut stages = CpuRaster::new(drawing);
                stages.sums = std::mem::take(sums);
                let Ok(()) = sample(&mut stages, drawing, eye, light, shadows, image);
                *sums = stages.sums;
            }
        }
        if light {
            self.lit = Lit::Yes;
            self.lightings = LIGHTINGS.fetch_add(1, Relaxed);
        } else if self.moving {
            self.learn(start.elapsed());
        }
        self.has += 1;
        Ok(true)
    }

    /// Half as coarse is two to four times as much to do.
    fn learn(&mut self, took: Duration) {
        self.late = if took > AT_ONCE { self.late + 1 } else { 0 };
        self.early = if took * 3 < AT_ONCE { self.early + 1 } else { 0 };
        if self.late >= LATE {
            (self.coarse, self.late) = ((self.coarse * 2).min(COARSEST), 0);
        } else if self.early >= EARLY {
            (self.coarse, self.early) = ((self.coarse / 2).max(1), 0);
        }
    }

    pub(super) fn progress(&self) -> Progress {
        let drawing = &self.scenery.drawing;
        let target = if self.moving { 1 } else { drawing.samples() as u32 };
        Progress { has: self.has as u32, target, film: drawing.film() }
    }

    pub(super) fn lights(&mut self, known: &mut u64) -> Result<Option<Vec<LightMap>>, Error> {
        if *known == self.lightings {
            return Ok(None);
        }
        *known = self.lightings;
        let seen = match &mut self.on {
            On::Gpu { stages, shadows, .. } => stages.seen(shadows)?,
            On::Cpu { shadows, .. } => shadows.seen(),
        };
        Ok(Some(light_maps(&self.scenery.drawing, &seen.0)))
    }

    pub(super) fn show(&self, gpu: &Gpu, screen: &Screen, print: &Print) -> Result<(), Error> {
        match &self.on {
            On::Gpu { stages, .. } => screen.develop(gpu, print, stages.shaded())?,
            On::Cpu { sums, .. } => screen.put(gpu, &develop(print, sums))?,
        }
        Ok(())
    }
}

/// Room for the lights' depths and for what the eye sees.
fn images<R: Raster>(stages: &mut R, drawing: &Drawing) -> Result<(R::Image, R::Image), R::Error> {
    let pixels = drawing.eyes.iter().map(Lens::pixels).max().unwrap_or(0);
    Ok((stages.image(drawing.shadow_words(), false)?, stages.image(pixels as usize, true)?))
}

/// Other room for the lights' depths if the lights are others, and for what the eye sees.
fn refit<R: Raster>(
    stages: &mut R,
    drawing: &Drawing,
    lights: bool,
    shadows: &mut R::Image,
    image: &mut R::Image,
) -> Result<(), R::Error> {
    if lights {
        *shadows = stages.image(drawing.shadow_words(), false)?;
    }
    *image = stages.image(drawing.eyes.iter().map(Lens::pixels).max().unwrap_or(0) as usize, true)?;
    Ok(())
}

/// A sample of each pixel, and the lights' depths before it if they are wanted.
fn sample<R: Look>(
    stages: &mut R,
    drawing: &Drawing,
    eye: &Lens,
    light: bool,
    shadows: &mut R::Image,
    image: &mut R::Image,
) -> Result<(), R::Error> {
    if light {
        stages.clear(shadows)?;
        for lens in &drawing.lenses {
            draw(stages, lens, shadows)?;
        }
    }
    look(stages, drawing, eye, image, shadows)
}
