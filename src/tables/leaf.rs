//! Twin of `wgsl/tables/leaf.wgsl`.

use glam::Vec3;

/// A primitive of any kind in world space.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Leaf {
    /// A triangle's first corner, a sphere's center, a plane's point, the lower corner of an instance's box.
    pub a: Vec3,
    /// Its number in the scene.
    pub id: u32,
    /// A triangle's second corner, a plane's normal, the upper corner of an instance's box; a sphere's radius in x.
    pub b: Vec3,
    /// Which of the materials, or of the instances.
    pub material: u32,
    /// A triangle's third corner; the way in which u of a plane's maps grows, one over a copy's size long.
    pub c: Vec3,
    /// [`TRIANGLE`], [`SPHERE`], [`PLANE`] or [`INSTANCE`]; a triangle's with [`ONE_SIDED`](super::ONE_SIDED) and
    /// [`CUT_OUT`](super::CUT_OUT).
    pub kind: u32,
}

/// Three corners.
pub const TRIANGLE: u32 = 0;
/// A center and a radius.
pub const SPHERE: u32 = 1;
/// A point and a normal; not below any node.
pub const PLANE: u32 = 2;
/// A box around an instance of a model.
pub const INSTANCE: u32 = 3;
