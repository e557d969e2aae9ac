//! a ray and a scene of few primitives -> its nearest hit, whether it is free, and the surface; all without loops

use glam::Vec3;

use crate::cpu::trace::aim::Ray;
use crate::cpu::trace::meet::{meet_plane, meet_sphere};
use crate::cpu::trace::surface::Surface;
use crate::math::vector::unit;
use crate::tables::{FAR, NONE, Tables};

/// Here a hit is a primitive's number: spheres, then planes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Found {
    /// [`FAR`] if there is none.
    pub t: f32,
    /// The primitive, or [`NONE`].
    pub hit: u32,
}

/// The distance to each primitive, with its number.
fn distances(tables: &Tables, ray: Ray) -> impl Iterator<Item = (f32, u32)> {
    let per_length_squared = 1.0 / ray.direction.dot(ray.direction);
    let spheres = tables.spheres.iter().zip(0..);
    let spheres =
        spheres.map(move |(sphere, i)| (meet_sphere(ray, sphere, per_length_squared, ray.leaves == i), i));
    let planes = tables.planes.iter().zip(tables.settings.spheres..).filter(move |(_, i)| *i != ray.leaves);
    spheres.chain(planes.map(move |(plane, i)| (meet_plane(ray, plane), i)))
}

/// The nearest primitive; of two at one distance the one whose number is lower.
#[must_use]
pub fn nearest(tables: &Tables, ray: Ray) -> Found {
    let none = Found { t: FAR, hit: NONE };
    distances(tables, ray).fold(none, |found, (t, hit)| if t < found.t { Found { t, hit } } else { found })
}

/// Whether nothing stands in the ray's way up to `reach`.
#[must_use]
pub fn free(tables: &Tables, ray: Ray, reach: f32) -> bool {
    distances(tables, ray).all(|(t, _)| t >= reach)
}

/// [`surface_at`](super::surface::surface_at) by a primitive's number.
#[must_use]
pub fn surface_of(tables: &Tables, ray: Ray, t: f32, hit: u32) -> Surface {
    let along = ray.origin + ray.direction * t;
    let (point, mut normal, material) = if hit < tables.settings.spheres {
        let sphere = &tables.spheres[hit as usize];
        let normal = unit(along - sphere.center);
        (sphere.center + normal * sphere.radius, normal, sphere.material)
    } else {
        let plane = &tables.planes[(hit - tables.settings.spheres) as usize];
        (along - plane.normal * plane.normal.dot(along - plane.point), plane.normal, plane.material)
    };
    if normal.dot(ray.direction) > 0.0 {
        normal = -normal;
    }
    let material = tables.materials[material as usize];
    Surface { point, normal, shading: normal, material, specular: Vec3::ONE, margin: 0.0, back: Vec3::ZERO }
}
