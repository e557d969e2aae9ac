//! Twin of `wgsl/tables/status.wgsl`.

/// What the kernels tell the host: a picture is published only if this adds up.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Status {
    /// Workgroups that ran to their end.
    pub groups: u32,
    /// Pixels whose last sample has been gathered.
    pub pixels: u32,
    /// [`CUT_SHORT`] and [`STACK_FULL`].
    pub flags: u32,
    /// The most loop turns that one invocation took.
    pub turns: u32,
}

/// A loop stopped where its own condition would have gone on.
pub const CUT_SHORT: u32 = 1;
/// A ray found no room on its stack.
pub const STACK_FULL: u32 = 2;
