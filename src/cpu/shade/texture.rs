//! a map and a place on it -> the color there

use glam::{Vec2, Vec3};

use crate::math::power::log2_exact;
use crate::tables::{BILINEAR, CLAMPED, Map, NEAREST};

/// A level of a map: its first texel and its size.
#[derive(Debug, Clone, Copy)]
struct Level {
    first: u32,
    width: i32,
    height: i32,
    clamped: bool,
}

fn level_of(map: &Map, number: u32) -> Level {
    let (width, height) = (map.width as i32, map.height as i32);
    let mut level = Level { first: map.first, width, height, clamped: is_clamped(map) };
    for _ in 0..number {
        level.first += (level.width * level.height) as u32;
        level.width = (level.width / 2).max(1);
        level.height = (level.height / 2).max(1);
    }
    level
}

fn is_clamped(map: &Map) -> bool {
    map.levels & CLAMPED != 0
}

/// Where a coordinate lies in a picture, from 0 to 1. Where it is too large to lie anywhere, it is 0 on both sides.
#[must_use]
pub fn within(x: f32, clamped: bool) -> f32 {
    let u = if clamped { x.clamp(0.0, 1.0) } else { x - x.floor() };
    if u.to_bits() <= 1_f32.to_bits() { u } else { 0.0 }
}

/// A texel beside the picture is one of its copy, or of its edge: `x` is from -1 to `size`.
fn wrapped(x: i32, size: i32, clamped: bool) -> i32 {
    let step = if clamped { 1 } else { size };
    x + if x < 0 {
        step
    } else if x >= size {
        -step
    } else {
        0
    }
}

/// A texel by column and row from the lower left.
fn texel(texels: &[u32], level: Level, x: i32, y: i32, decode: bool) -> Vec3 {
    let column = wrapped(x, level.width, level.clamped);
    let row = level.height - 1 - wrapped(y, level.height, level.clamped);
    let word = texels[level.first as usize + (row * level.width + column) as usize];
    let [red, green, blue, _] = word.to_le_bytes();
    Vec3::from_array(
        [red, green, blue]
            .map(|byte| if decode { f32::from_bits(texels[byte as usize]) } else { f32::from(byte) / 255.0 }),
    )
}

/// Its alpha.
fn alpha_of(texels: &[u32], level: Level, x: i32, y: i32) -> f32 {
    let row = level.height - 1 - wrapped(y, level.height, level.clamped);
    let word = texels[level.first as usize + (row * level.width + wrapped(x, level.width, level.clamped)) as usize];
    (word >> 24) as f32 / 255.0
}

fn blend(p: Vec3, q: Vec3, share: f32) -> Vec3 {
    p + (q - p) * share
}

fn bilinear(texels: &[u32], level: Level, u: f32, v: f32, decode: bool) -> Vec3 {
    let x = u * level.width as f32 - 0.5;
    let y = v * level.height as f32 - 0.5;
    let (column, row) = (x.floor() as i32, y.floor() as i32);
    let across = x - x.floor();
    let at = |dx: i32, dy: i32| texel(texels, level, column + dx, row + dy, decode);
    blend(blend(at(0, 0), at(1, 0), across), blend(at(0, 1), at(1, 1), across), y - y.floor())
}

/// `uvs`: the texture coordinates here, one pixel to the right, and one pixel down.
#[must_use]
pub fn sample_map(texels: &[u32], filtering: u32, map: &Map, uvs: [Vec2; 3], decode: bool) -> Vec3 {
    let [uv, right, down] = uvs;
    let full = uv * map.scale + map.shift;
    let (u, v) = (within(full.x, is_clamped(map)), within(full.y, is_clamped(map)));
    let finest = level_of(map, 0);
    if filtering == NEAREST {
        let (x, y) = (u * map.width as f32, v * map.height as f32);
        return texel(texels, finest, x as i32, y as i32, decode);
    }
    if filtering == BILINEAR {
        return bilinear(texels, finest, u, v, decode);
    }
    let size = map.scale * Vec2::new(map.width as f32, map.height as f32);
    let dx = (right - uv) * size;
    let dy = (down - uv) * size;
    // What is not negative is in the order of its bits, and what is no number beyond all numbers.
    let bits = (dx.x * dx.x + dx.y * dx.y).to_bits().max((dy.x * dy.x + dy.y * dy.y).to_bits());
    let stride = f32::from_bits(bits.clamp(1e-6_f32.to_bits(), 1e12_f32.to_bits()));
    let levels = map.levels & !CLAMPED;
    let detail = (0.5 * log2_exact(stride)).clamp(0.0, (levels - 1) as f32);
    let fine = detail as u32;
    let near = bilinear(texels, level_of(map, fine), u, v, decode);
    if fine + 1 >= levels {
        return near;
    }
    let far = bilinear(texels, level_of(map, fine + 1), u, v, decode);
    blend(near, far, detail - detail.floor())
}

/// Whether a face with this opacity map is there: what is half transparent is. Read from the finest level.
#[must_use]
pub fn is_there(texels: &[u32], filtering: u32, map: &Map, uv: Vec2) -> bool {
    let full = uv * map.scale + map.shift;
    let level = level_of(map, 0);
    let (u, v) = (within(full.x, level.clamped), within(full.y, level.clamped));
    let (x, y) = (u * map.width as f32, v * map.height as f32);
    if filtering == NEAREST {
        return alpha_of(texels, level, x as i32, y as i32) >= 0.5;
    }
    let (column, row) = ((x - 0.5).floor() as i32, (y - 0.5).floor() as i32);
    let (across, up) = ((x - 0.5) - (x - 0.5).floor(), (y - 0.5) - (y - 0.5).floor());
    let at = |dx: i32, dy: i32| alpha_of(texels, level, column + dx, row + dy);
    let mixed = |p: f32, q: f32, share: f32| p + (q - p) * share;
    mixed(mixed(at(0, 0), at(1, 0), across), mixed(at(0, 1), at(1, 1), across), up) >= 0.5
}
