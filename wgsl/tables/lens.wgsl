// One view of the scene, the eye's or a light's, and the image that it is drawn onto.
struct Lens {
    // World space to clip space, row by row (spec 1.2.3); z is 0 at the near plane, w at the far one.
    x: vec4f,
    y: vec4f,
    z: vec4f,
    w: vec4f,
    width: u32,
    height: u32,
    // The first word of its depths in their buffer.
    first: u32,
    // Tiles in a row.
    columns: u32,
    // 1 if one-sided faces are seen from their front alone.
    cull: u32,
    // Zero, which no compiler can know: what floats are fenced with.
    zero: u32,
    // How much farther along the lens's axis than its caster a point may lie and be lit all the same, in clip z where w
    // is 1; of an eye, as far as it sees across there.
    bias: f32,
    // Added to every depth for each unit that it climbs from pixel to pixel, in 1/256.
    slope: u32,
    // How far x and y may be from 0, in w, before a corner is out of fixed-point reach.
    guard_x: f32,
    guard_y: f32,
    // The largest bounding box, in pixels a side, that one invocation draws alone.
    small: u32,
    // Which portion of a tile's lists is drawn: round * MOST_ENTRIES and on.
    round: u32,
    // Columns and rows of the region that clip space spans; the image is a window of it.
    span_x: u32,
    span_y: u32,
    // The window's first column and row on the film, whose regions begin at multiples of REGION.
    left: u32,
    top: u32,
}

// The depth of the far plane; the near plane's is 0.
const DEEP: u32 = 1073741824u;
// Deeper than anything. An image holds NO_DEPTH less the depth and NONE less the id, so that zero is nothing and what
// counts is the largest.
const NO_DEPTH: u32 = 0xffffffffu;
// The longest side of a region: fixed point reaches across it and as far again on all sides.
const REGION: u32 = 8192u;
// Pixels along the side of a tile.
const TILE: u32 = 16u;
// Pixels along the side of a cell, of which the farthest is known.
const CELL: u32 = 8u;
// Tiles along the side of a bin.
const BIN: u32 = 8u;
// Entries of each of a tile's lists that one dispatch draws.
const MOST_ENTRIES: u32 = 16384u;
// Lenses of lights that a scene has room for.
const MOST_LENSES: u32 = 32u;
// A depth that climbs faster from pixel to pixel is not biased any more.
const STEEPEST: u32 = 16777216u;
