// a lane's pixels of a tile, and a piece -> the nearer of both in each
#import "raster/plan.wgsl"

// Of a pixel: for an eye NONE less the id, and then the nearness.
#if fours
@group(0) @binding(5) var<storage, read_write> image: array<vec4u>;
#else
@group(0) @binding(5) var<storage, read_write> image: array<u32>;
#end

#if eye
const WORDS: u32 = 2u;
#else
const WORDS: u32 = 1u;
#end

// A lane has four neighboring pixels in each of so many rows.
const ROWS: u32 = $rows;
const LANES: u32 = 64u / ROWS;
// Rows from one of a lane's to its next.
const STRIDE: i32 = 16 / i32(ROWS);
const ACROSS: vec4i = vec4i(0, 1, 2, 3);

// Four neighboring pixels: the nearness, and NONE less the id.
struct Quad {
    near: vec4u,
    id: vec4u,
}

// A lane's pixels.
struct Pixels {
#repeat rows
    row_$i: Quad,
#end
}

// Where the sample is covered, the nearest is seen, and of equals the least id.
fn put(old: Quad, near: vec4u, id: u32, covered: vec4<bool>) -> Quad {
#if eye
    let better = covered & ((near > old.near) | ((near == old.near) & (vec4u(id) > old.id)));
    return Quad(select(old.near, near, better), select(old.id, vec4u(id), better));
#else
    return Quad(max(old.near, select(vec4u(0u), near, covered)), old.id);
#end
}

// As `nearness`, of four.
fn near_at(n: Nears, at: vec4i) -> vec4u {
    return bitcast<vec4u>(clamp(at, vec4i(n.least), vec4i(n.most)));
}

// A piece that covers the tile; `here` is the lane's first pixel on it.
fn put_whole(px: ptr<function, Pixels>, here: vec2i, n: Nears, id: u32) {
    var at = (n.at + n.x * here.x + n.y * here.y) + n.x * ACROSS;
#repeat rows
    (*px).row_$i = put((*px).row_$i, near_at(n, at), id, vec4<bool>(true));
    at += n.y * STRIDE;
#end
}

// A piece that touches the tile.
fn put_some(px: ptr<function, Pixels>, here: vec2i, p: Plan, id: u32) {
    let n = p.nears;
    let first = p.e + p.a * here.x + p.b * here.y;
    var at = (n.at + n.x * here.x + n.y * here.y) + n.x * ACROSS;
    var e = first.x + p.a.x * ACROSS;
    var f = first.y + p.a.y * ACROSS;
    var g = first.z + p.a.z * ACROSS;
#repeat rows
    (*px).row_$i = put((*px).row_$i, near_at(n, at), id, (e | f | g) >= vec4i(0));
    at += n.y * STRIDE;
    e += p.b.x * STRIDE;
    f += p.b.y * STRIDE;
    g += p.b.z * STRIDE;
#end
}

#if fours
// Four neighbors are read at once: each row begins with the first of four.
fn quad_at(pixel: vec2u) -> u32 {
    let at = (lens.first + (pixel.y * lens.width + pixel.x) * WORDS) / 4u;
    return select(NONE, at, all(pixel < vec2u(lens.width, lens.height)));
}

fn load_quad(pixel: vec2u) -> Quad {
    let at = quad_at(pixel);
    if (at == NONE) {
        return Quad();
    }
#if eye
    let p = image[at];
    let q = image[at + 1u];
    return Quad(vec4u(p.yw, q.yw), vec4u(p.xz, q.xz));
#else
    return Quad(image[at], vec4u(0u));
#end
}

fn store_quad(pixel: vec2u, quad: Quad) {
    let at = quad_at(pixel);
    if (at != NONE) {
#if eye
        image[at] = vec4u(quad.id.x, quad.near.x, quad.id.y, quad.near.y);
        image[at + 1u] = vec4u(quad.id.z, quad.near.z, quad.id.w, quad.near.w);
#else
        image[at] = quad.near;
#end
    }
}
#else
// The words of a pixel, if it is on the film.
fn word_at(pixel: vec2u) -> u32 {
    return select(NONE, lens.first + (pixel.y * lens.width + pixel.x) * WORDS, all(pixel < vec2u(lens.width, lens.height)));
}

fn load(pixel: vec2u) -> vec2u {
    let at = word_at(pixel);
    if (at == NONE) {
        return vec2u(0u);
    }
#if eye
    return vec2u(image[at + 1u], image[at]);
#else
    return vec2u(image[at], 0u);
#end
}

fn store(pixel: vec2u, near: u32, id: u32) {
    let at = word_at(pixel);
    if (at != NONE) {
#if eye
        image[at] = id;
        image[at + 1u] = near;
#else
        image[at] = near;
#end
    }
}

fn load_quad(pixel: vec2u) -> Quad {
    var quad: Quad;
#repeat 4
    let p_$i = load(pixel + vec2u($iu, 0u));
    quad.near[$i] = p_$i.x;
    quad.id[$i] = p_$i.y;
#end
    return quad;
}

fn store_quad(pixel: vec2u, quad: Quad) {
#repeat 4
    store(pixel + vec2u($iu, 0u), quad.near[$i], quad.id[$i]);
#end
}
#end
