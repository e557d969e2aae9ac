//! a point of a primitive -> the normal that it is lit by there, and what its pictures say

use glam::{Vec2, Vec3};

use crate::cpu::shade::look::{Look, bumped, look_of, sum_by, uv_by};
use crate::cpu::trace::aim::Ray;
use crate::cpu::trace::instanced::{Primitive, corner_of};
use crate::cpu::witness::Witness;
use crate::math::angle::turns;
use crate::math::fence::fence;
use crate::math::vector::unit;
use crate::tables::{MIPMAP, NONE, PLANE, SPHERE, Tables, View};

/// What of a surface is not its primitive's and not its material's alone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Detail {
    /// Of length one; on the outer side.
    pub normal: Vec3,
    /// What the pictures say.
    pub look: Look,
}

fn on_plane(view: &View, way: Vec3, above: f32, normal: Vec3, most: f32) -> Vec3 {
    let t = above / normal.dot(way);
    // Beyond the horizon it is far away.
    fence(view.eye + way * if t > 0.0 && t < most { t } else { most })
}

/// Where the eye's rays one pixel to the right and one down meet the plane of a surface that it sees: a pixel's
/// footprint. What mirrors and glass show has none, and so is read from the finest level.
fn beside(view: &View, ray: Ray, point: Vec3, normal: Vec3) -> [Vec3; 2] {
    let from = point - view.eye;
    let depth = -from.dot(view.back);
    let seen = ray.leaves == NONE && depth > 0.0;
    if !seen {
        return [point; 2];
    }
    let way = from / depth;
    let above = normal.dot(from);
    let most = depth * 1e4;
    let ways = [way + view.right / view.width as f32, way - view.up / view.height as f32];
    ways.map(|way| on_plane(view, way, above, normal, most))
}

/// What each corner of a triangle counts for at a point of its plane; they sum to one.
fn weights_at(p: Vec3, normal: Vec3, a: Vec3, b: Vec3, c: Vec3) -> Vec3 {
    let area = |q: Vec3, r: Vec3| (q - p).cross(r - p).dot(normal);
    let areas = Vec3::new(area(b, c), area(c, a), area(a, b));
    let sum = (areas.x + areas.y) + areas.z;
    if sum == 0.0 {
        return Vec3::X;
    }
    areas / sum
}

/// Once around y, and from the bottom up.
fn uv_of_sphere(from: Vec3) -> Vec2 {
    let ring = (from.x * from.x + from.z * from.z).sqrt();
    Vec2::new(turns(from.x, -from.z), 1.0 - 2.0 * turns(from.y, ring))
}

/// The same, without the jump at the seam.
fn uv_near(from: Vec3, uv: Vec2) -> Vec2 {
    let near = uv_of_sphere(from);
    Vec2::new(near.x + (uv.x - near.x + 0.5).floor(), near.y)
}

/// `normal`: the primitive's own, on its outer side.
#[must_use]
pub fn detail_at(
    tables: &Tables,
    ray: Ray,
    primitive: &Primitive<'_>,
    point: Vec3,
    normal: Vec3,
    witness: &mut impl Witness,
) -> Detail {
    let leaf = &primitive.leaf;
    let settings = &tables.settings;
    let paint = &tables.paints[leaf.material as usize];
    let p = fence(point);
    let mut sides = [p; 2];
    if settings.filtering == MIPMAP {
        sides = beside(&tables.view, ray, p, normal);
    }
    let look_at = |uvs, witness: &mut _| look_of(&tables.texels, settings.filtering, paint, uvs, witness);
    if leaf.kind != SPHERE && leaf.kind != PLANE {
        let face = tables.faces[primitive.face as usize];
        let corners = [face.a, face.b, face.c].map(|i| corner_of(tables, i, primitive.holder));
        let corners = corners.each_ref();
        let weights = |p| weights_at(p, normal, leaf.a, leaf.b, leaf.c);
        // Rounding may put the point a trifle outside.
        let inside = weights(p).max(Vec3::ZERO);
        let w = inside / ((inside.x + inside.y) + inside.z);
        let mut n = normal;
        let between = sum_by(w, corners[0].normal, corners[1].normal, corners[2].normal);
        if between.dot(between) > 0.0 {
            n = unit(between);
        }
        let mut uvs = [uv_by(w, corners); 3];
        if settings.filtering == MIPMAP {
            uvs = [uvs[0], uv_by(weights(sides[0]), corners), uv_by(weights(sides[1]), corners)];
        }
        let look = look_at(uvs, witness);
        if paint.normal_map.first != NONE {
            n = bumped(n, corners, look.tangent, witness);
        }
        return Detail { normal: n, look };
    }
    let from = [p, sides[0], sides[1]].map(|p| p - leaf.a);
    let along_u = if leaf.kind == SPHERE { Vec3::new(normal.z, 0.0, -normal.x) } else { leaf.c };
    let along_v = normal.cross(along_u);
    let uvs = if leaf.kind == SPHERE {
        let uv = uv_of_sphere(from[0]);
        [uv, uv_near(from[1], uv), uv_near(from[2], uv)]
    } else {
        from.map(|from| Vec2::new(from.dot(along_u), from.dot(along_v)))
    };
    let look = look_at(uvs, witness);
    let mut n = normal;
    if paint.normal_map.first != NONE && along_u.dot(along_u) > 0.0 {
        let (t, b) = (unit(along_u), unit(along_v));
        witness.tangents([t, b]);
        n = unit(sum_by(look.tangent, t, b, n));
    }
    Detail { normal: n, look }
}
