//! Twin of `wgsl/tables/node.wgsl`.

use glam::Vec3;

/// Up to eight boxes around what lies below, in bytes: Ylitie, Karras and Laine, "Efficient Incoherent Ray Traversal
/// on GPUs Through Compressed Wide BVHs", HPG 2017.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Node {
    /// The lower corner of all boxes.
    pub corner: Vec3,
    /// The biased exponents of a step in x, y and z; then a bit for each child that is a node.
    pub steps: u32,
    /// The first of the children that are nodes.
    pub children: u32,
    /// The first of the primitives.
    pub leaves: u32,
    /// A byte for each child. 0: none; 001 and 24 + its number: a node; else as many ones in the upper three bits as
    /// it has primitives, and in the others which of them is its first.
    pub kinds: [u32; 2],
    /// A byte for each child: steps from the corner.
    pub low_x: [u32; 2],
    /// As `low_x`.
    pub low_y: [u32; 2],
    /// As `low_x`.
    pub low_z: [u32; 2],
    /// As `low_x`.
    pub high_x: [u32; 2],
    /// As `low_x`.
    pub high_y: [u32; 2],
    /// As `low_x`.
    pub high_z: [u32; 2],
}
