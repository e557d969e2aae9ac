//! The scene file as it is written: TOML tables, one struct each.
//!
//! Plain tables and one array for each kind (`[[object.sphere]]`): with tagged or flattened enums an error would
//! point at the table's header instead of the line it belongs to. The doc comments are the reference of the
//! format: `scenes/scene.schema.json` is made of them.

mod animation;
mod material;
mod raster;

pub use animation::{Animation, Interpolation, Key, Orbit, Track};
pub use material::{Behavior, Material};
pub use raster::{Filter, Mesh, Raster};

use schemars::JsonSchema;
use serde::Deserialize;

use super::value::{
    Aspect, At, Color, Degrees, Depth, Direction, Exactly, Intensity, Length, Place, Position, Samples, Seed, Side,
    Weight,
};
use crate::film::Transfer;

/// A Twinlight scene.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct File {
    /// How the scene is rendered unless the command line says otherwise.
    #[serde(default)]
    pub method: Method,
    /// The eye.
    pub camera: At<Camera>,
    /// The film and what is done with its colors.
    #[serde(default)]
    pub film: Film,
    /// How rays are traced.
    #[serde(default)]
    pub trace: Trace,
    /// How triangles are drawn.
    #[serde(default)]
    pub raster: Raster,
    /// Where light comes from.
    #[serde(default)]
    pub light: Lights,
    /// What objects are made of.
    #[serde(default)]
    pub material: Vec<Material>,
    /// What there is to see.
    #[serde(default)]
    pub object: Objects,
    /// What changes from frame to frame.
    #[serde(default)]
    #[schemars(with = "Animation")]
    pub animation: Option<Animation>,
}

/// A way to render.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, serde::Serialize, JsonSchema, clap::ValueEnum,
)]
#[serde(rename_all = "lowercase")]
pub enum Method {
    /// Rays are followed from the eye.
    #[default]
    Trace,
    /// Triangles are drawn onto the film.
    Raster,
}

/// The eye (spec 1.2.1).
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Camera {
    /// Where the eye is, in world space.
    pub position: Position,
    /// The point it looks at; not the position.
    pub look_at: At<Position>,
    /// What is up in the picture; not along the view. [0, 1, 0] unless given.
    #[serde(default = "up")]
    pub up: At<Direction>,
    /// Vertical field of view, in degrees. 60 unless given.
    #[serde(default = "fov")]
    pub fov: Degrees,
    /// Width to height of the view. The film's own unless given.
    #[serde(default)]
    #[schemars(with = "Aspect")]
    pub aspect: Option<Aspect>,
    /// Distance of the near plane, for the rasterizer. 0.1 unless given.
    #[serde(default = "near")]
    pub near: Length,
    /// Distance of the far plane, beyond the near one, for the rasterizer. 1000 unless given.
    #[serde(default = "far")]
    pub far: At<Length>,
}

fn up() -> At<Direction> {
    At::nowhere(Direction(glam::Vec3::Y))
}

fn fov() -> Degrees {
    Degrees(60.0)
}

fn near() -> Length {
    Length(0.1)
}

fn far() -> At<Length> {
    At::nowhere(Length(1000.0))
}

/// The film and what is done with its colors.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Film {
    /// Width and height in pixels. [800, 600] unless given.
    pub size: At<Exactly<Side, 2>>,
    /// How colors become a display's numbers: "srgb" (linear light, encoded), or "none" (the display's own).
    pub transfer: Transfer,
    /// What is seen where nothing is. Black unless given.
    pub background: Color,
}

impl Default for Film {
    fn default() -> Self {
        Self {
            size: At::nowhere(Exactly([Side(800), Side(600)])),
            transfer: Transfer::Srgb,
            background: Color::BLACK,
        }
    }
}

/// How rays are traced (spec part 2).
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Trace {
    /// Samples a pixel. A square number lies on the spec's n x n grid: 16 is its 4 x 4. As in the spec (2.2), each lies at
    /// the lower left of its cell, where those that are drawn lie in the middle. 16 unless given.
    pub samples: Samples,
    /// How many rays in a row, the first one counted. 6 unless given.
    pub depth: Depth,
    /// The specular term: "phong" (the reflected light against the eye) or "blinn" (the half vector against the
    /// normal, as in the spec's figures). "phong" unless given.
    pub specular: Specular,
    /// How textures are read. "mipmap" unless given: the level for what the eye sees itself, and the finest for what
    /// mirrors and glass show.
    pub filter: Filter,
    /// A path that counts for no more than this is not followed. 0.0009765625 unless given.
    pub cutoff: Weight,
    /// Chooses another set of random numbers. 0 unless given.
    pub seed: Seed,
}

