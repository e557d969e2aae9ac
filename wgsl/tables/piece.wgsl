// A vertex on the film.
struct Corner {
    // x to the right and y down in 1/256 pixel, z from 0 to DEEP; zero where `code` is not.
    at: vec3i,
    // The planes that it lies beyond, one bit each: near, far, left, right, bottom, top.
    code: u32,
}

// A triangle on the film, with an area above zero, and the bin in which it is drawn tile by tile.
struct Piece {
    // Corners: x to the right and y down in 1/256 pixel, z from 0 to DEEP.
    a: vec3i,
    // The face that it is a piece of.
    id: u32,
    b: vec3i,
    // The bin's first column of tiles.
    column: u32,
    c: vec3i,
    // The bin's first row of tiles.
    row: u32,
}

// What the stages of a lens have counted.
struct Tally {
    // Faces that are not drawn at once, those included that found no room: whole ones, and those that cross a plane.
    late: array<atomic<u32>, 2>,
    // Pieces, likewise.
    pieces: atomic<u32>,
    // Entries of all tiles' lists together, likewise.
    entries: u32,
    // Entries of the longest list.
    longest: atomic<u32>,
    // Tiles with an entry.
    busy: atomic<u32>,
    // Workgroups of call and cover that ran to their end.
    groups: atomic<u32>,
    // Runs of pixels that show a face, and that show none.
    shown: atomic<u32>,
    bare: atomic<u32>,
}

// Planes that a triangle is clipped by.
const PLANES: u32 = 6u;
// Corners of a triangle that all of them have clipped.
const MOST_CORNERS: u32 = 9u;
