//! Twin of `wgsl/tables/lens.wgsl`.

use glam::Vec4;

/// One view of the scene, the eye's or a light's, and the image that it is drawn onto.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Lens {
    /// World space to clip x: a row of spec 1.2.3's Projection times `World2Camera`.
    pub x: Vec4,
    /// World space to clip y, up.
    pub y: Vec4,
    /// World space to clip z: 0 at the near plane, `w` at the far one.
    pub z: Vec4,
    /// World space to clip w.
    pub w: Vec4,
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// The first word of its depths in their buffer.
    pub first: u32,
    /// Tiles in a row.
    pub columns: u32,
    /// 1 if one-sided faces are seen from their front alone.
    pub cull: u32,
    /// Zero, which no compiler can know: what floats are fenced with.
    pub zero: u32,
    /// How much farther along the lens's axis than its caster a point may lie and be lit all the same, in clip z where `w`
    /// is 1; of an eye, as far as it sees across there.
    pub bias: f32,
    /// Added to every depth for each unit that it climbs from pixel to pixel, in 1/256.
    pub slope: u32,
    /// How far x may be from 0, in w, before a corner is out of fixed-point reach.
    pub guard_x: f32,
    /// How far y may be from 0, in w.
    pub guard_y: f32,
    /// The largest bounding box, in pixels a side, that one invocation draws alone.
    pub small: u32,
    /// Which portion of a tile's lists is drawn: `round * MOST_ENTRIES` and on.
    pub round: u32,
    /// Columns of the region that clip space spans; the image is a window of it.
    pub span_x: u32,
    /// Rows of the region.
    pub span_y: u32,
    /// The window's first column on the film, whose regions begin at multiples of [`REGION`].
    pub left: u32,
    /// The window's first row on the film.
    pub top: u32,
}

impl Lens {
    /// Pixels of its image.
    #[must_use]
    pub fn pixels(&self) -> u32 {
        self.width * self.height
    }

    /// Tiles of its image.
    #[must_use]
    pub fn tiles(&self) -> u32 {
        self.columns * self.height.div_ceil(TILE)
    }

    /// Cells of its tiles, and how many of them are in a row.
    #[must_use]
    pub fn cells(&self) -> [u32; 2] {
        let side = TILE / CELL;
        [self.tiles() * side * side, self.columns * side]
    }
}

/// The depth of the far plane; the near plane's is 0.
pub const DEEP: u32 = 1 << 30;
/// Deeper than anything. An image holds this less the depth and [`NONE`](super::NONE) less the id, so that zero is
/// nothing and what counts is the largest.
pub const NO_DEPTH: u32 = u32::MAX;
/// The longest side of a region: fixed point reaches across it and as far again on all sides.
pub const REGION: u32 = 8192;
/// Pixels along the side of a tile.
pub const TILE: u32 = 16;
/// Pixels along the side of a cell, of which the farthest is known.
pub const CELL: u32 = 8;
/// Tiles along the side of a bin.
pub const BIN: u32 = 8;
/// Entries of each of a tile's lists that one dispatch draws.
pub const MOST_ENTRIES: u32 = 16384;
/// Lenses of lights that a scene has room for.
pub const MOST_LENSES: u32 = 32;
/// A depth that climbs faster from pixel to pixel is not biased any more.
pub const STEEPEST: u32 = 1 << 24;
