//! an adapter -> the variants of the rasterizer's kernels that suit it

use crate::gpu::looks::looks;
use crate::gpu::wgsl::Sources;
use crate::gpu::{Error, Gpu, Kernel};
use crate::tables::{Drawing, NESTED};

/// Which variants of the kernels are used. None of it shows in the picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Variant {
    /// Depth and id are one word of 64 bits, so that one pass decides both; else ids are marked in a second one.
    pub wide: bool,
    /// Lanes of a subgroup hand each other what they have planned; else it goes through workgroup memory.
    pub subgroups: bool,
    /// Its divisions are rounded as Rust's are; else what hangs on one is put right by its exact rest.
    pub divides: bool,
    /// Rows of a tile that a lane has four pixels of: 1 is 64 lanes a tile, 8 is 8.
    pub rows: u32,
}

/// Lights that `shade` asks of a pixel: lavapipe ends loops after 65,535 turns without a word, and watchdogs end long
/// dispatches.
const MOST_LIGHTS: u32 = 1 << 14;

/// The stages of cut-out faces that are not those of all others: the first of two draws onto a light's image, the second
/// onto an eye's.
#[derive(Debug)]
pub(super) struct Laces {
    pub(super) split: [Kernel; 2],
    pub(super) lace: [Kernel; 2],
}

/// Lanes of a subgroup, at least, that are worth handing plans around in.
const LEAST_SEATS: u32 = 4;

/// Sums of one sample are written, and not added to.
fn once(sources: Sources, drawing: &Drawing) -> Sources {
    if drawing.samples() == 1 { sources.for_what("once") } else { sources }
}

impl Variant {
    /// What runs on every adapter.
    pub const PORTABLE: Self = Self { wide: false, subgroups: false, divides: false, rows: 1 };

    /// The fastest that the adapter has.
    #[must_use]
    pub fn of(gpu: &Gpu) -> Self {
        let has = |features| gpu.device().features().contains(features);
        Self {
            wide: has(wgpu::Features::SHADER_INT64 | wgpu::Features::SHADER_INT64_ATOMIC_MIN_MAX),
            subgroups: has(wgpu::Features::SUBGROUP) && gpu.subgroup() >= LEAST_SEATS,
            // WGSL lets a division be off by 2.5 units of the last place.
            divides: gpu.exact(),
            // A software adapter's subgroup is all that it does at once; a GPU wants some of them in flight.
            rows: if gpu.software() { 8 } else { 1 },
        }
    }

    /// The kernel of this variant, for an eye's image or for a light's.
    pub(super) fn kernel(self, gpu: &Gpu, sources: &Sources, name: &str, eye: bool) -> Result<Kernel, Error> {
        let mut sources = self.sources(sources);
        for (is, what) in [(eye, "eye"), (eye && self.wide, "wide")] {
            if is {
                sources = sources.for_what(what);
            }
        }
        Kernel::new(gpu, &sources, &format!("raster/{name}"))
    }

    /// `cut` for faces that cross a plane.
    pub(super) fn torn(self, gpu: &Gpu, sources: &Sources) -> Result<Kernel, Error> {
        Kernel::new(gpu, &self.sources(sources).for_what("torn"), "raster/cut")
    }

    /// `shade` for a drawing: what it has none of is left out, since lavapipe runs both sides of every `if`.
    pub(super) fn shader(self, gpu: &Gpu, sources: &Sources, drawing: &Drawing) -> Result<Kernel, Error> {
        let canvas = &drawing.canvas;
        if canvas.lamps > MOST_LIGHTS {
            return Err(Error::Lights { lights: canvas.lamps, most: MOST_LIGHTS });
        }
        let sources = looks(self.sources(sources), &drawing.paints, canvas.filtering, canvas.specular);
        let sources = sources.with_count("show", canvas.show).with_count("blur", canvas.blur);
        let sources = sources.with_count("lamps", canvas.lamps);
        let nested = drawing.lamps.iter().any(|lamp| lamp.kind == NESTED);
        let sources = if nested { sources.for_what("nested") } else { sources };
        Kernel::new(gpu, &once(sources, drawing).for_what("eye"), "raster/shade")
    }

    /// `ground` for a drawing.
    pub(super) fn ground(self, gpu: &Gpu, sources: &Sources, drawing: &Drawing) -> Result<Kernel, Error> {
        Kernel::new(gpu, &once(self.sources(sources), drawing), "raster/ground")
    }

    /// The stages of a drawing's cut-out faces: where the holes are hangs on how their pictures are read.
    pub(super) fn laces(self, gpu: &Gpu, sources: &Sources, drawing: &Drawing) -> Result<Laces, Error> {
        let sources = sources.clone().for_what("lace").with_count("filtering", drawing.canvas.filtering);
        let kernel = |name, eye| self.kernel(gpu, &sources, name, eye);
        Ok(Laces {
            split: [kernel("split", false)?, kernel("split", true)?],
            lace: [kernel("lace", false)?, kernel("lace", true)?],
        })
    }

    fn sources(self, sources: &Sources) -> Sources {
        let sources = sources.clone().with_count("rows", self.rows).with_count("columns", 8);
        let sources = if self.divides { sources.for_what("divides") } else { sources };
        if self.subgroups { sources.for_what("subgroups") } else { sources }
    }
}
