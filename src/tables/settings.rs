//! Twin of `wgsl/tables/settings.wgsl`.

use glam::Vec3;

/// What is the same for every ray of a frame.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Settings {
    /// The light of rays that meet nothing, or are beyond the depth.
    pub background: Vec3,
    /// Rays in a branch, the primary one counted.
    pub max_depth: u32,
    /// How many of the scene's primitives, from number 0.
    pub spheres: u32,
    /// How many of them after the spheres; in the leaves they are the first.
    pub planes: u32,
    /// How many there are.
    pub lights: u32,
    /// [`PHONG`] or [`BLINN`].
    pub specular: u32,
    /// The lower corner of all that lies below nodes.
    pub low: Vec3,
    /// A path whose weight is not above this is not followed.
    pub cutoff: f32,
    /// The upper corner.
    pub high: Vec3,
    /// Zero, which no compiler can know: see `wgsl/math/fence.wgsl`.
    pub zero: u32,
    /// [`NEAREST`](super::NEAREST), [`BILINEAR`](super::BILINEAR) or [`MIPMAP`](super::MIPMAP).
    pub filtering: u32,
    /// Copies of models whose trees are shared.
    pub instances: u32,
    /// Primitives with ids from this on are theirs.
    pub loose: u32,
    /// Zero: room that WGSL asks for.
    pub pad: u32,
}

/// The reflected light against the eye: the spec's text.
pub const PHONG: u32 = 0;
/// The half vector against the normal: the spec's figures 2.4 - 2.6.
pub const BLINN: u32 = 1;
/// No primitive.
pub const NONE: u32 = u32::MAX;
