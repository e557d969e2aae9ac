//! Twin of `wgsl/tables/plane.wgsl`.

use glam::Vec3;

/// An infinite plane in world space.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Plane {
    /// A point of the plane.
    pub point: Vec3,
    /// Which of the materials.
    pub material: u32,
    /// Of length one.
    pub normal: Vec3,
    /// Zero: room that WGSL asks for.
    pub pad: u32,
}
