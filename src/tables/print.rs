//! Twin of `wgsl/tables/print.wgsl`.

/// A picture on a screen, and the film that it is developed from; it may have more pixels than the film.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Print {
    /// Pixels in a row of the film.
    pub width: u32,
    /// Rows of the film.
    pub height: u32,
    /// Pixels in a row of the picture.
    pub across: u32,
    /// Rows of the picture.
    pub down: u32,
    /// Words from one row of the picture to the next.
    pub pitch: u32,
    /// [`AS_IT_IS`] or [`SRGB`].
    pub transfer: u32,
    /// Zeros.
    pub pad: [u32; 2],
}

/// Colors are display-referred already.
pub const AS_IT_IS: u32 = 0;
/// Colors are linear light.
pub const SRGB: u32 = 1;
