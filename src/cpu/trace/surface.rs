//! a hit -> the point, the normal that faces the ray, and the material

use glam::Vec3;

use crate::cpu::trace::meet::Ray;
use crate::math::vector::unit;
use crate::tables::{Material, Tables};

/// Where a ray has met a primitive.
#[derive(Debug, Clone, Copy)]
pub struct Surface {
    /// In world space.
    pub point: Vec3,
    /// Of length one, on the ray's side.
    pub normal: Vec3,
    /// What it is made of.
    pub material: Material,
}

/// The point is put back onto the primitive, so that its error does not grow with the ray's length.
#[must_use]
pub fn surface_at(tables: &Tables, ray: Ray, t: f32, hit: u32) -> Surface {
    let along = ray.origin + ray.direction * t;
    let planes_from = tables.settings.spheres;
    let triangles_from = planes_from + tables.settings.planes;
    let (point, mut normal, material) = if hit < planes_from {
        let sphere = &tables.spheres[hit as usize];
        let normal = unit(along - sphere.center);
        (sphere.center + normal * sphere.radius, normal, sphere.material)
    } else if hit < triangles_from {
        let plane = &tables.planes[(hit - planes_from) as usize];
        (along - plane.normal * plane.normal.dot(along - plane.point), plane.normal, plane.material)
    } else {
        let triangle = &tables.triangles[(hit - triangles_from) as usize];
        let normal = unit((triangle.b - triangle.a).cross(triangle.c - triangle.a));
        (along - normal * normal.dot(along - triangle.a), normal, triangle.material)
    };
    if normal.dot(ray.direction) > 0.0 {
        normal = -normal;
    }
    Surface { point, normal, material: tables.materials[material as usize] }
}
