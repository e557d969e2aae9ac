//! Twin of `wgsl/tables/paint.wgsl`.

use glam::{Vec2, Vec3};

/// A picture laid over faces: texel at `uv * scale + shift`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Map {
    /// Its first texel; finest level first, each row by row from the top. [`NONE`](super::NONE): no picture.
    pub first: u32,
    /// Texels in a row of the finest level.
    pub width: u32,
    /// Rows of the finest level.
    pub height: u32,
    /// How many levels, each half as wide and high as the one before; with [`CLAMPED`] where its edge goes on for ever,
    /// instead of the picture repeating.
    pub levels: u32,
    /// Times the texture coordinates.
    pub scale: Vec2,
    /// Added to them.
    pub shift: Vec2,
}

/// What a face is made of.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Paint {
    /// Times the diffuse map.
    pub color: Vec3,
    /// The specular exponent; times the exponent map, if there is one.
    pub exponent: f32,
    /// Weight of the specular term; times the specular map.
    pub specular: Vec3,
    /// Times x and y of the normal map.
    pub bump: f32,
    /// Colors, decoded by the curve at the head of the texels.
    pub diffuse_map: Map,
    /// Normals in tangent space.
    pub normal_map: Map,
    /// Weights.
    pub specular_map: Map,
    /// Shares of the exponent, in red.
    pub exponent_map: Map,
    /// Opacities, in alpha.
    pub opacity_map: Map,
}

impl Paint {
    /// Whether no picture is laid over it.
    #[must_use]
    pub fn is_bare(&self) -> bool {
        let maps = [self.diffuse_map, self.normal_map, self.specular_map, self.exponent_map];
        maps.iter().all(|map| map.first == super::NONE)
    }
}

/// A light and the lenses that it sees the scene through.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Lamp {
    /// A point light's position, or the unit direction towards a directional light.
    pub place: Vec3,
    /// [`POINT`](super::POINT), [`DIRECTIONAL`](super::DIRECTIONAL) or [`NESTED`](super::NESTED).
    pub kind: u32,
    /// Color times intensity.
    pub power: Vec3,
    /// The first of its lenses: one, two if nested, or six for a point light (+x -x +y -y +z -z). [`NONE`](super::NONE): no shadow.
    pub lens: u32,
}

impl Lamp {
    /// What its lenses show, in their order; nothing to tell of a single one.
    #[must_use]
    pub const fn sides(&self) -> &'static [&'static str] {
        match self.kind {
            super::POINT => &["+x", "-x", "+y", "-y", "+z", "-z"],
            super::NESTED => &["small things", "all"],
            _ => &[""],
        }
    }
}

/// How pixels are colored.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Canvas {
    /// The eye in world space.
    pub eye: Vec3,
    /// How many there are.
    pub lamps: u32,
    /// What is seen where nothing is.
    pub background: Vec3,
    /// [`PHONG`](super::PHONG) or [`BLINN`](super::BLINN).
    pub specular: u32,
    /// Added to every color.
    pub ambient: Vec3,
    /// What a shadowed light counts for.
    pub shade: f32,
    /// [`NEAREST`], [`BILINEAR`] or [`MIPMAP`].
    pub filtering: u32,
    /// Texels around a point's own that are asked for its shadow, in each direction.
    pub blur: u32,
    /// What is shown: [`SHOW_COLOR`] or one of its ingredients.
    pub show: u32,
    /// Where depths are shown, what is shown is this over the distance along the axis of the eye,
    pub depth_times: f32,
    /// and this added,
    pub depth_plus: f32,
    /// and no less than this, and no more than that.
    pub depth_least: f32,
    /// See [`Canvas::depth_least`].
    pub depth_most: f32,
    /// Nothing.
    pub pad: u32,
}

/// The bit of [`Map::levels`] that says that a picture does not repeat.
pub const CLAMPED: u32 = 1 << 31;
/// The nearest texel.
pub const NEAREST: u32 = 0;
/// The four nearest texels.
pub const BILINEAR: u32 = 1;
/// The four nearest texels of the two levels nearest in size.
pub const MIPMAP: u32 = 2;
/// The picture itself.
pub const SHOW_COLOR: u32 = 0;
/// Near is bright.
pub const SHOW_DEPTH: u32 = 1;
/// The share of the lights that reach a point.
pub const SHOW_SHADOW: u32 = 2;
/// The shading normal as a color.
pub const SHOW_NORMAL: u32 = 3;
/// Texture coordinates in red and green.
pub const SHOW_UV: u32 = 4;
/// The surface's own color.
pub const SHOW_ALBEDO: u32 = 5;
/// The ambient term alone.
pub const SHOW_AMBIENT: u32 = 6;
/// The diffuse term alone.
pub const SHOW_DIFFUSE: u32 = 7;
/// The specular term alone.
pub const SHOW_SPECULAR: u32 = 8;
/// Every face another color.
pub const SHOW_ID: u32 = 9;
/// How many faces each tile has.
pub const SHOW_TILES: u32 = 10;
/// The faces' edges.
pub const SHOW_WIRE: u32 = 11;
