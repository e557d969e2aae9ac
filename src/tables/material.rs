//! Twin of `wgsl/tables/material.wgsl`.

use glam::Vec3;

/// What a primitive is made of.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Material {
    /// Linear or display-referred, as the film's transfer says.
    pub color: Vec3,
    /// Weight of the local light (spec 2.1, step 2).
    pub local_weight: f32,
    /// The color scaled to length one: what a diffuse path is multiplied by.
    pub tint: Vec3,
    /// Weight of the reflected path (step 3).
    pub reflect_weight: f32,
    /// Weight of the refracted path (step 4).
    pub refract_weight: f32,
    /// The specular exponent k.
    pub exponent: f32,
    /// Refractive index; outside it is 1.
    pub index: f32,
    /// [`MIRROR`], [`DIFFUSE`] or [`GLASS`].
    pub behavior: u32,
}

/// Reflects in the mirror direction.
pub const MIRROR: u32 = 0;
/// Reflects anywhere in the hemisphere around the mirror direction.
pub const DIFFUSE: u32 = 1;
/// Reflects in the mirror direction and refracts.
pub const GLASS: u32 = 2;
