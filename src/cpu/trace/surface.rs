//! a hit -> the point, the normals that face the ray, and the material

use glam::Vec3;

use crate::cpu::trace::aim::Ray;
use crate::cpu::trace::detail::detail_at;
use crate::cpu::trace::instanced::primitive_at;
use crate::cpu::witness::Witness;
use crate::math::vector::{unit, unit_of_any};
use crate::tables::{Material, PLANE, SPHERE, Tables};

/// Where a ray has met a primitive.
#[derive(Debug, Clone, Copy)]
pub struct Surface {
    /// In world space.
    pub point: Vec3,
    /// Of the primitive: of length one, on the ray's side.
    pub normal: Vec3,
    /// That it is lit by: between a triangle's corners, and as a normal map says.
    pub shading: Vec3,
    /// What it is made of.
    pub material: Material,
    /// Weight of the specular term.
    pub specular: Vec3,
    /// How far off the point rays start: triangles have neighbors, of which some are off by rounding.
    pub margin: f32,
    /// Back along the ray that came, of length one.
    pub back: Vec3,
}

/// Where a ray starts that goes on this way.
#[must_use]
pub fn start_of(surface: &Surface, way: Vec3) -> Vec3 {
    // Half of it back along the ray: so it is off the wall beside an edge, too, and through no thin sheet.
    let before = (surface.normal + surface.back) * 0.5;
    let off = if way.dot(surface.normal) < 0.0 { -surface.normal } else { before };
    if surface.margin > 0.0 { surface.point + off * surface.margin } else { surface.point }
}

/// The point is put back onto the primitive, so that its error does not grow with the ray's length.
#[must_use]
pub fn surface_at(tables: &Tables, ray: Ray, t: f32, hit: u32, witness: &mut impl Witness) -> Surface {
    let along = ray.origin + ray.direction * t;
    let primitive = primitive_at(tables, hit);
    let leaf = &primitive.leaf;
    let (point, mut normal, margin) = match leaf.kind {
        SPHERE => {
            let normal = unit(along - leaf.a);
            (leaf.a + normal * leaf.b.x, normal, 0.0)
        }
        PLANE => (along - leaf.b * leaf.b.dot(along - leaf.a), leaf.b, 0.0),
        _ => {
            let normal = unit_of_any((leaf.b - leaf.a).cross(leaf.c - leaf.a));
            // 16 units in the last place of the largest coordinate.
            let size = leaf.a.abs().max(leaf.b.abs().max(leaf.c.abs()));
            let margin = size.x.max(size.y.max(size.z)) * 9.536743e-7;
            let margin = margin.max(primitive.holder.map_or(0.0, |placed| placed.margin));
            (along - normal * normal.dot(along - leaf.a), normal, margin)
        }
    };
    let detail = detail_at(tables, ray, &primitive, point, normal, witness);
    let mut shading = detail.normal;
    if normal.dot(ray.direction) > 0.0 {
        normal = -normal;
        shading = -shading;
    }
    let mut material = tables.materials[leaf.material as usize];
    material.color *= detail.look.color;
    material.exponent = detail.look.exponent;
    let size = material.color.dot(material.color);
    material.tint = if size > 0.0 { unit(material.color) } else { Vec3::ZERO };
    let back = -unit(ray.direction);
    Surface { point, normal, shading, material, specular: detail.look.specular, margin, back }
}
