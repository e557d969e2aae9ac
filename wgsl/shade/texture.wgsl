// a map and a place on it -> the color there
#import "tables/paint.wgsl"
#import "tables/settings.wgsl"
#import "tables/texel.wgsl"
#import "math/power.wgsl"

// `hold` is each method's own.

// How pictures are read is written out, as all is that a frame decides once: a branch on a uniform lavapipe compiles
// anew for every dispatch (`lvp_inline_uniforms`), and keeps.
const FILTERING: u32 = $filtering;

// A level of a map: its first texel and its size.
struct Level {
    first: u32,
    width: i32,
    height: i32,
    clamped: bool,
}

fn level_of(map: Map, number: u32) -> Level {
    var level = Level(map.first, i32(map.width), i32(map.height), is_clamped(map));
    for (var k = 0u; k < number; k++) {
        level.first += u32(level.width * level.height);
        level.width = max(level.width / 2, 1);
        level.height = max(level.height / 2, 1);
    }
    return level;
}

fn is_clamped(map: Map) -> bool {
    return (map.levels & CLAMPED) != 0u;
}

// Where a coordinate lies in a picture, from 0 to 1. Where it is too large to lie anywhere, it is 0 on both sides. Bits
// are asked, as a compiler may think that every comparison is of numbers.
fn within(x: f32, clamped: bool) -> f32 {
    let u = select(x - floor(x), select(select(0.0, x, x > 0.0), 1.0, x >= 1.0), clamped);
    return select(0.0, u, bitcast<u32>(u) <= bitcast<u32>(1.0));
}

// A texel beside the picture is one of its copy, or of its edge: `x` is from -1 to `size`. A remainder is what lavapipe
// has no vectors for.
fn wrapped(x: i32, size: i32, clamped: bool) -> i32 {
    let step = select(size, 1, clamped);
    return x + select(select(0, -step, x >= size), step, x < 0);
}

// A texel by column and row from the lower left, as it is kept.
fn texel_of(level: Level, x: i32, y: i32) -> u32 {
    let column = wrapped(x, level.width, level.clamped);
    let row = level.height - 1 - wrapped(y, level.height, level.clamped);
    return word_of(texels, level.first + u32(row * level.width + column));
}

// Its color.
fn decoded(word: u32, decode: bool) -> vec3f {
    let bytes = vec3u(word & 255u, (word >> 8u) & 255u, (word >> 16u) & 255u);
    if (decode) {
        return bitcast<vec3f>(vec3u(word_of(texels, bytes.x), word_of(texels, bytes.y), word_of(texels, bytes.z)));
    }
    return vec3f(bytes) / 255.0;
}

// Its alpha.
fn alpha_of(level: Level, x: i32, y: i32) -> f32 {
    return f32(texel_of(level, x, y) >> 24u) / 255.0;
}

fn blend(p: vec3f, q: vec3f, share: f32) -> vec3f {
    let way = q - p;
    return p + vec3f(hold(way.x * share), hold(way.y * share), hold(way.z * share));
}

// The texels around a place on a level: the lower left, the one right of it, and the two above; and how far it is from
// the first to the others. Of NEAREST the first alone.
struct Taps {
    texels: vec4u,
    across: f32,
    up: f32,
}

fn taps_at(level: Level, u: f32, v: f32) -> Taps {
    if (FILTERING == NEAREST) {
        return Taps(vec4u(texel_of(level, i32(u * f32(level.width)), i32(v * f32(level.height)))), 0.0, 0.0);
    }
    let x = hold(u * f32(level.width)) - 0.5;
    let y = hold(v * f32(level.height)) - 0.5;
    let column = i32(floor(x));
    let row = i32(floor(y));
    let low = vec2u(texel_of(level, column, row), texel_of(level, column + 1, row));
    let high = vec2u(texel_of(level, column, row + 1), texel_of(level, column + 1, row + 1));
    return Taps(vec4u(low, high), x - floor(x), y - floor(y));
}

