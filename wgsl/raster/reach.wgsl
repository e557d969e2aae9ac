// a piece -> the tiles that it may touch
#import "raster/plan.wgsl"
#import "tables/piece.wgsl"

// Invocations that share a piece: the eight lanes of a SIMD group take the same turns.
const SHARE: u32 = 16u;

// First and last column and row of the tiles under the bounding box.
fn tiles_of(piece: Piece) -> vec4u {
    return vec4u(on_film(span(piece.a, piece.b, piece.c))) / TILE;
}

// Whether the piece may cover a pixel of a tile; (column, row).
fn touches(piece: Piece, tile: vec2u) -> bool {
    return !misses(plan(piece.a, piece.b, piece.c, vec2i(tile * TILE)));
}
