//! The rasterizer's stages as kernels.

mod keep;
mod look;
mod part;
mod read;
mod stages;
mod variant;

pub use variant::Variant;

use std::sync::Arc;

use bytemuck::Zeroable as _;

use super::wgsl::Sources;
use super::{Binding, Buffer, Error, Gpu, Kernel, Texels};
use crate::raster::Portions;
use crate::tables::{CELL, Canvas, Drawing, GROUP, Lens, Piece, TILE, Tally};
use part::{Bound, parts};
use variant::Laces;

/// What is nearest, on the device.
#[derive(Debug)]
pub struct GpuImage {
    words: Buffer<u32>,
    /// Of each pixel the id, then the depth; else depths alone, of all lenses that share the image one after the other.
    eye: bool,
}

/// The rasterizer on a GPU, with what its stages hand on to each other.
#[derive(Debug)]
pub struct GpuRaster<'a> {
    gpu: &'a Gpu,
    kernels: Arc<Kernels>,
    /// The stage `shade`, written out for what the drawing has.
    shader: Kernel,
    /// The stage `ground`, likewise.
    ground: Kernel,
    /// For a drawing with cut-out faces.
    laces: Option<Laces>,
    /// Whether cut-out faces are what is drawn.
    in_lace: bool,
    parts: Vec<Bound>,
    /// How the faces are divided.
    pub portions: Portions,
    /// Whether what the veil hides is hidden from the lens that was projected last.
    veiled: bool,
    lens: Buffer<Lens>,
    lenses: Texels,
    canvas: Buffer<Canvas>,
    paints: Texels,
    lamps: Texels,
    texels: Texels,
    tally: Buffer<Tally>,
    calls: Buffer<[u32; 4]>,
    /// Of `far`.
    pub cells: Buffer<u32>,
    /// Of `veil`.
    veil: Texels,
    /// Of `split`, in any order; the tally says how many.
    pub late: Buffer<u32>,
    /// Of `cut`, in any order; the tally says how many.
    pub pieces: Buffer<Piece>,
    /// Of `count` until `scan`, of `fill` after it.
    pub counts: Buffer<u32>,
    /// Of `scan`.
    pub starts: Buffer<u32>,
    /// Of `scan`, in any order; the tally says how many.
    pub busy: Buffer<u32>,
    /// Of `fill`.
    pub entries: Buffer<u32>,
    /// Of `sift`, in any order: runs that show a face from the front, the others from the end; the tally says how many.
    pub runs: Buffer<u32>,
    sums: Buffer<[f32; 4]>,
    /// What is recorded and not submitted yet.
    encoder: Option<wgpu::CommandEncoder>,
    samples: u32,
    /// Bytes that are bound at once at most.
    binding: u64,
}

/// What a window of any rectangle sees at most, in pixels, and what it or another lens sees, in tiles.
fn sizes(drawing: &Drawing) -> [usize; 2] {
    let most = drawing.most.max(1);
    let pixels = drawing.eyes.iter().map(|eye| eye.pixels().min(most)).max().unwrap_or(0);
    // Tiles that are not whole lie along two sides of a window.
    let sides = |eye: &Lens| eye.width.div_ceil(TILE) + eye.height.div_ceil(TILE);
    let tiles = |eye: &Lens| eye.tiles().min(most.div_ceil(TILE * TILE) + sides(eye) + 1);
    let tiles = drawing.eyes.iter().map(tiles).chain(drawing.lenses.iter().map(Lens::tiles)).max();
    [pixels, tiles.unwrap_or(0)].map(|count| count as usize)
}

/// Cells of a tile.
const CELLS: usize = ((TILE / CELL) * (TILE / CELL)) as usize;

