//! Twin of `wgsl/tables/mesh.wgsl`.

use glam::Vec3;

/// A corner that faces share, in world space.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Vertex {
    /// In world space.
    pub position: Vec3,
    /// Texture coordinate to the right.
    pub u: f32,
    /// Of length one.
    pub normal: Vec3,
    /// Texture coordinate up.
    pub v: f32,
}

/// A triangle; its number is its id.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Face {
    /// First vertex; counterclockwise seen from the front.
    pub a: u32,
    /// Second vertex.
    pub b: u32,
    /// Third vertex.
    pub c: u32,
    /// Which of the paints, and [`ONE_SIDED`] and [`CUT_OUT`].
    pub paint: u32,
}

/// Faces that are bound together with their vertices: the ids from `first` on.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Part {
    /// The id of its first face.
    pub first: u32,
    /// How many it has.
    pub faces: u32,
    /// How many vertices they use.
    pub vertices: u32,
    /// How many of its faces come before those in hand; `faces` counts them too.
    pub begin: u32,
}

/// The face is not there when it is seen from its back.
pub const ONE_SIDED: u32 = 0x8000_0000;
/// The face is not there where its paint's opacity map is below a half.
pub const CUT_OUT: u32 = 0x4000_0000;
