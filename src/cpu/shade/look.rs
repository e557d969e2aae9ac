//! a paint and a place on it -> the color, the highlight and the bump that its pictures give it there

use glam::{Vec2, Vec3};

use super::texture::sample_map;
use crate::cpu::witness::{Picture, Witness};
use crate::math::vector::unit;
use crate::tables::{Map, NONE, Paint, Vertex};

/// Products summed in one order.
#[must_use]
pub fn sum_by(w: Vec3, a: Vec3, b: Vec3, c: Vec3) -> Vec3 {
    (a * w.x + b * w.y) + c * w.z
}

/// Texture coordinates for what each corner counts for.
#[must_use]
pub fn uv_by(w: Vec3, [a, b, c]: [&Vertex; 3]) -> Vec2 {
    (Vec2::new(a.u, a.v) * w.x + Vec2::new(b.u, b.v) * w.y) + Vec2::new(c.u, c.v) * w.z
}

/// The normal of a map in world space: T and B are what an edge's u and v stand for (spec, "Get the normal for a
/// fragment"), N is interpolated.
#[must_use]
pub fn bumped(n: Vec3, [a, b, c]: [&Vertex; 3], tangent: Vec3, witness: &mut impl Witness) -> Vec3 {
    let (e, f) = (b.position - a.position, c.position - a.position);
    let (du, dv) = ([b.u - a.u, c.u - a.u], [b.v - a.v, c.v - a.v]);
    let turn = du[0] * dv[1] - du[1] * dv[0];
    if turn == 0.0 {
        return n;
    }
    let side = if turn < 0.0 { -1.0 } else { 1.0 };
    let along_u = sum_by(Vec3::new(dv[1] * side, -(dv[0] * side), 0.0), e, f, Vec3::ZERO);
    let along_v = sum_by(Vec3::new(-(du[1] * side), du[0] * side, 0.0), e, f, Vec3::ZERO);
    if along_u.dot(along_u) == 0.0 || along_v.dot(along_v) == 0.0 {
        return n;
    }
    let (t, b) = (unit(along_u), unit(along_v));
    witness.tangents([t, b]);
    let bent = unit(sum_by(tangent, t, b, n));
    // Coordinates too large to be told apart, and a picture's zero, bend nothing.
    if bent.dot(bent) > 0.0 { bent } else { n }
}

/// What a paint's pictures make of a place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Look {
    /// Times the surface's own.
    pub color: Vec3,
    /// Weight of the specular term.
    pub specular: Vec3,
    /// The specular exponent.
    pub exponent: f32,
    /// The normal in tangent space; of any length.
    pub tangent: Vec3,
}

/// `uvs`: the texture coordinates here, one pixel to the right, and one pixel down.
#[must_use]
pub fn look_of(texels: &[u32], filtering: u32, paint: &Paint, uvs: [Vec2; 3], witness: &mut impl Witness) -> Look {
    let mut read = |of, map: &Map, decode| {
        let value = sample_map(texels, filtering, map, uvs, decode);
        witness.texel(of, value);
        value
    };
    let mut look = Look { color: Vec3::ONE, specular: paint.specular, exponent: paint.exponent, tangent: Vec3::Z };
    if paint.diffuse_map.first != NONE {
        look.color = read(Picture::Diffuse, &paint.diffuse_map, true);
    }
    if paint.specular_map.first != NONE {
        look.specular *= read(Picture::Specular, &paint.specular_map, false);
    }
    if paint.exponent_map.first != NONE {
        look.exponent *= read(Picture::Exponent, &paint.exponent_map, false).x;
    }
    if paint.normal_map.first != NONE {
        let map = read(Picture::Normal, &paint.normal_map, false) * 2.0 - 1.0;
        // A picture that is turned over slopes the other way, too.
        let way = Vec2::select(
            paint.normal_map.scale.cmplt(Vec2::ZERO),
            Vec2::splat(-paint.bump),
            Vec2::splat(paint.bump),
        );
        look.tangent = Vec3::new(map.x * way.x, map.y * way.y, map.z);
    }
    look
}
