// a lane's pixels of a tile, and a piece -> the nearer of both in each
#import "raster/plan.wgsl"

// A lane has two neighboring pixels in each of so many rows.
const ROWS: u32 = $rows;
const LANES: u32 = 128u / ROWS;
// Rows from one of a lane's to its next.
const STRIDE: i32 = 16 / i32(ROWS);

// Two neighboring pixels: the nearness, and NONE less the id.
struct Pair {
    near: vec2u,
    id: vec2u,
}

// A lane's pixels.
struct Pixels {
#repeat rows
    row_$i: Pair,
#end
}

// Where the sample is covered, the nearest is seen, and of equals the least id.
fn put(old: Pair, near: vec2u, id: u32, covered: vec2<bool>) -> Pair {
#if eye
    let better = covered & ((near > old.near) | ((near == old.near) & (vec2u(id) > old.id)));
    return Pair(select(old.near, near, better), select(old.id, vec2u(id), better));
#else
    return Pair(max(old.near, select(vec2u(0u), near, covered)), old.id);
#end
}

// As `nearness`, of a pair.
fn near_at(d: Depths, z: i32) -> vec2u {
    return vec2u(d.most) - vec2u(clamp(vec2i(z, z + d.zx), vec2i(d.low), vec2i(d.high)));
}

// A piece that covers the tile; `here` is the lane's first pixel on it.
fn put_whole(px: ptr<function, Pixels>, here: vec2i, d: Depths, id: u32) {
    var z = d.z + d.zx * here.x + d.zy * here.y;
#repeat rows
    (*px).row_$i = put((*px).row_$i, near_at(d, z), id, vec2<bool>(true));
    z += d.zy * STRIDE;
#end
}

// A piece that touches the tile.
fn put_some(px: ptr<function, Pixels>, here: vec2i, p: Plan, id: u32) {
    let d = p.depths;
    var z = d.z + d.zx * here.x + d.zy * here.y;
    var e = p.e + p.a * here.x + p.b * here.y;
    var f = e + p.a;
#repeat rows
    (*px).row_$i =
        put((*px).row_$i, near_at(d, z), id, vec2<bool>((e.x | e.y | e.z) >= 0, (f.x | f.y | f.z) >= 0));
    z += d.zy * STRIDE;
    e += p.b * STRIDE;
    f += p.b * STRIDE;
#end
}
