//! Twin of `wgsl/tables/path.wgsl`.

use glam::Vec3;

/// One pixel's ray tree in progress: the ray in hand, what it has met so far, and the light gathered.
///
/// It can be put down after any loop turn and taken up again, on either side.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Path {
    /// Where the ray starts.
    pub origin: Vec3,
    /// The leaf that the ray leaves, or [`NONE`](super::NONE): it meets itself only at the other end of a chord.
    pub leaves: u32,
    /// Of length one.
    pub direction: Vec3,
    /// Distance to the nearest hit so far, in lengths of `direction`.
    pub t: f32,
    /// What the ray's light counts for in the pixel.
    pub weight: Vec3,
    /// Which ray of its branch this is, from 1.
    pub depth: u32,
    /// The light gathered by the tree so far.
    pub radiance: Vec3,
    /// 1 while the ray runs inside an object.
    pub inside: u32,
    /// [`IDLE`], [`SEEK`], [`LIT`] or [`DONE`].
    pub state: u32,
    /// The sample being traced.
    pub sample: u32,
    /// The nearest leaf so far, or [`NONE`](super::NONE).
    pub hit: u32,
    /// The next plane to test; once they are, one more than these and what the walk's stack holds.
    pub next: u32,
    /// The light whose shadow ray is out.
    pub light: u32,
    /// Rays waiting on the stack.
    pub waiting: u32,
    /// Rays taken up so far: the dimension of the next random number.
    pub rays: u32,
    /// The number of the primitive that the first ray met: the picture's id layer.
    pub seen: u32,
}

/// A ray put aside while its heavier sibling is followed.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Waiting {
    /// Where the ray starts.
    pub origin: Vec3,
    /// The leaf that it leaves.
    pub leaves: u32,
    /// Of length one.
    pub direction: Vec3,
    /// Which ray of its branch it is.
    pub depth: u32,
    /// What its light counts for.
    pub weight: Vec3,
    /// 1 if it runs inside an object.
    pub inside: u32,
}

/// Farther than any hit.
pub const FAR: f32 = f32::MAX;
/// No sample under way.
pub const IDLE: u32 = 0;
/// Looking for the ray's nearest hit.
pub const SEEK: u32 = 1;
/// At the hit, asking the lights.
pub const LIT: u32 = 2;
/// The tree is followed to its end; the radiance waits to be gathered.
pub const DONE: u32 = 3;
