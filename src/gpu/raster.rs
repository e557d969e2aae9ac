//! The rasterizer's stages as kernels.

use std::sync::Arc;

use bytemuck::Zeroable as _;

use super::wgsl::Sources;
use super::{Binding, Buffer, Error, Gpu, Kernel};
use crate::raster::{Drawn, Raster};
use crate::tables::{
    Canvas, Corner, Drawing, Face, Lamp, Lens, MOST_ENTRIES, MOST_LENSES, Paint, Piece, Tally, Vertex,
};

/// Depths and ids on the device.
#[derive(Debug)]
pub struct GpuImage {
    /// Of all lenses that share the image, one after the other.
    pub depths: Buffer<u32>,
    /// Faces by number; none at all for shadows.
    pub ids: Buffer<u32>,
}

/// The rasterizer on a GPU, with what its stages hand on to each other.
#[derive(Debug)]
pub struct GpuRaster<'a> {
    gpu: &'a Gpu,
    kernels: Arc<Kernels>,
    lens: Buffer<Lens>,
    lenses: Buffer<Lens>,
    canvas: Buffer<Canvas>,
    vertices: Buffer<Vertex>,
    faces: Buffer<Face>,
    paints: Buffer<Paint>,
    lamps: Buffer<Lamp>,
    texels: Buffer<u32>,
    tally: Buffer<Tally>,
    /// Of [`Raster::project`].
    pub corners: Buffer<Corner>,
    /// Of [`Raster::split`], in any order; the tally says how many.
    pub pieces: Buffer<Piece>,
    /// Of [`Raster::count`] until [`Raster::scan`], of [`Raster::fill`] after it.
    pub counts: Buffer<u32>,
    /// Of [`Raster::scan`].
    pub starts: Buffer<u32>,
    /// Of [`Raster::fill`].
    pub entries: Buffer<u32>,
    sums: Buffer<[f32; 4]>,
    /// What was counted.
    pub told: Tally,
    samples: u32,
}

#[derive(Debug)]
struct Kernels {
    clear: Kernel,
    project: Kernel,
    split: Kernel,
    count: Kernel,
    scan: Kernel,
    fill: Kernel,
    cover: Kernel,
    mark: Kernel,
    shade: Kernel,
}

/// Room for pieces at first; it grows to what is counted.
const FIRST_PIECES: usize = 1024;

impl<'a> GpuRaster<'a> {
    /// A rasterizer of one drawing with the kernels of `sources`.
    ///
    /// # Errors
    /// If a kernel's source is wrong, or the drawing does not fit the device.
    pub fn new(gpu: &'a Gpu, sources: &Sources, drawing: &Drawing) -> Result<Self, Error> {
        let kernel = |name: &str| Kernel::new(gpu, sources, &format!("raster/{name}"));
        let kernels = Kernels {
            clear: kernel("clear")?,
            project: kernel("project")?,
            split: kernel("split")?,
            count: kernel("count")?,
            scan: kernel("scan")?,
            fill: kernel("fill")?,
            cover: kernel("cover")?,
            mark: kernel("mark")?,
            shade: kernel("shade")?,
        };
        Self::with(gpu, Arc::new(kernels), drawing)
    }

    /// A rasterizer of another drawing with the same kernels.
    ///
    /// # Errors
    /// If the drawing does not fit the device.
    pub fn again(&self, drawing: &Drawing) -> Result<Self, Error> {
        Self::with(self.gpu, Arc::clone(&self.kernels), drawing)
    }

    fn with(gpu: &'a Gpu, kernels: Arc<Kernels>, drawing: &Drawing) -> Result<Self, Error> {
        let mut lenses = drawing.lenses.clone();
        lenses.resize(MOST_LENSES as usize, Lens::zeroed());
        let pixels = drawing.eyes.first().map_or(0, Lens::pixels) as usize;
        Ok(Self {
            gpu,
            kernels,
            lens: gpu.uniform("lens", &Lens::zeroed())?,
            lenses: gpu.uniforms("lenses", &lenses)?,
            canvas: gpu.uniform("canvas", &drawing.canvas)?,
            vertices: gpu.upload("vertices", &drawing.vertices)?,
            faces: gpu.upload("faces", &drawing.faces)?,
            paints: gpu.upload("paints", &drawing.paints)?,
            lamps: gpu.upload("lamps", &drawing.lamps)?,
            texels: gpu.upload("texels", &drawing.texels)?,
            tally: gpu.zeroed("tally", 1)?,
            corners: gpu.zeroed("corners", drawing.vertices.len())?,
            pieces: gpu.zeroed("pieces", FIRST_PIECES)?,
            counts: gpu.zeroed("counts", 0)?,
            starts: gpu.zeroed("starts", 0)?,
            entries: gpu.zeroed("entries", 0)?,
            sums: gpu.zeroed("sums", pixels)?,
            told: Tally::default(),
            samples: drawing.eyes.len() as u32,
        })
    }