/// Where there are two of one stage, the first draws onto a light's image, the second onto an eye's.
#[derive(Debug)]
struct Kernels {
    variant: Variant,
    sources: Sources,
    project: Kernel,
    far: [Kernel; 2],
    veil: Kernel,
    /// Of faces before which nothing is drawn, and of those that may be hidden.
    split: [[Kernel; 2]; 2],
    /// Of whole faces, and of those that cross a plane.
    cut: [Kernel; 2],
    call: Kernel,
    count: Kernel,
    scan: Kernel,
    fill: Kernel,
    /// Of images whose rows are read word by word, and of those that are read four at once.
    cover: [[Kernel; 2]; 2],
    mark: [Kernel; 2],
    sift: Kernel,
    crowd: Kernel,
    heat: Kernel,
}

/// Rows of the calls.
const CUT: u32 = 0;
const CUT_TORN: u32 = 1;
const SORT: u32 = 2;
const COVER: u32 = 3;
const SHADE: u32 = 4;
const GROUND: u32 = 5;

/// How much the stages may count before there has to be more room, and how much can be bound at once.
#[derive(Debug, Clone, Copy)]
pub struct Room {
    /// Faces that are not drawn at once.
    pub late: usize,
    /// Pieces of them.
    pub pieces: usize,
    /// Entries of the tiles' lists.
    pub entries: usize,
    /// Bytes of one binding.
    pub binding: u64,
}

impl Default for Room {
    fn default() -> Self {
        Self { late: 1 << 18, pieces: 1 << 16, entries: 1 << 20, binding: u64::MAX }
    }
}

impl<'a> GpuRaster<'a> {
    /// A rasterizer of one drawing with the kernels of `sources`.
    ///
    /// # Errors
    /// If a kernel's source is wrong, or the drawing does not fit the device.
    pub fn new(gpu: &'a Gpu, sources: &Sources, drawing: &Drawing) -> Result<Self, Error> {
        Self::of(gpu, sources, drawing, Variant::of(gpu))
    }

    /// The same with kernels of a certain variant.
    ///
    /// # Errors
    /// If a kernel's source is wrong, or the drawing does not fit the device, or the device has not what the variant needs.
    pub fn of(gpu: &'a Gpu, sources: &Sources, drawing: &Drawing, variant: Variant) -> Result<Self, Error> {
        let kernel = |name, eye| variant.kernel(gpu, sources, name, eye);
        let by_four = sources.clone().for_what("fours");
        let fours = |name, eye| variant.kernel(gpu, &by_four, name, eye);
        let with_veil = sources.clone().for_what("veiled");
        let veiled = |name, eye| variant.kernel(gpu, &with_veil, name, eye);
        let kernels = Kernels {
            variant,
            sources: sources.clone(),
            project: kernel("project", false)?,
            far: [kernel("far", false)?, kernel("far", true)?],
            veil: kernel("veil", false)?,
            split: [
                [kernel("split", false)?, kernel("split", true)?],
                [veiled("split", false)?, veiled("split", true)?],
            ],
            cut: [kernel("cut", false)?, variant.torn(gpu, sources)?],
            call: kernel("call", false)?,
            count: kernel("count", false)?,
            scan: kernel("scan", false)?,
            fill: kernel("fill", false)?,
            cover: [
                [kernel("cover", false)?, kernel("cover", true)?],
                [fours("cover", false)?, fours("cover", true)?],
            ],
            mark: [kernel("mark", true)?, veiled("mark", true)?],
            sift: kernel("sift", true)?,
            crowd: kernel("crowd", true)?,
            heat: kernel("heat", true)?,
        };
        Self::with(gpu, Arc::new(kernels), drawing, Room::default())
    }

    /// A rasterizer of another drawing with the same kernels, and so much room at first.
    ///
    /// # Errors
    /// If the drawing does not fit the device.
    pub fn again(&self, drawing: &Drawing, room: Room) -> Result<Self, Error> {
        Self::with(self.gpu, Arc::clone(&self.kernels), drawing, room)
    }

