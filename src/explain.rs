//! A scene, a method and a pixel -> everything that made the pixel, beside the spec's equations.
//!
//! Nothing is computed a second time: the CPU twin makes the pixel again and tells a
//! [`Witness`](crate::cpu::witness::Witness) what it has in hand. So what is told is what the picture is made of, and
//! the last line is the picture's pixel to the bit.
//!
//! ```text
//! Scene -> Explainer, once; Explainer + pixel -> Explanation -> text (Display) or JSON (Serialize)
//! ```

mod caster;
mod drawn;
mod fragment;
mod place;
mod text;
mod things;
mod traced;
mod tree;

use std::sync::Arc;

use glam::Vec3;
use serde::Serialize;

use drawn::Drawn;
pub use drawn::{Corners, DrawnSample, Lit, Maps, Seen, Shadow};
pub use place::{DRAWN, Places, TRACED};
pub use things::Thing;
pub use traced::{Kind, Meeting, Onward, ShadowRay, Traced, TracedSample, Way};

use crate::cpu::grays::grays;
use crate::prepare::{self, room};
use crate::scene::{Method, Reach, Scene, Show};
use crate::tables::{Drawing, Tables};

/// Why a pixel cannot be explained.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum Error {
    /// There is no such pixel.
    #[error("pixel {},{} lies outside the picture, which has {}x{} pixels, from 0,0", .0[0], .0[1], .1[0], .1[1])]
    Outside([u32; 2], [u32; 2]),
    /// The picture shows how much there is to do, and not what is seen.
    #[error("the view of the tiles counts faces, and no pixel of it has a color of its own")]
    Tiles,
    /// The picture shows how long rays walk.
    #[error("the view of the steps counts boxes and primitives, and no light makes a pixel of it")]
    Steps,
    /// The scene is too large to be made ready.
    #[error(transparent)]
    Room(#[from] room::Error),
}

/// A scene made ready for questions about its pixels: a light's shadows are drawn once.
#[derive(Debug)]
pub struct Explainer {
    scene: Scene,
    made: Made,
}

#[derive(Debug)]
enum Made {
    Drawn(Drawn),
    Traced(Arc<Tables>),
}

/// All that made one pixel.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Explanation {
    /// Column and row, from the upper left.
    pub pixel: [u32; 2],
    /// Columns and rows of the picture.
    pub size: [u32; 2],
    /// Each sample of the pixel, in the order in which they are added.
    #[serde(flatten)]
    pub samples: Samples,
    /// The mean of the samples: the film's value, linear.
    pub linear: Vec3,
    /// What is written to a picture of 8 bits.
    pub rgb8: [u8; 3],
    /// Where the spec explains what: [`DRAWN`] or [`TRACED`].
    #[serde(serialize_with = "place::serialize")]
    pub spec: Places,
}

/// A pixel's samples, by method.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "method", content = "samples", rename_all = "lowercase")]
pub enum Samples {
    /// Of the rasterizer (spec part 1).
    Raster(Vec<DrawnSample>),
    /// Of the ray tracer (spec part 2).
    Trace(Vec<TracedSample>),
}

impl Explainer {
    /// Makes a scene ready, with no more memory than may be taken.
    ///
    /// # Errors
    /// [`Error::Tiles`] and [`Error::Steps`] if the scene shows those, [`Error::Room`] if it is too large.
    pub fn new(scene: &Scene, method: Method, reach: &Reach) -> Result<Self, Error> {
        room::within(scene, method, reach)?;
        match method {
            Method::Raster => {
                let mut drawing = prepare::draw(scene);
                grays(scene, &mut drawing);
                Self::drawn(scene, Arc::new(drawing))
            }
            Method::Trace if scene.raster.show == Show::Steps => Err(Error::Steps),
            Method::Trace => Ok(Self::traced(scene, Arc::new(prepare::prepare(scene)))),
        }
    }

    /// The same for a scene that is drawn, of whom the drawing is there already.
    ///
    /// # Errors
    /// [`Error::Tiles`] if the scene shows those.
    pub fn drawn(scene: &Scene, drawing: Arc<Drawing>) -> Result<Self, Error> {
        if scene.raster.show == Show::Tiles {
            return Err(Error::Tiles);
        }
        Ok(Self { scene: scene.clone(), made: Made::Drawn(Drawn::new(drawing)) })
    }

    /// The same for a scene that is traced, of whom the tables are there already.
    #[must_use]
    pub fn traced(scene: &Scene, tables: Arc<Tables>) -> Self {
        Self { scene: scene.clone(), made: Made::Traced(tables) }
    }

    /// Everything that made a pixel: its column and row, from the upper left.
    ///
    /// # Errors
    /// [`Error::Outside`] if there is no such pixel.
    pub fn pixel(&self, pixel: [u32; 2]) -> Result<Explanation, Error> {
        let size = self.scene.film.size;
        if pixel[0] >= size[0] || pixel[1] >= size[1] {
            return Err(Error::Outside(pixel, size));
        }
        let (samples, film, spec) = match &self.made {
            Made::Drawn(drawn) => {
                let (samples, film) = drawn.pixel(&self.scene, pixel);
                (Samples::Raster(samples), film, DRAWN)
            }
            Made::Traced(tables) => {
                let (samples, film) = traced::pixel(&self.scene, tables, pixel);
                (Samples::Trace(samples), film, TRACED)
            }
        };
        let rgb8 = film.to_rgb8(self.scene.film.transfer).get_pixel(0, 0).0;
        Ok(Explanation { pixel, size, samples, linear: film.color(0), rgb8, spec })
    }
}
