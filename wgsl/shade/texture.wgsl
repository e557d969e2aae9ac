// a map and a place on it -> the color there
#import "tables/paint.wgsl"
#import "tables/settings.wgsl"
#import "math/power.wgsl"

// `hold` and `texels` are each method's own.

// A level of a map: its first texel and its size.
struct Level {
    first: u32,
    width: i32,
    height: i32,
}

fn level_of(map: Map, number: u32) -> Level {
    var level = Level(map.first, i32(map.width), i32(map.height));
    for (var k = 0u; k < number; k++) {
        level.first += u32(level.width * level.height);
        level.width = max(level.width / 2, 1);
        level.height = max(level.height / 2, 1);
    }
    return level;
}

// A texel by column and row from the lower left; the picture repeats.
fn texel(level: Level, x: i32, y: i32, decode: bool) -> vec3f {
    let column = (x % level.width + level.width) % level.width;
    let row = level.height - 1 - (y % level.height + level.height) % level.height;
    let word = texels[level.first + u32(row * level.width + column)];
    let bytes = vec3u(word & 255u, (word >> 8u) & 255u, (word >> 16u) & 255u);
    if (decode) {
        return vec3f(
            bitcast<f32>(texels[bytes.x]), bitcast<f32>(texels[bytes.y]), bitcast<f32>(texels[bytes.z]),
        );
    }
    return vec3f(bytes) / 255.0;
}

fn blend(p: vec3f, q: vec3f, share: f32) -> vec3f {
    let way = q - p;
    return p + vec3f(hold(way.x * share), hold(way.y * share), hold(way.z * share));
}

fn bilinear(level: Level, u: f32, v: f32, decode: bool) -> vec3f {
    let x = hold(u * f32(level.width)) - 0.5;
    let y = hold(v * f32(level.height)) - 0.5;
    let column = i32(floor(x));
    let row = i32(floor(y));
    let across = x - floor(x);
    let low = blend(texel(level, column, row, decode), texel(level, column + 1, row, decode), across);
    let high = blend(texel(level, column, row + 1, decode), texel(level, column + 1, row + 1, decode), across);
    return blend(low, high, y - floor(y));
}

// `right` and `down`: the texture coordinates one pixel further on.
fn sample_map(map: Map, filtering: u32, uv: vec2f, right: vec2f, down: vec2f, decode: bool) -> vec3f {
    let full = vec2f(hold(uv.x * map.scale.x), hold(uv.y * map.scale.y)) + map.shift;
    let u = full.x - floor(full.x);
    let v = full.y - floor(full.y);
    let finest = level_of(map, 0u);
    if (filtering == NEAREST) {
        return texel(finest, i32(u * f32(map.width)), i32(v * f32(map.height)), decode);
    }
    if (filtering == BILINEAR) {
        return bilinear(finest, u, v, decode);
    }
    let size = map.scale * vec2f(f32(map.width), f32(map.height));
    let dx = (right - uv) * size;
    let dy = (down - uv) * size;
    let stride = max(hold(dx.x * dx.x) + hold(dx.y * dx.y), hold(dy.x * dy.x) + hold(dy.y * dy.y));
    let detail = clamp(0.5 * log2_exact(clamp(stride, 1e-6, 1e12)), 0.0, f32(map.levels - 1u));
    let fine = u32(detail);
    let near = bilinear(level_of(map, fine), u, v, decode);
    if (fine + 1u >= map.levels) {
        return near;
    }
    let far = bilinear(level_of(map, fine + 1u), u, v, decode);
    return blend(near, far, detail - floor(detail));
}
