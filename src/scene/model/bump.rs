//! The picture of a `bump` line -> tangent-space normals, whichever of the two it holds.
//!
//! By the book `bump` and `map_Bump` name a *height* map, but half of the files put a *normal* map there.
//! The picture itself tells: heights are gray (red, green and blue within 12 of each other for 99 % of the
//! texels); normals are, for 90 % of them, vectors of length 1 +- 0.25 that point outward (blue above
//! one half). What is neither is taken as heights by its brightness, with a warning.

use glam::Vec3;

/// What a bump picture holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Gray.
    Heights,
    /// Bluish.
    Normals,
    /// Of other colors.
    Neither,
}

/// How high white is above black, as part of the picture's width or height, for `-bm 1`. The format
/// gives no unit; in this one a picture means the same at every resolution.
const HEIGHT: f32 = 0.01;

/// Looks at all texels.
#[must_use]
pub fn kind(texels: &[[u8; 4]]) -> Kind {
    let many = |percent: usize, is: fn(&[u8; 4]) -> bool| {
        texels.iter().filter(|texel| is(texel)).count() * 100 >= percent * texels.len()
    };
    if many(99, |&[r, g, b, _]| r.max(g).max(b) - r.min(g).min(b) <= 12) {
        Kind::Heights
    } else if many(90, |&[r, g, b, _]| {
        let normal = Vec3::new(r.into(), g.into(), b.into()) / 127.5 - 1.0;
        normal.z > 0.0 && (normal.length() - 1.0).abs() < 0.25
    }) {
        Kind::Normals
    } else {
        Kind::Neither
    }
}

/// Normals of a height map by central differences (Blinn 1978), as n/2 + 1/2: +x along u, +y along v,
/// which runs **up** while rows run down. Beyond the rim the picture repeats, or stands still for `clamp`.
#[must_use]
pub fn to_normals(texels: &[[u8; 4]], width: u32, strength: f32, clamp: bool) -> Vec<[u8; 4]> {
    let width = (width as usize).max(1);
    let rows = (texels.len() / width).max(1);
    let height_at = |x: usize, y: usize| {
        let [r, g, b, _] = texels.get(y * width + x).copied().unwrap_or_default();
        // Rec. 709 luma.
        (0.2126 * f32::from(r) + 0.7152 * f32::from(g) + 0.0722 * f32::from(b)) / 255.0
    };
    let around = |at: usize, count: usize| {
        if clamp {
            (at.saturating_sub(1), (at + 1).min(count - 1))
        } else {
            ((at + count - 1) % count, (at + 1) % count)
        }
    };
    let steepness = Vec3::new(width as f32, rows as f32, 0.0) * 0.5 * HEIGHT * strength;
    let mut normals = Vec::with_capacity(texels.len());
    for y in 0..rows {
        let (above, below) = around(y, rows);
        for x in 0..width {
            let (left, right) = around(x, width);
            let rise =
                Vec3::new(height_at(right, y) - height_at(left, y), height_at(x, above) - height_at(x, below), 0.0);
            let normal = (Vec3::Z - rise * steepness).try_normalize().unwrap_or(Vec3::Z);
            let [r, g, b] = ((normal * 0.5 + 0.5) * 255.0).round().to_array().map(|value| value as u8);
            normals.push([r, g, b, 255]);
        }
    }
    normals
}
