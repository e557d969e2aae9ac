//! A scene, a method and a backend -> a film. The only place that knows both backends.

mod good;
pub mod live;
mod tables;
mod work;

pub use good::Good;
pub use work::{Digest, Work};

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use crate::film::pass::{Layer, Pass};
use crate::film::{Band, Film, Run, Watch, in_ascii};
use crate::gpu::wgsl::Sources;
use crate::gpu::{self, Gpu, Wanted};
use crate::prepare::room;
use crate::scene::{Method, Scene};
use crate::trace::BLOCK;

/// Where the work is done.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, clap::ValueEnum)]
pub enum Backend {
    /// On a GPU or software adapter if there is one that works, else on the CPU.
    #[default]
    Auto,
    /// On a GPU or software adapter, or not at all.
    Gpu,
    /// On the CPU.
    Cpu,
}

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The GPU did not make it, and no other backend was allowed.
    #[error("{0}")]
    Gpu(#[from] gpu::Error),
    /// A rectangle that is not within the picture.
    #[error("the part lies outside the picture, which has {}x{} pixels", .0[0], .0[1])]
    Outside([u32; 2]),
    /// More than there is room for.
    #[error(transparent)]
    Room(#[from] room::Error),
    /// A film that there is no memory for.
    #[error(
        "a picture of {}x{} takes {needed} MiB when it is made at once, and {most} MiB of memory may be taken; .png, \
         .tga and .ppm can be made in bands, and all by --crop",
        size[0], size[1]
    )]
    Film {
        /// Its width and height.
        size: [u32; 2],
        /// MiB.
        needed: u64,
        /// MiB.
        most: u64,
    },
    /// Samples that cannot be made alone; how many there are.
    #[error("{}", no_samples(*.0))]
    Samples(u32),
    /// What needs samples that are told apart, of a method that does not.
    #[error("{0} needs samples that are made one after the other; --method trace makes them so")]
    Untold(&'static str),
    /// Whoever watched it wanted no more of it.
    #[error("stopped")]
    Stopped,
}

/// A finished film and how it came to be.
#[derive(Debug)]
pub struct Rendered {
    /// The film.
    pub film: Film,
    /// Who made it: an adapter's name, or "CPU".
    pub by: String,
    /// From the tables to the film.
    pub took: Duration,
    /// Why it was not made otherwise, a sentence each.
    pub notes: Vec<String>,
}

/// How a picture came to be that was handed on band by band.
#[derive(Debug)]
pub struct Made {
    /// Who made it: an adapter's name, or "CPU".
    pub by: String,
    /// From the tables to the last band.
    pub took: Duration,
    /// Why it was not made otherwise, a sentence each.
    pub notes: Vec<String>,
}

/// A backend that is ready. A process needs one.
#[derive(Debug)]
pub struct Renderer {
    backend: Backend,
    gpu: Option<Gpu>,
    sources: Sources,
    notes: Vec<String>,
}

impl Renderer {
    /// Makes a backend ready. With [`Backend::Auto`], why there is no GPU becomes a note.
    ///
    /// # Errors
    /// If the GPU is asked for and cannot be opened.
    pub fn open(backend: Backend, wanted: &Wanted) -> Result<Self, Error> {
        let mut notes = Vec::new();
        let gpu = match backend {
            Backend::Cpu => None,
            Backend::Gpu => Some(Gpu::open(wanted)?),
            Backend::Auto => match Gpu::open(wanted) {
                Ok(gpu) => Some(gpu),
                Err(error) => {
                    notes.push(format!("{error}; rendering on the CPU"));
                    None
                }
            },
        };
        Ok(Self { backend, gpu, sources: Sources::default(), notes })
    }

    /// The same with other kernels: how a fault is planted, or a kernel tried out.
    #[must_use]
    pub fn with_sources(mut self, sources: Sources) -> Self {
        self.sources = sources;
        self
    }

    /// The GPU, if it is the one to work.
    #[must_use]
    pub fn gpu(&self) -> Option<&Gpu> {
        self.gpu.as_ref()
    }

    /// Who makes the same bits: the CPU and the adapters that compute as it does are one class, any other is its own.
    #[must_use]
    pub fn class(&self) -> String {
        match &self.gpu {
            Some(gpu) if !gpu.exact() => in_ascii(&format!("{} {}", gpu.adapter().name, gpu.adapter().driver)),
            _ => "exact".to_owned(),
        }
    }

    /// Renders a scene. `watch` is told the fraction done, and may stop it.
    ///
    /// With [`Backend::Auto`] a GPU that fails is left for the CPU, and that becomes a note.
    ///
    /// # Errors
    /// If the GPU alone is allowed and fails, or `watch` stops the work.
    pub fn render(&mut self, scene: &Scene, method: Method, watch: &mut dyn Watch) -> Result<Rendered, Error> {
        self.make(&Work::new(scene, method)?, watch)
    }

