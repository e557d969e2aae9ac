//! a scene and a method -> the tables of one picture, and what they are known by

mod layers;

use std::ops::{ControlFlow, Range};

use super::tables::tables;
use super::{Error, Good};
use crate::cpu::grays::grays;
use crate::cpu::raster::CpuRaster;
use crate::cpu::trace::CpuTrace;
use crate::film::ledger::Subject;
use crate::film::{Band, Transfer, Watch};
use crate::gpu::wgsl::{FILES, Sources};
use crate::gpu::{self, Gpu, GpuRaster, GpuTrace};
use crate::prepare::bvh::Told;
use crate::prepare::draw;
use crate::prepare::room::{models, within};
use crate::raster;
use crate::scene::{Method, Reach, Scene};
use crate::tables::{Drawing, MOST_LENSES, NONE, Tables};
use crate::trace::{BLOCK, Part};

/// One picture, made ready: all that a backend reads.
#[derive(Debug)]
pub struct Work {
    kind: Kind,
    transfer: Transfer,
    columns: Range<u32>,
    rows: Range<u32>,
    /// When a traced picture is good enough.
    good: Good,
    /// Bytes that may be taken.
    pub(super) most: u64,
    /// What of the scene is not in the picture, a sentence each.
    pub(super) notes: Vec<String>,
}

#[derive(Debug)]
enum Kind {
    Traced(Box<Tables>, Range<u32>),
    Drawn(Box<Drawing>),
}

/// What a picture is known by: equal digests, equal pictures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Digest(blake3::Hash);

impl std::fmt::Display for Digest {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0.to_hex())
    }
}

impl Work {
    /// Makes a scene ready.
    ///
    /// # Errors
    /// [`Error::Room`] if there are more faces than this machine's memory holds, or than can be told apart.
    pub fn new(scene: &Scene, method: Method) -> Result<Self, Error> {
        Self::within(scene, method, &Reach::default())
    }

    /// Makes a scene ready with no more memory than may be taken.
    ///
    /// # Errors
    /// As [`Work::new`].
    pub fn within(scene: &Scene, method: Method, reach: &Reach) -> Result<Self, Error> {
        Self::watched(scene, method, reach, &|_| ControlFlow::Continue(()))
    }

    /// The same for who waits: `told` hears how much of the ray tracer's trees is built, of one after the other.
    ///
    /// # Errors
    /// As [`Work::new`], and [`Error::Stopped`] if `told` wants no more of it.
    pub fn watched(scene: &Scene, method: Method, reach: &Reach, told: &Told<'_>) -> Result<Self, Error> {
        within(scene, method, reach)?;
        let warnings = models(scene).into_iter().flat_map(|model| &model.warnings);
        let mut notes: Vec<_> = warnings.map(ToString::to_string).collect();
        let [width, height] = scene.film.size;
        let kind = match method {
            Method::Trace => {
                let (tables, more) = tables(scene, reach, told)?;
                notes.extend(more);
                let samples = 0..tables.samples;
                Kind::Traced(Box::new(tables), samples)
            }
            Method::Raster => {
                let mut drawing = draw(scene);
                grays(scene, &mut drawing);
                let bare = drawing.lamps.iter().filter(|lamp| lamp.lens == NONE).count();
                // Where there is nothing to cast them there are no shadow maps either.
                if bare > 0 && drawing.lenses.len() + 6 > MOST_LENSES as usize {
                    let lights = if bare == 1 { "light casts" } else { "lights cast" };
                    notes.push(format!(
                        "{bare} {lights} no shadows: there is room for {MOST_LENSES} shadow maps, and a point light \
                         takes six"
                    ));
                }
                Kind::Drawn(Box::new(drawing))
            }
        };
        let (transfer, most) = (scene.film.transfer, reach.most());
        Ok(Self { kind, transfer, columns: 0..width, rows: 0..height, good: Good::default(), most, notes })
    }

    /// The same for a rectangle of the picture alone.
    ///
    /// # Errors
    /// [`Error::Outside`] if the rectangle is not within the film.
    pub fn crop(mut self, columns: Range<u32>, rows: Range<u32>) -> Result<Self, Error> {
        let [width, height] = [self.columns.end, self.rows.end];
        if columns.is_empty() || rows.is_empty() || columns.end > width || rows.end > height {
            return Err(Error::Outside([width, height]));
        }
        (self.columns, self.rows) = (columns, rows);
        Ok(self)
    }

    /// The same until it is good enough, or has all its samples.
    ///
    /// # Errors
    /// [`Error::Untold`] if the method has no samples of its own.
    pub fn until(mut self, good: Good) -> Result<Self, Error> {
        if good == Good::default() {
            return Ok(self);
        }
        let what = if good.time.is_some() { "--time" } else { "--noise" };
        let Kind::Traced(tables, _) = &mut self.kind else { return Err(Error::Untold(what)) };
        // The first samples of a grid lie on one side of their pixel; those of a sequence lie all over it.
        tables.view.grid = 0;
        self.good = good;
        Ok(self)
    }