impl Default for Trace {
    fn default() -> Self {
        Self {
            samples: Samples(16),
            depth: Depth(6),
            specular: Specular::Phong,
            filter: Filter::Mipmap,
            cutoff: Weight(1.0 / 1024.0),
            seed: Seed(0),
        }
    }
}

/// A specular term.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, serde::Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Specular {
    /// The angle between the reflected light and the eye: the spec's text.
    #[default]
    Phong,
    /// The angle between the half vector and the normal: the spec's figures.
    Blinn,
}

/// Where light comes from (spec 1.2.2).
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Lights {
    /// Lights at a point, without fall-off.
    pub point: Vec<PointLight>,
    /// Lights so far away that they shine from one direction.
    pub directional: Vec<DirectionalLight>,
}

/// A light at a point, without fall-off.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PointLight {
    /// Where it is, in world space.
    pub position: Position,
    /// Its color. White unless given.
    #[serde(default = "white")]
    pub color: Color,
    /// How bright it is. 1 unless given.
    #[serde(default = "one")]
    pub intensity: Intensity,
}

/// A light so far away that it shines from one direction.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DirectionalLight {
    /// From the scene towards the light; of any length.
    pub toward: Direction,
    /// Its color. White unless given.
    #[serde(default = "white")]
    pub color: Color,
    /// How bright it is. 1 unless given.
    #[serde(default = "one")]
    pub intensity: Intensity,
    /// What its shadows are seen by, as the spec's pseudo camera: what it does not see is lit. Its aspect is 1 unless
    /// given. Unless it is given, a box around the scene is seen along the light.
    #[serde(default)]
    #[schemars(with = "Camera")]
    pub camera: Option<At<Camera>>,
}

fn white() -> Color {
    Color::WHITE
}

fn one() -> Intensity {
    Intensity(1.0)
}

fn unit() -> Length {
    Length(1.0)
}

/// What there is to see.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Objects {
    /// Spheres.
    pub sphere: Vec<Sphere>,
    /// Infinite planes.
    pub plane: Vec<Plane>,
    /// Single triangles.
    pub triangle: Vec<Triangle>,
    /// Models from files.
    pub mesh: Vec<Mesh>,
}

/// A sphere. A traced one is round; a drawn one is 96 x 48 faces, off by up to a thousandth of its radius between their
/// corners, and more and finer ones under things that stand on it and are small beside it.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Sphere {
    /// Its center, in world space.
    pub center: Position,
    /// Its radius, in world units.
    pub radius: Length,
    /// The name of its material.
    pub material: At<String>,
}

/// An infinite plane.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plane {
    /// Any point of it, in world space.
    pub point: Position,
    /// Its normal; of any length.
    pub normal: Direction,
    /// The name of its material.
    pub material: At<String>,
    /// World units that one copy of its material's pictures takes, across and up; a corner of one lies at `point`. 1
    /// unless given.
    #[serde(default = "unit")]
    pub tile: Length,
}

/// A single triangle.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Triangle {
    /// Its three corners, in world space; not on one line.
    pub vertices: At<Exactly<Position, 3>>,
    /// The name of its material.
    pub material: At<String>,
    /// Where its corners lie on its material's pictures: 0 to 1 from left to right, and from the bottom up. [[0, 0],
    /// [1, 0], [0, 1]] unless given.
    #[serde(default)]
    #[schemars(with = "Exactly<Exactly<Place, 2>, 3>")]
    pub uvs: Option<Exactly<Exactly<Place, 2>, 3>>,
}

/// The JSON Schema of the format, for editors.
#[must_use]
pub fn schema() -> String {
    let schema = schemars::schema_for!(File);
    // A schema is made of strings, numbers, lists and maps with string keys: all of them JSON.
    serde_json::to_string_pretty(&schema).unwrap_or_default() + "\n"
}
