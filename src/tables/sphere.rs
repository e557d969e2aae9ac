//! Twin of `wgsl/tables/sphere.wgsl`.

use glam::Vec3;

/// A sphere in world space.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Sphere {
    /// In world space.
    pub center: Vec3,
    /// In world units, above zero.
    pub radius: f32,
    /// Which of the materials.
    pub material: u32,
    /// Zero: room that WGSL asks for.
    pub pad_a: u32,
    /// Zero: room that WGSL asks for.
    pub pad_b: [u32; 2],
}
