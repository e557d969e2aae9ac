//! Twin of `wgsl/tables/texel.wgsl`.

/// Texels in a row of a table that is a texture: as many as every adapter has room for.
pub const ROW: u32 = 8192;