    /// Width and height of what is made.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        [self.columns.len() as u32, self.rows.len() as u32]
    }

    /// What the picture is known by: everything that a kernel reads, the kernels, and this program's version.
    #[must_use]
    pub fn digest(&self) -> Digest {
        let mut hasher = blake3::Hasher::new();
        let mut add = |bytes: &[u8]| {
            hasher.update(&(bytes.len() as u64).to_le_bytes());
            hasher.update(bytes);
        };
        add(env!("CARGO_PKG_VERSION").as_bytes());
        for (_, text) in FILES {
            add(text.as_bytes());
        }
        add(format!("{:?}", self.transfer).as_bytes());
        for range in [&self.columns, &self.rows] {
            add(bytemuck::bytes_of(&[range.start, range.end]));
        }
        add(format!("{:?}", self.good).as_bytes());
        match &self.kind {
            Kind::Traced(tables, samples) => {
                add(bytemuck::bytes_of(&[samples.start, samples.end]));
                tables.each_bytes(&mut add);
            }
            Kind::Drawn(drawing) => drawing.each_bytes(&mut add),
        }
        Digest(hasher.finalize())
    }

    /// The same for some of the samples alone: of the ray tracer, from a multiple of [`BLOCK`].
    ///
    /// # Errors
    /// [`Error::Samples`] if there are no such samples, or the method has none to choose from.
    pub fn samples(mut self, wanted: Range<u32>) -> Result<Self, Error> {
        let Kind::Traced(tables, samples) = &mut self.kind else { return Err(Error::Samples(0)) };
        let ends = wanted.end.is_multiple_of(BLOCK) || wanted.end == tables.samples;
        let right = wanted.start.is_multiple_of(BLOCK) && ends && wanted.start < wanted.end;
        if !right || wanted.end > tables.samples {
            return Err(Error::Samples(tables.samples));
        }
        *samples = wanted;
        Ok(self)
    }

    /// What runs of the picture belong to; nothing where none are kept.
    #[must_use]
    pub fn subject(&self, stamp: &str) -> Option<Subject> {
        let (width, all, samples) = match &self.kind {
            Kind::Traced(..) if self.good != Good::default() => return None,
            Kind::Traced(tables, samples) => (tables.view.width, tables.samples, samples.clone()),
            Kind::Drawn(drawing) => (drawing.film()[0], drawing.samples() as u32, 0..drawing.samples() as u32),
        };
        Some(Subject {
            stamp: stamp.to_owned(),
            width,
            columns: self.columns.clone(),
            rows: self.rows.clone(),
            samples: all,
            transfer: self.transfer,
            from: samples.start,
            to: samples.end,
        })
    }

    /// So many rows at a time, from the top.
    pub(super) fn on_gpu(
        &self,
        gpu: &Gpu,
        sources: &Sources,
        height: u32,
        watch: &mut dyn Watch,
        each: &mut dyn FnMut(Band) -> ControlFlow<()>,
    ) -> Result<(), gpu::Error> {
        match &self.kind {
            Kind::Traced(tables, samples) => self.good.trace(
                &mut GpuTrace::new(gpu, sources, tables)?,
                tables,
                &self.part(samples),
                height,
                watch,
                each,
            ),
            Kind::Drawn(drawing) => {
                let mut stages = GpuRaster::new(gpu, sources, drawing)?;
                raster::bands(&mut stages, drawing, &self.rectangle(), height, watch, each)
            }
        }
    }

    /// The same on the CPU.
    pub(super) fn on_cpu(&self, height: u32, watch: &mut dyn Watch, each: &mut dyn FnMut(Band) -> ControlFlow<()>) {
        let Ok(()) = match &self.kind {
            Kind::Traced(tables, samples) => {
                self.good.trace(&mut CpuTrace::new(tables), tables, &self.part(samples), height, watch, each)
            }
            Kind::Drawn(drawing) => {
                raster::bands(&mut CpuRaster::new(drawing), drawing, &self.rectangle(), height, watch, each)
            }
        };
    }

    /// Leaves room for so many rows, where they are drawn; that does not show.
    pub(super) fn draw_at_once(&mut self, rows: u32) {
        if let Kind::Drawn(drawing) = &mut self.kind {
            drawing.most = drawing.most.min(rows.saturating_mul(self.columns.len() as u32));
        }
    }

    fn rectangle(&self) -> [Range<u32>; 2] {
        [self.columns.clone(), self.rows.clone()]
    }

    fn part(&self, samples: &Range<u32>) -> Part {
        Part { columns: self.columns.clone(), rows: self.rows.clone(), samples: samples.clone() }
    }
}
