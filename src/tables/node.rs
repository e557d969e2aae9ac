//! Twin of `wgsl/tables/node.wgsl`.

use glam::Vec3;

/// Up to eight boxes around what lies below, in bytes: Ylitie, Karras and Laine, "Efficient Incoherent Ray Traversal
/// on GPUs Through Compressed Wide BVHs", HPG 2017.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Node {
    /// The lower corner of all boxes.
    pub corner: Vec3,
    /// The biased exponents of a step in x, y and z.
    pub steps: u32,
    /// Where the children begin that are nodes: each is as far on as its place. Between them lie places of none.
    pub children: u32,
    /// The first of the primitives.
    pub leaves: u32,
    /// A bit for each child that is a node, four times: byte k has them at `place ^ k`, as rays of octant k ask for
    /// them, and with its halves swapped as those of octant k + 4 do.
    pub inner: u32,
    /// Three bits for each child: as many ones, from the lowest up, as it has primitives.
    pub held: u32,
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
