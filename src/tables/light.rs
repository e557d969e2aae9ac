//! Twin of `wgsl/tables/light.wgsl`.

use glam::Vec3;

/// A light source.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Light {
    /// A point light's position, or the unit direction towards a directional light.
    pub place: Vec3,
    /// [`POINT`] or [`DIRECTIONAL`].
    pub kind: u32,
    /// Color times intensity.
    pub power: Vec3,
    /// Zero: room that WGSL asks for.
    pub pad: u32,
}

/// Shines from a point, without fall-off.
pub const POINT: u32 = 0;
/// Shines from one direction.
pub const DIRECTIONAL: u32 = 1;
/// Shines from one direction on things that are small beside others, and has a lens for them before that for all.
pub const NESTED: u32 = 2;
