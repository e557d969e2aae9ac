//! Twin of `wgsl/tables/slice.wgsl`.

/// One portion of work: which pixels, up to which sample, and how many loop turns each may take.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Slice {
    /// The first pixel, counted along rows from the top left.
    pub first: u32,
    /// Pixels from there.
    pub count: u32,
    /// The sample at which a pixel is done.
    pub samples: u32,
    /// Loop turns that each pixel may take.
    pub budget: u32,
}

/// The most loop turns an invocation may take in one dispatch.
///
/// lavapipe ends all loops of a SIMD group of 8 after 65,535 turns together, without a word
/// (`LP_MAX_TGSI_LOOP_ITERATIONS`): 8 lanes on 8 different ways may take 8,191 each.
pub const MOST_TURNS: u32 = 8_000;
/// Invocations in a workgroup.
pub const GROUP: u32 = 64;
