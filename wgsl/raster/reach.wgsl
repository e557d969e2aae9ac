// a piece -> the tiles of its bin that it may touch
#import "raster/plan.wgsl"
#import "tables/piece.wgsl"

struct Reach {
    a: vec3i,
    b: vec3i,
    // The edges, as seen from the bin's first pixel.
    e: vec3i,
    // First and last column and row of the tiles under the bounding box, counted from the bin's first.
    tiles: vec4u,
}

fn reach(piece: Piece) -> Reach {
    let origin = vec2i(vec2u(piece.column, piece.row) * TILE);
    let pq = edge(piece.a, piece.b, origin);
    let qr = edge(piece.b, piece.c, origin);
    let rp = edge(piece.c, piece.a, origin);
    let under = on_film(span(piece.a, piece.b, piece.c)) / i32(TILE);
    let first = vec4i(vec2i(i32(piece.column), i32(piece.row)), vec2i(i32(piece.column), i32(piece.row)));
    let tiles = vec4u(clamp(under - first, vec4i(0), vec4i(i32(BIN) - 1)));
    return Reach(vec3i(pq.x, qr.x, rp.x), vec3i(pq.y, qr.y, rp.y), vec3i(pq.z, qr.z, rp.z), tiles);
}

const COVERED: u32 = 0u;
const TOUCHED: u32 = 1u;
const MISSED: u32 = 2u;

// What of a square of pixels is covered, each edge asked at the pixel where it is largest and where it is least: all of
// them, perhaps some, or none. `side` is the square's, and `tile` counts tiles from the bin's first.
fn how(r: Reach, tile: vec2u, side: u32) -> u32 {
    let at = vec2i(tile * TILE);
    let e = r.e + r.a * at.x + r.b * at.y;
    let across = i32(side) - 1;
    let most = e + (max(r.a, vec3i(0)) + max(r.b, vec3i(0))) * across;
    let least = e + (min(r.a, vec3i(0)) + min(r.b, vec3i(0))) * across;
    if ((most.x | most.y | most.z) < 0) {
        return MISSED;
    }
    return select(TOUCHED, COVERED, (least.x | least.y | least.z) >= 0);
}

// The tile after this one, along the row and then on the next; below the last row there is none.
fn after(r: Reach, tile: vec2u) -> vec2u {
    let ends = tile.x == r.tiles.z;
    return vec2u(select(tile.x + 1u, r.tiles.x, ends), tile.y + select(0u, 1u, ends));
}

// The list that a piece belongs to: each tile has one of pieces that cover all of it, and one of those that touch it.
fn list_of(piece: Piece, tile: vec2u, way: u32) -> u32 {
    return ((piece.row + tile.y) * lens.columns + piece.column + tile.x) * 2u + way;
}