    /// Passes of a picture that was made. Beside ids and samples they are those of each pixel's first sample.
    ///
    /// # Errors
    /// If the GPU alone is allowed and fails, or `watch` stops the work.
    pub fn layers(
        &mut self,
        work: &Work,
        film: &Film,
        wanted: &[Pass],
        watch: &mut dyn Watch,
    ) -> Result<Vec<Layer>, Error> {
        work.layers(film, wanted, |work| Ok(self.make(work, watch)?.film))
    }

    /// Does work that is made ready.
    ///
    /// # Errors
    /// If there is no memory for the film, the GPU alone is allowed and fails, or `watch` stops the work.
    pub fn make(&mut self, work: &Work, watch: &mut dyn Watch) -> Result<Rendered, Error> {
        let size = work.size();
        let needed = Film::bytes(size[0], size[1]);
        if needed > work.most {
            return Err(Error::Film { size, needed: needed.div_ceil(1 << 20), most: work.most >> 20 });
        }
        let mut film = Film::new(0, 0);
        let made = self.run(work, u32::MAX, watch, &mut |band, _| {
            film = band.film;
            ControlFlow::Continue(())
        })?;
        Ok(Rendered { film, by: made.by, took: made.took, notes: made.notes })
    }

    /// The same for a picture that is too large for one film: `each` gets so many rows at a time, from the top, and
    /// [who](Renderer::class) has made them. A GPU that fails midway is left for the CPU; if that does not make the same
    /// bits, it begins at the top again.
    ///
    /// # Errors
    /// If the GPU alone is allowed and fails, or `watch` or `each` stops the work.
    pub fn make_bands(
        &mut self,
        work: &mut Work,
        height: u32,
        watch: &mut dyn Watch,
        each: &mut dyn FnMut(Band, &str) -> ControlFlow<()>,
    ) -> Result<Made, Error> {
        work.draw_at_once(height);
        self.run(work, height, watch, each)
    }

    fn run(
        &mut self,
        work: &Work,
        height: u32,
        watch: &mut dyn Watch,
        each: &mut dyn FnMut(Band, &str) -> ControlFlow<()>,
    ) -> Result<Made, Error> {
        let start = Instant::now();
        let mut notes = std::mem::take(&mut self.notes);
        notes.extend_from_slice(&work.notes);
        let mut watch = Noticed { watch, stopped: false, alone: false };
        let (mut stopped, mut ready) = (false, 0);
        if let Some(gpu) = &self.gpu {
            let class = self.class();
            let made = work.on_gpu(gpu, &self.sources, height, &mut watch, &mut |band| {
                ready = band.top + band.film.height();
                let flow = each(band, &class);
                stopped |= flow.is_break();
                flow
            });
            match made {
                Ok(()) if watch.stopped || stopped => return Err(Error::Stopped),
                Ok(()) => return Ok(Made { by: gpu.adapter().name.clone(), took: start.elapsed(), notes }),
                Err(error) if self.backend == Backend::Auto => {
                    notes.push(format!("{error}; rendering on the CPU instead"));
                    // What another kind of adapter has made of this picture is of no use to the CPU.
                    watch.alone = !gpu.exact();
                    ready = if gpu.exact() { ready } else { 0 };
                    self.gpu = None;
                }
                Err(error) => return Err(error.into()),
            }
        }
        let class = self.class();
        work.on_cpu(height, &mut watch, &mut |band| {
            // Of bands that are ready the CPU would make the same.
            if band.top < ready {
                return ControlFlow::Continue(());
            }
            let flow = each(band, &class);
            stopped |= flow.is_break();
            flow
        });
        if watch.stopped || stopped {
            return Err(Error::Stopped);
        }
        Ok(Made { by: "CPU".to_owned(), took: start.elapsed(), notes })
    }
}

fn no_samples(all: u32) -> String {
    if all == 0 {
        return "the rasterizer's samples cannot be made apart; --method trace has sample ranges".to_owned();
    }
    format!(
        "a sample range begins and ends at multiples of {BLOCK}, or at the last of the {all} samples: 0..{BLOCK}"
    )
}

/// Passes everything on, and remembers whether the work was stopped before its end.
struct Noticed<'a> {
    watch: &'a mut dyn Watch,
    stopped: bool,
    /// Nothing is taken from an earlier try, and nothing is kept for a later one.
    alone: bool,
}

impl Watch for Noticed<'_> {
    fn done(&mut self, fraction: f64) -> ControlFlow<()> {
        let flow = self.watch.done(fraction);
        self.stopped |= flow.is_break() && fraction < 1.0;
        flow
    }

    fn kept(&mut self, first: u32) -> Option<Run> {
        if self.alone { None } else { self.watch.kept(first) }
    }

    fn keep(&mut self, run: &Run) {
        if !self.alone {
            self.watch.keep(run);
        }
    }
}
