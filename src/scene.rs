//! What a scene file says, in a person's terms.
//!
//! [`load`] reads a TOML file; whatever is wrong with it is an [`Error`] that names the file, the line and the
//! field, what was found and what would be right. A [`Scene`] that exists can be rendered.

mod alone;
mod animate;
mod bounds;
mod draft;
mod error;
pub mod file;
mod maps;
mod mesh;
pub mod model;
mod place;
mod resolve;
mod same;
mod size;
mod source;
pub mod value;

pub(crate) use bounds::around;
pub use draft::{Draft, Held};
pub use error::Error;
pub use file::{Behavior, Filter, Method, Specular};
pub use maps::Maps;
pub use mesh::{Instance, Mesh};
pub use source::{Reach, Source, load, parse};

use glam::{Vec2, Vec3};

use crate::film::Transfer;
use crate::math::vector::unit;

/// The deepest ray tree that the stack is laid out for.
pub const DEEPEST: u32 = 32;
/// The most samples a pixel.
pub const MOST_SAMPLES: u32 = 65_536;
/// The longest side of a film, in pixels.
pub const LONGEST_SIDE: u32 = 65_536;

/// A scene that can be rendered.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// The eye.
    pub camera: Camera,
    /// What it looks onto.
    pub film: FilmSettings,
    /// How it is rendered unless one says otherwise.
    pub method: Method,
    /// How rays are traced.
    pub trace: TraceSettings,
    /// How triangles are drawn.
    pub raster: RasterSettings,
    /// What objects are made of.
    pub materials: Vec<Material>,
    /// The pictures that the materials' maps point into.
    pub textures: Vec<model::Texture>,
    /// Where light comes from.
    pub lights: Vec<Light>,
    /// Spheres, in world space.
    pub spheres: Vec<Sphere>,
    /// Infinite planes, in world space.
    pub planes: Vec<Plane>,
    /// Single triangles, in world space.
    pub triangles: Vec<Triangle>,
    /// Models.
    pub meshes: Vec<Mesh>,
}

/// The eye (spec 1.2.1), in world space.
#[derive(Debug, Clone, PartialEq)]
pub struct Camera {
    /// Where it is.
    pub position: Vec3,
    /// What it looks at.
    pub look_at: Vec3,
    /// What is up; not along the view.
    pub up: Vec3,
    /// Vertical field of view, in radians.
    pub fov: f32,
    /// Width to height of the view; the film's own unless given.
    pub aspect: Option<f32>,
    /// Distance of the near plane. The ray tracer sees from the eye on.
    pub near: f32,
    /// Distance of the far plane. The ray tracer sees to any distance.
    pub far: f32,
}

/// The film and what is done with its colors.
#[derive(Debug, Clone, PartialEq)]
pub struct FilmSettings {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// How colors become a display's numbers.
    pub transfer: Transfer,
    /// What is seen where nothing is.
    pub background: Vec3,
}

/// How rays are traced (spec part 2).
#[derive(Debug, Clone, PartialEq)]
pub struct TraceSettings {
    /// Samples a pixel; a square number lies on the spec's n x n grid.
    pub samples: u32,
    /// Rays in a branch, the primary one counted.
    pub depth: u32,
    /// Which specular term.
    pub specular: Specular,
    /// How textures are read.
    pub filter: Filter,
    /// A path whose weight is not above this is not followed.
    pub cutoff: f32,
    /// Chooses another set of random numbers.
    pub seed: u32,
}

/// How triangles are drawn (spec part 1).
#[derive(Debug, Clone, PartialEq)]
pub struct RasterSettings {
    /// Samples a pixel: a square number.
    pub samples: u32,
    /// Width and height of a light's shadow map.
    pub shadow_size: u32,
    /// What a light still counts for where it is shadowed.
    pub shadow: f32,
    /// How much farther from the light than its caster a point must lie to be shadowed, as a share of what the light's
    /// shadow map shows across there.
    pub bias: f32,
    /// Texels around a point's own that are asked for its shadow, in each direction.
    pub blur: u32,
    /// Added to every color.
    pub ambient: Vec3,
    /// Which specular term.
    pub specular: Specular,
    /// How textures are read.
    pub filter: Filter,
    /// What is shown instead of the picture.
    pub show: Show,
}

