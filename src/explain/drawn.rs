//! a pixel of a drawing -> its samples, each with the face that is seen and all that its color comes from

use std::sync::Arc;

use glam::{DVec2, Vec2, Vec3};
use serde::Serialize;

use super::fragment::Heard;
use super::things::Thing;
use crate::cpu::raster::shade::shade;
use crate::cpu::raster::{CpuRaster, Image};
use crate::cpu::witness::{Fragment, Picture, Sight, Term};
use crate::film::Film;
use crate::raster::{Raster as _, draw, marked};
use crate::scene::Scene;
use crate::tables::{Drawing, NONE};

/// One sample of a pixel.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DrawnSample {
    /// Where it is, in pixels of the film, y down.
    pub at: Vec2,
    /// What is seen there; nothing where it is the background.
    pub seen: Option<Seen>,
    /// What is added to the pixel's sum.
    pub color: Vec3,
}

/// A face where a sample sees it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Seen {
    /// The face.
    pub thing: Thing,
    /// Its corners A, B, C in world space.
    pub corners: [Vec3; 3],
    /// The same on the film; nothing for a face that was cut at a plane of the view, since some of them are not on it.
    pub on_film: Option<Corners>,
    /// Distance along the view: the spec's Z.
    pub z: f32,
    /// What the depth test has compared, of [`DEEP`](crate::tables::DEEP); the near plane's is 0.
    pub depth: u32,
    /// What the maps say.
    pub maps: Maps,
    /// T and B of the tangent space, where a normal map asks for them.
    pub tangents: Option<[Vec3; 2]>,
    /// The point, and what it is made of.
    #[serde(flatten)]
    pub fragment: Fragment,
    /// Each light in its turn.
    pub lights: Vec<Lit>,
    /// Added to the lights.
    pub ambient: Vec3,
}

/// A face's corners on the film, and a sample among them (Eq. 1.1).
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Corners {
    /// In pixels of the film, y down, as snapped to 1/256.
    pub places: [DVec2; 3],
    /// Twice the areas that the sample spans with BC, CA and AB, in square pixels: all at least zero inside.
    pub edges: [f64; 3],
    /// alpha', beta', gamma': the edges' shares of their sum.
    pub weights: [f64; 3],
}

/// What the maps of a fragment say, as they are read.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Maps {
    /// The color, decoded.
    pub diffuse: Option<Vec3>,
    /// The weight of the specular term.
    pub specular: Option<Vec3>,
    /// The share of the exponent.
    pub exponent: Option<f32>,
    /// The normal in tangent space, as n/2 + 1/2.
    pub normal: Option<Vec3>,
}

impl Maps {
    pub(super) fn put(&mut self, of: Picture, value: Vec3) {
        match of {
            Picture::Diffuse => self.diffuse = Some(value),
            Picture::Specular => self.specular = Some(value),
            Picture::Exponent => self.exponent = Some(value.x),
            Picture::Normal => self.normal = Some(value),
        }
    }
}

/// A light at a fragment.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Lit {
    /// What the scene file calls it.
    pub light: String,
    /// Color times intensity: the spec's `I_0`.
    pub intensity: Vec3,
    /// The shadow test; nothing for a light that casts no shadow.
    pub shadow: Option<Shadow>,
    /// What it gives.
    #[serde(flatten)]
    pub term: Term,
}

/// A shadow test.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Shadow {
    /// Where the fragment is, as the light sees it.
    #[serde(flatten)]
    pub sight: Sight,
    /// Which of the light's shadow maps is asked: of a point light a direction, as `-y`; of a sun with two of them `small
    /// things` or `all`; empty where there is but one.
    pub map: &'static str,
    /// Texels along a side of the shadow map.
    pub side: u32,
    /// The depth in the fragment's texel, what the slope adds to it included; nothing where nothing was drawn.
    pub stored: Option<u32>,
    /// What the slope adds to it.
    pub bias: Option<u32>,
    /// What the depth is of.
    pub caster: Option<Thing>,
}

/// A drawing of a scene, and the depths that its lights see.
#[derive(Debug)]
pub(super) struct Drawn {
    pub(super) drawing: Arc<Drawing>,
    pub(super) shadows: Image,
}

impl Drawn {
    /// Draws the shadows.
    pub(super) fn new(drawing: Arc<Drawing>) -> Self {
        let mut stages = CpuRaster::new(&drawing);
        let Ok(mut shadows) = stages.image(drawing.shadow_words(), false);
        for lens in &drawing.lenses {
            let Ok(()) = draw(&mut stages, lens, &mut shadows);
        }
        Self { drawing, shadows }
    }

    /// The samples of a pixel, and the film of it.
    pub(super) fn pixel(&self, scene: &Scene, [x, y]: [u32; 2]) -> (Vec<DrawnSample>, Film) {
        let mut stages = CpuRaster::new(&self.drawing);
        let (mut samples, mut sum, mut first) = (Vec::new(), [0.0; 4], None);
        let grid = self.drawing.samples().isqrt();
        // No window shows: what is drawn onto one pixel alone is that pixel of the picture.
        for (i, eye) in self.drawing.windows(&[x..x + 1, y..y + 1]).iter().flatten().enumerate() {
            let Ok(mut image) = stages.image(1, true);
            let Ok(()) = draw(&mut stages, eye, &mut image);
            let Ok(()) = marked(&mut stages, eye, &mut image);
            let (depths, ids) = image.seen();
            let mut heard = Heard::default();
            shade(&self.drawing, eye, &self.shadows.nears, 0, ids[0], &mut sum, &mut heard);
            first.get_or_insert(ids[0]);
            let within = [i % grid, i / grid].map(|i| (i as f32 + 0.5) / grid as f32);
            let at = Vec2::new(x as f32 + within[0], y as f32 + within[1]);
            let color = heard.color;
            let seen = heard.seen(self, scene, eye, at, ids[0], depths[0]);
            samples.push(DrawnSample { at, seen, color });
        }
        let mut film = Film::new(1, 1);
        film.put(0, &[sum], &[first.unwrap_or(NONE)]);
        (samples, film)
    }
}