    fn with(gpu: &'a Gpu, kernels: Arc<Kernels>, drawing: &Drawing, room: Room) -> Result<Self, Error> {
        let [pixels, tiles] = sizes(drawing);
        let runs = pixels.div_ceil(GROUP as usize);
        let laces = drawing.laced().then(|| kernels.variant.laces(gpu, &kernels.sources, drawing)).transpose()?;
        let shader = kernels.variant.shader(gpu, &kernels.sources, drawing)?;
        let ground = kernels.variant.ground(gpu, &kernels.sources, drawing)?;
        Ok(Self {
            gpu,
            kernels,
            shader,
            ground,
            laces,
            in_lace: false,
            portions: Portions::new(drawing),
            veiled: false,
            parts: parts(gpu, drawing, room.binding)?,
            lens: gpu.uniform("lens", &Lens::zeroed())?,
            lenses: gpu.texels("lenses", &drawing.lenses)?,
            canvas: gpu.uniform("canvas", &drawing.canvas)?,
            paints: gpu.texels("paints", &drawing.paints)?,
            lamps: gpu.texels("lamps", &drawing.lamps)?,
            texels: gpu.words("texels", &drawing.texels)?,
            tally: gpu.zeroed("tally", 1)?,
            calls: gpu.calls("calls", 6)?,
            cells: gpu.zeroed("cells", CELLS * tiles)?,
            veil: gpu.blank::<[u32; 4]>("veil", CELLS * tiles)?,
            late: gpu.zeroed("late", room.late.min(drawing.faces.len()).max(1))?,
            pieces: gpu.zeroed("pieces", room.pieces)?,
            counts: gpu.zeroed("counts", 2 * tiles)?,
            starts: gpu.zeroed("starts", 2 * tiles + 1)?,
            busy: gpu.zeroed("busy", tiles)?,
            entries: gpu.zeroed("entries", room.entries)?,
            runs: gpu.zeroed("runs", runs)?,
            sums: gpu.zeroed("sums", pixels)?,
            encoder: None,
            samples: drawing.samples() as u32,
            binding: room.binding,
        })
    }

    /// Records work; it is submitted when somebody waits for it.
    fn record(
        &mut self,
        work: impl FnOnce(&Self, &mut wgpu::CommandEncoder) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let mut encoder = self.encoder.take().unwrap_or_else(|| self.gpu.encoder());
        work(self, &mut encoder)?;
        self.encoder = Some(encoder);
        Ok(())
    }

    fn split_of(&self, lace: bool, eye: bool) -> &Kernel {
        let split = &self.kernels.split[usize::from(self.veiled)];
        &self.laces.as_ref().filter(|_| lace).map_or(split, |laces| &laces.split)[usize::from(eye)]
    }

    fn recorded(&mut self) -> wgpu::CommandEncoder {
        self.encoder.take().unwrap_or_else(|| self.gpu.encoder())
    }

    /// Records `call`: what is counted says how large the next dispatches are.
    fn call(&self, encoder: &mut wgpu::CommandEncoder) -> Result<(), Error> {
        let bindings = [
            Binding::new("late", &self.late),
            Binding::new("pieces", &self.pieces),
            Binding::new("tally", &self.tally),
            Binding::new("calls", &self.calls),
        ];
        self.kernels.call.dispatch(self.gpu, encoder, &bindings, 1)?;
        Ok(())
    }

    /// Makes room for what was counted; whether there was enough.
    fn grow(&mut self, told: &Tally) -> Result<bool, Error> {
        let late = told.late.iter().sum();
        let [late, pieces, entries] = [late, told.pieces, told.entries].map(|n: u32| n as usize);
        if late > self.late.len() {
            self.late = self.gpu.zeroed("late", late)?;
        } else if pieces > self.pieces.len() {
            self.pieces = self.gpu.zeroed("pieces", pieces)?;
        } else if entries > self.entries.len() {
            self.entries = self.gpu.zeroed("entries", entries)?;
        } else {
            return Ok(true);
        }
        Ok(false)
    }
}
