//! Twin of `wgsl/tables/piece.wgsl`.

use glam::IVec3;

/// A vertex on the film.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Corner {
    /// x to the right and y down in 1/256 pixel, z from 0 to [`DEEP`](super::DEEP); zero where `code` is not.
    pub at: IVec3,
    /// The planes that it lies beyond, one bit each: near, far, left, right, bottom, top.
    pub code: u32,
}

/// A triangle on the film, with an area above zero, and the bin in which it is drawn tile by tile.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Piece {
    /// First corner: x to the right and y down in 1/256 pixel, z from 0 to [`DEEP`](super::DEEP).
    pub a: IVec3,
    /// The face that it is a piece of.
    pub id: u32,
    /// Second corner.
    pub b: IVec3,
    /// The bin's first column of tiles.
    pub column: u32,
    /// Third corner.
    pub c: IVec3,
    /// The bin's first row of tiles.
    pub row: u32,
}

/// What the stages of a lens have counted.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Tally {
    /// Faces that are not drawn at once, those included that found no room: whole ones, and those that cross a plane.
    pub late: [u32; 2],
    /// Pieces, likewise.
    pub pieces: u32,
    /// Entries of all tiles' lists together, likewise.
    pub entries: u32,
    /// Entries of the longest list.
    pub longest: u32,
    /// Tiles with an entry.
    pub busy: u32,
    /// Workgroups of call and cover that ran to their end.
    pub groups: u32,
    /// Runs of pixels that show a face.
    pub shown: u32,
    /// Runs that show none.
    pub bare: u32,
}

/// Planes that a triangle is clipped by.
pub const PLANES: u32 = 6;
/// Corners of a triangle that all of them have clipped.
pub const MOST_CORNERS: u32 = 9;
