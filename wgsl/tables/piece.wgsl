// A vertex on the film, in fixed point.
struct Corner {
    // x to the right and y down in 1/256 pixel, z from 0 to DEEP; zero where `code` is not.
    at: vec3i,
    // The planes that it lies beyond, one bit each: near, far, left, right, bottom, top.
    code: u32,
}

// A triangle on the film, with an area above zero, that is drawn tile by tile.
struct Piece {
    a: vec3i,
    // The face that it is a piece of.
    id: u32,
    b: vec3i,
    pad_b: u32,
    c: vec3i,
    pad_c: u32,
}

// What the stages of a lens have counted.
struct Tally {
    // Pieces, those included that found no room.
    pieces: atomic<u32>,
    // Entries of all tiles' lists together.
    entries: atomic<u32>,
    // Entries of the longest list.
    longest: atomic<u32>,
    // Workgroups that ran to their end.
    groups: atomic<u32>,
}

// Planes that a triangle is clipped by.
const PLANES: u32 = 6u;
// Corners of a triangle that all of them have clipped.
const MOST_CORNERS: u32 = 9u;
