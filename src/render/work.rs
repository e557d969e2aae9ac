//! a scene and a method -> the tables of one picture, and what they are known by

use std::ops::Range;

use super::Error;
use crate::cpu::raster::CpuRaster;
use crate::cpu::trace::CpuTrace;
use crate::film::{Film, Transfer, Watch};
use crate::gpu::wgsl::{FILES, Sources};
use crate::gpu::{self, Gpu, GpuRaster, GpuTrace};
use crate::prepare::lens::LONGEST_SIDE;
use crate::prepare::{draw, prepare};
use crate::raster;
use crate::scene::{Maps, Method, Scene};
use crate::tables::{Drawing, MOST_LENSES, NONE, Tables};
use crate::trace::{self, Part};

/// One picture, made ready: all that a backend reads.
#[derive(Debug)]
pub struct Work {
    kind: Kind,
    transfer: Transfer,
    columns: Range<u32>,
    rows: Range<u32>,
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
    /// [`Error::TooLarge`] if the rasterizer cannot reach across the film.
    pub fn new(scene: &Scene, method: Method) -> Result<Self, Error> {
        let warnings = scene.meshes.iter().flat_map(|mesh| &mesh.model.warnings);
        let mut notes: Vec<_> = warnings.map(ToString::to_string).collect();
        let [width, height] = scene.film.size;
        let kind = match method {
            Method::Trace => {
                if !scene.meshes.is_empty() {
                    notes.push("the ray tracer sees models without their maps and with flat faces".to_owned());
                }
                if scene.materials.iter().any(|material| material.maps != Maps::default()) {
                    notes
                        .push("the ray tracer does not see materials' maps; --method raster draws them".to_owned());
                }
                let tables = prepare(scene);
                let samples = 0..tables.samples;
                Kind::Traced(Box::new(tables), samples)
            }
            Method::Raster => {
                if scene.film.size.iter().any(|side| *side > LONGEST_SIDE) {
                    return Err(Error::TooLarge(scene.film.size));
                }
                let drawing = draw(scene);
                let bare = drawing.lamps.iter().filter(|lamp| lamp.lens == NONE).count();
                if bare > 0 && !drawing.faces.is_empty() {
                    notes.push(format!(
                        "{bare} lights cast no shadows: there is room for {MOST_LENSES} shadow maps, and a point light \
                         takes six"
                    ));
                }
                Kind::Drawn(Box::new(drawing))
            }
        };
        Ok(Self { kind, transfer: scene.film.transfer, columns: 0..width, rows: 0..height, notes })
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
        match &self.kind {
            Kind::Traced(tables, samples) => {
                add(bytemuck::bytes_of(&[samples.start, samples.end]));
                tables.each_bytes(&mut add);
            }
            Kind::Drawn(drawing) => drawing.each_bytes(&mut add),
        }
        Digest(hasher.finalize())
    }

    pub(super) fn on_gpu(&self, gpu: &Gpu, sources: &Sources, watch: &mut dyn Watch) -> Result<Film, gpu::Error> {
        match &self.kind {
            Kind::Traced(tables, samples) => {
                trace::part(&mut GpuTrace::new(gpu, sources, tables)?, tables, &self.part(samples), watch)
            }
            Kind::Drawn(drawing) => {
                let film = raster::frame(&mut GpuRaster::new(gpu, sources, drawing)?, drawing, watch)?;
                Ok(film.cut(self.columns.clone(), self.rows.clone()))
            }
        }
    }

    pub(super) fn on_cpu(&self, watch: &mut dyn Watch) -> Film {
        match &self.kind {
            Kind::Traced(tables, samples) => {
                let Ok(film) = trace::part(&mut CpuTrace::new(tables), tables, &self.part(samples), watch);
                film
            }
            Kind::Drawn(drawing) => {
                let Ok(film) = raster::frame(&mut CpuRaster::new(drawing), drawing, watch);
                film.cut(self.columns.clone(), self.rows.clone())
            }
        }
    }

    fn part(&self, samples: &Range<u32>) -> Part {
        Part { columns: self.columns.clone(), rows: self.rows.clone(), samples: samples.clone() }
    }
}
