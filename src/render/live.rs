//! a scene that is kept ready -> picture after picture of it, each a little better than the one before
//!
//! For who looks on: what was prepared for one picture serves the next, work comes in portions of some milliseconds, and
//! a picture goes to the window's texture without a way through host memory. What stands still at last is, to the bit,
//! what [`Renderer::render`](super::Renderer::render) makes.

mod drawn;
mod lights;
mod traced;

use std::ops::ControlFlow;
use std::time::Duration;

use super::Error;
use super::tables::tables;
use crate::gpu::wgsl::Sources;
use crate::gpu::{Gpu, Screen};
use crate::prepare::bvh::Told;
use crate::prepare::room::within;
use crate::scene::{Method, Reach, Scene};
use drawn::Drawn;
pub use lights::LightMap;
use traced::Traced;

/// How long a portion of work takes at most, about.
const PORTION: Duration = Duration::from_millis(20);

/// Whose kernels or twins do the work.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, clap::ValueEnum)]
pub enum Side {
    /// On the GPU.
    #[default]
    Gpu,
    /// On the CPU.
    Cpu,
}

/// What is to be seen, and how.
#[derive(Debug, Clone)]
pub struct Wish {
    /// With the size that the picture has at last.
    pub scene: Scene,
    /// How it is rendered.
    pub method: Method,
    /// Who renders it.
    pub side: Side,
    /// Whether it will soon be another: then what is quick comes first.
    pub moving: bool,
}

/// How far a picture is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Progress {
    /// Samples that each pixel has; 0 while there are fewer pixels than there will be.
    pub has: u32,
    /// Samples that it ends with.
    pub target: u32,
    /// Pixels of the film, across and down.
    pub film: [u32; 2],
}

/// A scene that is kept ready.
#[derive(Debug)]
pub struct Live<'g> {
    gpu: &'g Gpu,
    wish: Wish,
    kind: Kind<'g>,
    notes: Vec<String>,
}

#[derive(Debug)]
enum Kind<'g> {
    Drawn(Box<Drawn<'g>>),
    Traced(Box<Traced<'g>>),
}

impl<'g> Live<'g> {
    /// Makes a scene ready, with no more memory than may be taken.
    ///
    /// # Errors
    /// If there is no memory for it, or the GPU cannot do it.
    pub fn new(gpu: &'g Gpu, sources: &Sources, wish: Wish, reach: &Reach) -> Result<Self, Error> {
        Self::watched(gpu, sources, wish, reach, &|_| ControlFlow::Continue(()))
    }

    /// The same for who waits: `told` hears how much of the ray tracer's trees is built, of one after the other.
    ///
    /// # Errors
    /// As [`Live::new`], and [`Error::Stopped`] if `told` wants no more of it.
    pub fn watched(
        gpu: &'g Gpu,
        sources: &Sources,
        wish: Wish,
        reach: &Reach,
        told: &Told<'_>,
    ) -> Result<Self, Error> {
        within(&wish.scene, wish.method, reach)?;
        let mut notes = Vec::new();
        let kind = match wish.method {
            Method::Raster => Kind::Drawn(Box::new(Drawn::new(gpu, sources, &wish)?)),
            Method::Trace => {
                let (tables, more) = tables(&wish.scene, reach, told)?;
                notes = more;
                Kind::Traced(Box::new(Traced::new(gpu, sources, &wish, tables)?))
            }
        };
        Ok(Self { gpu, wish, kind, notes })
    }

    /// What was wrong on the way, a sentence each.
    #[must_use]
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// Turns to another wish, if that can be had without making everything ready anew.
    ///
    /// # Errors
    /// If the GPU cannot do it.
    pub fn aim(&mut self, wish: &Wish) -> Result<bool, Error> {
        let alike = wish.method == self.wish.method && wish.side == self.wish.side;
        if !alike || !wish.scene.has_the_things_of(&self.wish.scene) {
            return Ok(false);
        }
        let aimed = match &mut self.kind {
            Kind::Drawn(drawn) => drawn.aim(&self.wish, wish)?,
            Kind::Traced(traced) => traced.aim(&self.wish, wish)?,
        };
        if aimed {
            self.wish.clone_from(wish);
        }
        Ok(aimed)
    }

    /// Begins the picture anew, its lights too.
    ///
    /// # Errors
    /// If the GPU cannot do it.
    pub fn again(&mut self) -> Result<(), Error> {
        match &mut self.kind {
            Kind::Drawn(drawn) => drawn.again(),
            Kind::Traced(traced) => traced.again()?,
        }
        Ok(())
    }

    /// A portion of the work; whether there is a better picture now.
    ///
    /// # Errors
    /// If the GPU does not do it.
    pub fn step(&mut self) -> Result<bool, Error> {
        match &mut self.kind {
            Kind::Drawn(drawn) => drawn.step(),
            Kind::Traced(traced) => traced.step(),
        }
    }

    /// How far the picture is.
    #[must_use]
    pub fn progress(&self) -> Progress {
        match &self.kind {
            Kind::Drawn(drawn) => drawn.progress(),
            Kind::Traced(traced) => traced.progress(),
        }
    }

    /// Whether the picture is what it will be.
    #[must_use]
    pub fn done(&self) -> bool {
        let Progress { has, target, .. } = self.progress();
        has >= target
    }

    /// What the lights see, if shadows are drawn; nothing while it is what it was at `known`, which is brought up to date.
    ///
    /// # Errors
    /// If the GPU is lost or does not answer.
    pub fn lights(&mut self, known: &mut u64) -> Result<Option<Vec<LightMap>>, Error> {
        match &mut self.kind {
            Kind::Drawn(drawn) => drawn.lights(known),
            Kind::Traced(_) => Ok((std::mem::take(known) != 0).then(Vec::new)),
        }
    }

    /// Shows the picture as far as it is.
    ///
    /// # Errors
    /// If the GPU is lost or does not answer.
    pub fn show(&self, screen: &Screen) -> Result<(), Error> {
        let print = screen.print(self.progress().film, self.wish.scene.film.transfer);
        match &self.kind {
            Kind::Drawn(drawn) => drawn.show(self.gpu, screen, &print),
            Kind::Traced(traced) => traced.show(self.gpu, screen, &print),
        }
    }
}
