//! Twin of `wgsl/tables/triangle.wgsl`.

use glam::Vec3;

/// A triangle in world space.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Triangle {
    /// First corner.
    pub a: Vec3,
    /// Which of the materials.
    pub material: u32,
    /// Second corner.
    pub b: Vec3,
    /// Zero: room that WGSL asks for.
    pub pad_b: u32,
    /// Third corner.
    pub c: Vec3,
    /// Zero: room that WGSL asks for.
    pub pad_c: u32,
}