fn color_of_taps(t: Taps, decode: bool) -> vec3f {
    let first = decoded(t.texels.x, decode);
    if (FILTERING == NEAREST) {
        return first;
    }
    let low = blend(first, decoded(t.texels.y, decode), t.across);
    let high = blend(decoded(t.texels.z, decode), decoded(t.texels.w, decode), t.across);
    return blend(low, high, t.up);
}

// What is read of a map at a place. A map is read first and its color made of it later, so that the texels of all maps
// of a place are on their way from memory at the same time.
struct Sample {
    near: Taps,
    // On the next coarser level, and how far the place lies on the way there: of MIPMAP alone.
    far: Taps,
    share: f32,
}

// `right` and `down`: the texture coordinates one pixel further on.
fn sample_at(map: Map, uv: vec2f, right: vec2f, down: vec2f) -> Sample {
    let full = vec2f(hold(uv.x * map.scale.x), hold(uv.y * map.scale.y)) + map.shift;
    let u = within(full.x, is_clamped(map));
    let v = within(full.y, is_clamped(map));
    let finest = level_of(map, 0u);
    if (FILTERING != MIPMAP) {
        return Sample(taps_at(finest, u, v), Taps(), 0.0);
    }
    let size = map.scale * vec2f(f32(map.width), f32(map.height));
    let dx = (right - uv) * size;
    let dy = (down - uv) * size;
    // What is not negative is in the order of its bits, and what is no number beyond all numbers.
    let squares = vec2f(hold(dx.x * dx.x) + hold(dx.y * dx.y), hold(dy.x * dy.x) + hold(dy.y * dy.y));
    let bits = max(bitcast<u32>(squares.x), bitcast<u32>(squares.y));
    let stride = bitcast<f32>(clamp(bits, bitcast<u32>(1e-6), bitcast<u32>(1e12)));
    let levels = map.levels & ~CLAMPED;
    let detail = clamp(0.5 * log2_exact(stride), 0.0, f32(levels - 1u));
    let fine = u32(detail);
    // Past the coarsest there is nothing to blend with, and nothing left of the way there.
    let far = level_of(map, min(fine + 1u, levels - 1u));
    return Sample(taps_at(level_of(map, fine), u, v), taps_at(far, u, v), detail - floor(detail));
}

fn color_of_sample(s: Sample, decode: bool) -> vec3f {
    let near = color_of_taps(s.near, decode);
    if (FILTERING != MIPMAP) {
        return near;
    }
    return blend(near, color_of_taps(s.far, decode), s.share);
}

// Whether a face with this opacity map is there: what is half transparent is. Read from the finest level.
fn is_there(map: Map, uv: vec2f) -> bool {
    let full = vec2f(hold(uv.x * map.scale.x), hold(uv.y * map.scale.y)) + map.shift;
    // Without a loop: a ray asks this in the midst of its own.
    let level = Level(map.first, i32(map.width), i32(map.height), is_clamped(map));
    let x = hold(within(full.x, level.clamped) * f32(map.width));
    let y = hold(within(full.y, level.clamped) * f32(map.height));
    if (FILTERING == NEAREST) {
        return alpha_of(level, i32(x), i32(y)) >= 0.5;
    }
    let column = i32(floor(x - 0.5));
    let row = i32(floor(y - 0.5));
    let across = (x - 0.5) - floor(x - 0.5);
    let up = (y - 0.5) - floor(y - 0.5);
    let low = mixed(alpha_of(level, column, row), alpha_of(level, column + 1, row), across);
    let high = mixed(alpha_of(level, column, row + 1), alpha_of(level, column + 1, row + 1), across);
    return mixed(low, high, up) >= 0.5;
}

fn mixed(p: f32, q: f32, share: f32) -> f32 {
    return p + hold((q - p) * share);
}
