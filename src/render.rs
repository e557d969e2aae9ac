//! A scene, a method and a backend -> a film. The only place that knows both backends.

use std::time::{Duration, Instant};

use crate::cpu::trace::CpuTrace;
use crate::film::Film;
use crate::gpu::wgsl::Sources;
use crate::gpu::{self, Gpu, GpuTrace, Wanted};
use crate::prepare::prepare;
use crate::scene::{Method, Scene};
use crate::trace;

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
    /// The method is not there yet.
    #[error("the rasterizer is not part of this version; use --method trace")]
    NoRasterizer,
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
        let gpu = match (backend, Gpu::open(wanted)) {
            (Backend::Cpu, _) => None,
            (_, Ok(gpu)) => Some(gpu),
            (Backend::Auto, Err(error)) => {
                notes.push(format!("{error}; rendering on the CPU"));
                None
            }
            (Backend::Gpu, Err(error)) => return Err(error.into()),
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

    /// Renders a scene. `progress` is told the fraction done.
    ///
    /// With [`Backend::Auto`] a GPU that fails is left for the CPU, and that becomes a note.
    ///
    /// # Errors
    /// If the GPU alone is allowed and fails.
    pub fn render(
        &mut self,
        scene: &Scene,
        method: Method,
        progress: &mut dyn FnMut(f64),
    ) -> Result<Rendered, Error> {
        if method == Method::Raster {
            return Err(Error::NoRasterizer);
        }
        let tables = prepare(scene);
        let start = Instant::now();
        let mut notes = std::mem::take(&mut self.notes);
        if let Some(gpu) = &self.gpu {
            let made = GpuTrace::new(gpu, &self.sources, &tables)
                .and_then(|mut stages| trace::frame(&mut stages, &tables, progress));
            match made {
                Ok(film) => {
                    let by = gpu.adapter().name.clone();
                    return Ok(Rendered { film, by, took: start.elapsed(), notes });
                }
                Err(error) if self.backend == Backend::Auto => {
                    notes.push(format!("{error}; rendering on the CPU instead"));
                    self.gpu = None;
                }
                Err(error) => return Err(error.into()),
            }
        }
        let Ok(film) = trace::frame(&mut CpuTrace::new(&tables), &tables, progress);
        Ok(Rendered { film, by: "CPU".to_owned(), took: start.elapsed(), notes })
    }
}
