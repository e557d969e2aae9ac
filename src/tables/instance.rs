//! Twin of `wgsl/tables/instance.wgsl`.

use glam::Vec3;

/// A model's own tree, placed in the world: what many instances share is there once.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Instance {
    /// The model's first axis in the world, as long as it is enlarged.
    pub x: Vec3,
    /// The root of the model's tree.
    pub root: u32,
    /// As `x`.
    pub y: Vec3,
    /// The first of the tree's leaves, whose ids are counted from 0.
    pub leaves: u32,
    /// As `x`.
    pub z: Vec3,
    /// What its leaves' ids grow by.
    pub id: u32,
    /// The model's origin in the world.
    pub origin: Vec3,
    /// The first of its faces.
    pub face: u32,
    /// The lower corner of all that lies below its tree, as the model sees it.
    pub low: Vec3,
    /// What its leaves' materials grow by.
    pub material: u32,
    /// The upper corner.
    pub high: Vec3,
    /// One over the square of how much it is enlarged.
    pub shrink: f32,
    /// How far off a surface of it rays start, in world units.
    pub margin: f32,
    /// How many leaves it has.
    pub count: u32,
    /// Zero: room that WGSL asks for.
    pub pad: [u32; 2],
}