    /// Room for so many pieces at first, instead of the usual: how overflow is tested.
    ///
    /// # Errors
    /// If the device has no room.
    pub fn with_room(mut self, pieces: usize) -> Result<Self, Error> {
        self.pieces = self.gpu.zeroed("pieces", pieces)?;
        Ok(self)
    }

    /// Runs kernels of one lens, and checks that all of their workgroups ran.
    fn run(
        &mut self,
        lens: &Lens,
        record: impl FnOnce(&Self, &mut wgpu::CommandEncoder) -> Result<u32, Error>,
    ) -> Result<Tally, Error> {
        self.gpu.write(&self.lens, &[*lens]);
        self.gpu.write(&self.tally, &[Tally::default()]);
        let mut encoder = self.gpu.encoder();
        let groups = record(self, &mut encoder)?;
        let told = self.gpu.finish_and_read(encoder, &self.tally)?;
        let told = told.first().copied().unwrap_or_default();
        if told.groups != groups {
            return Err(Error::Incomplete(format!("{} of {groups} workgroups ran", told.groups)));
        }
        Ok(told)
    }

    /// A lens that knows how many pieces there are.
    fn counted(&self, lens: &Lens) -> Lens {
        Lens { pieces: self.told.pieces, ..*lens }
    }
}

impl Raster for GpuRaster<'_> {
    type Image = GpuImage;
    type Error = Error;

    fn clear(&mut self, depths: usize, ids: usize) -> Result<GpuImage, Error> {
        let image = GpuImage { depths: self.gpu.zeroed("depths", depths)?, ids: self.gpu.zeroed("ids", ids)? };
        let mut encoder = self.gpu.encoder();
        for words in [&image.depths, &image.ids] {
            let bindings = [Binding::new("words", words)];
            self.kernels.clear.dispatch(self.gpu, &mut encoder, &bindings, words.len() as u32)?;
        }
        self.gpu.finish(encoder)?;
        Ok(image)
    }

    fn project(&mut self, lens: &Lens) -> Result<(), Error> {
        self.run(lens, |this, encoder| {
            let bindings = [
                Binding::new("lens", &this.lens),
                Binding::new("vertices", &this.vertices),
                Binding::new("corners", &this.corners),
                Binding::new("tally", &this.tally),
            ];
            this.kernels.project.dispatch(this.gpu, encoder, &bindings, lens.vertices)
        })?;
        Ok(())
    }

    fn split(&mut self, lens: &Lens, image: &mut GpuImage) -> Result<(), Error> {
        loop {
            self.told = self.run(lens, |this, encoder| {
                let bindings = [
                    Binding::new("lens", &this.lens),
                    Binding::new("faces", &this.faces),
                    Binding::new("vertices", &this.vertices),
                    Binding::new("corners", &this.corners),
                    Binding::new("depths", &image.depths),
                    Binding::new("pieces", &this.pieces),
                    Binding::new("tally", &this.tally),
                ];
                this.kernels.split.dispatch(this.gpu, encoder, &bindings, lens.faces)
            })?;
            let needed = self.told.pieces as usize;
            if needed <= self.pieces.len() {
                return Ok(());
            }
            // What was drawn stays right when it is drawn again: a minimum.
            self.pieces = self.gpu.zeroed("pieces", needed)?;
        }
    }

    fn count(&mut self, lens: &Lens) -> Result<(), Error> {
        // Zero again, whatever the last lens left there.
        self.counts = self.gpu.zeroed("counts", lens.tiles() as usize)?;
        self.run(&self.counted(lens), |this, encoder| {
            let bindings = [
                Binding::new("lens", &this.lens),
                Binding::new("pieces", &this.pieces),
                Binding::new("counts", &this.counts),
                Binding::new("tally", &this.tally),
            ];
            this.kernels.count.dispatch(this.gpu, encoder, &bindings, this.told.pieces * SHARE)
        })?;
        Ok(())
    }

    fn scan(&mut self, lens: &Lens) -> Result<(), Error> {
        if self.starts.len() != lens.tiles() as usize {
            self.starts = self.gpu.zeroed("starts", lens.tiles() as usize)?;
        }
        let told = self.run(&self.counted(lens), |this, encoder| {
            let bindings = [
                Binding::new("lens", &this.lens),
                Binding::new("counts", &this.counts),
                Binding::new("starts", &this.starts),
                Binding::new("tally", &this.tally),
            ];
            this.kernels.scan.dispatch(this.gpu, encoder, &bindings, 1)
        })?;
        self.told = Tally { pieces: self.told.pieces, ..told };
        if self.entries.len() < told.entries as usize {
            self.entries = self.gpu.zeroed("entries", told.entries as usize)?;
        }
        Ok(())
    }

    fn fill(&mut self, lens: &Lens) -> Result<(), Error> {
        self.run(&self.counted(lens), |this, encoder| {
            let bindings = [
                Binding::new("lens", &this.lens),
                Binding::new("pieces", &this.pieces),
                Binding::new("starts", &this.starts),
                Binding::new("counts", &this.counts),
                Binding::new("entries", &this.entries),
                Binding::new("tally", &this.tally),
            ];
            this.kernels.fill.dispatch(this.gpu, encoder, &bindings, this.told.pieces * SHARE)
        })?;
        Ok(())
    }

    fn cover(&mut self, lens: &Lens, image: &mut GpuImage) -> Result<(), Error> {
        for round in 0..self.told.longest.div_ceil(MOST_ENTRIES) {
            let lens = Lens { round, ..self.counted(lens) };
            self.run(&lens, |this, encoder| {
                let bindings = [
                    Binding::new("lens", &this.lens),
                    Binding::new("pieces", &this.pieces),
                    Binding::new("starts", &this.starts),
                    Binding::new("counts", &this.counts),
                    Binding::new("entries", &this.entries),
                    Binding::new("depths", &image.depths),
                    Binding::new("ids", &image.ids),
                    Binding::new("tally", &this.tally),
                ];
                this.kernels.cover.dispatch(this.gpu, encoder, &bindings, lens.tiles() * 256)
            })?;
        }
        Ok(())
    }

    fn mark(&mut self, lens: &Lens, image: &mut GpuImage) -> Result<(), Error> {
        self.run(lens, |this, encoder| {
            let bindings = [
                Binding::new("lens", &this.lens),
                Binding::new("faces", &this.faces),
                Binding::new("corners", &this.corners),
                Binding::new("depths", &image.depths),
                Binding::new("ids", &image.ids),
                Binding::new("tally", &this.tally),
            ];
            this.kernels.mark.dispatch(this.gpu, encoder, &bindings, lens.faces)
        })?;
        Ok(())
    }

    fn shade(&mut self, lens: &Lens, image: &GpuImage, shadows: &GpuImage) -> Result<(), Error> {
        self.gpu.write(&self.lens, &[*lens]);
        let mut encoder = self.gpu.encoder();
        let bindings = [
            Binding::new("lens", &self.lens),
            Binding::new("canvas", &self.canvas),
            Binding::new("lenses", &self.lenses),
            Binding::new("vertices", &self.vertices),
            Binding::new("faces", &self.faces),
            Binding::new("paints", &self.paints),
            Binding::new("lamps", &self.lamps),
            Binding::new("texels", &self.texels),
            Binding::new("shadows", &shadows.depths),
            Binding::new("ids", &image.ids),
            Binding::new("sums", &self.sums),
        ];
        self.kernels.shade.dispatch(self.gpu, &mut encoder, &bindings, lens.pixels())?;
        self.gpu.finish(encoder)
    }

    fn end(&mut self, image: &GpuImage) -> Result<Drawn, Error> {
        let sums = self.gpu.read(&self.sums)?;
        let wanted = self.samples as f32;
        if let Some(short) = sums.iter().find(|sum| sum[3] != wanted) {
            return Err(Error::Incomplete(format!("a pixel has {} of {wanted} samples", short[3])));
        }
        Ok((sums, self.gpu.read(&image.ids)?))
    }
}

/// Invocations that share a piece, as in `wgsl/raster/reach.wgsl`.
const SHARE: u32 = 16;