/// The picture, or one of the things that it is made of (the spec's figures 1.12 and 1.14).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, clap::ValueEnum)]
pub enum Show {
    /// The picture itself.
    #[default]
    Color,
    /// Distance from the eye: near is bright, and the grays go over what the whole picture shows.
    Depth,
    /// The share of the lights that reaches a point.
    Shadow,
    /// The shading normal.
    Normal,
    /// Texture coordinates.
    Uv,
    /// The surface's own color.
    Albedo,
    /// The ambient term.
    Ambient,
    /// The diffuse term.
    Diffuse,
    /// The specular term.
    Specular,
    /// Every face in another color.
    Id,
    /// How many faces each tile of 16 x 16 pixels has: black none, and another color for each doubling.
    Tiles,
    /// The faces' edges.
    Wire,
    /// How many boxes and primitives the ray tracer asks for each pixel's first ray: colors as for tiles.
    Steps,
}

impl Show {
    /// The method that shows it, if not both do.
    #[must_use]
    pub fn method(self) -> Option<Method> {
        match self {
            Self::Color => None,
            Self::Steps => Some(Method::Trace),
            _ => Some(Method::Raster),
        }
    }
}

/// What an object is made of.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// The name that objects call it by.
    pub name: String,
    /// Its color, linear or display-referred as the film's transfer says.
    pub color: Vec3,
    /// Weight of the light that falls on it directly.
    pub local: f32,
    /// Weight of the reflected path.
    pub reflect: f32,
    /// Weight of the refracted path.
    pub refract: f32,
    /// The specular exponent k.
    pub exponent: f32,
    /// Refractive index; outside it is 1.
    pub index: f32,
    /// Which way rays go on.
    pub behavior: Behavior,
    /// The pictures laid over it.
    pub maps: Maps,
}

/// Where light comes from (spec 1.2.2).
#[derive(Debug, Clone, PartialEq)]
pub enum Light {
    /// From a point, without fall-off.
    Point {
        /// In world space.
        position: Vec3,
        /// Color times intensity.
        power: Vec3,
    },
    /// From one direction.
    Directional {
        /// From the scene towards the light; of length one.
        toward: Vec3,
        /// Color times intensity.
        power: Vec3,
        /// What its shadows are seen by: what this does not see is lit. A box around the scene unless given.
        camera: Option<Camera>,
    },
}

/// A sphere. On a map, u runs once around y, from +x by way of -z, and v from the bottom (-y) up.
#[derive(Debug, Clone, PartialEq)]
pub struct Sphere {
    /// In world space.
    pub center: Vec3,
    /// Above zero.
    pub radius: f32,
    /// Which of the scene's materials.
    pub material: usize,
}

/// An infinite plane.
#[derive(Debug, Clone, PartialEq)]
pub struct Plane {
    /// A point of it.
    pub point: Vec3,
    /// Of length one.
    pub normal: Vec3,
    /// Which of the scene's materials.
    pub material: usize,
    /// World units of one copy of its maps.
    pub tile: f32,
}

impl Plane {
    /// The directions, of length one, in which u and v of its maps grow: to the right and up for who stands before a
    /// wall, +x and -z on a floor. (0, 0) is at [`Plane::point`], and 1 is [`Plane::tile`] from there.
    #[must_use]
    pub fn axes(&self) -> [Vec3; 2] {
        let upright = if self.normal.y.abs() < 0.9 { Vec3::Y } else { Vec3::NEG_Z };
        let right = unit(upright.cross(self.normal));
        [right, self.normal.cross(right)]
    }
}

/// A single triangle.
#[derive(Debug, Clone, PartialEq)]
pub struct Triangle {
    /// Its corners, in world space.
    pub vertices: [Vec3; 3],
    /// Which of the scene's materials.
    pub material: usize,
    /// Where its corners lie on its maps.
    pub uvs: [Vec2; 3],
}

impl Triangle {
    /// A picture's lower left half.
    pub const UVS: [Vec2; 3] = [Vec2::ZERO, Vec2::X, Vec2::Y];
}
