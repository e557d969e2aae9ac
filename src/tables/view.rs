//! Twin of `wgsl/tables/view.wgsl`.

use glam::Vec3;

/// The eye and the film: where a ray starts and which way it goes (spec 1.2.1 and 2.2).
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct View {
    /// The eye in world space.
    pub eye: Vec3,
    /// Pixels in a row.
    pub width: u32,
    /// Across the film plane at distance one, edge to edge, in world space.
    pub right: Vec3,
    /// Rows.
    pub height: u32,
    /// Up the film plane at distance one, edge to edge, in world space.
    pub up: Vec3,
    /// Samples along a pixel's side, or 0: then sample k lies at point k of a low-discrepancy sequence.
    pub grid: u32,
    /// From what is looked at to the eye, of length one: the spec's D.
    pub back: Vec3,
    /// Chooses another set of random numbers.
    pub seed: u32,
    /// 1 if the eye is inside of glass.
    pub inside: u32,
    /// Nothing.
    pub pad_a: u32,
    /// Nothing.
    pub pad_b: [u32; 2],
}
