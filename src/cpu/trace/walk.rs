//! a ray and the scene -> its nearest hit, or the first that stands in its way

use crate::cpu::trace::meet::{Ray, meet_plane, meet_sphere, meet_triangle, shear_of};
use crate::tables::{NONE, Tables};

/// What a walk has found so far.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Found {
    /// Only what is nearer than this counts; the distance to the hit once there is one.
    pub t: f32,
    /// The primitive, or [`NONE`].
    pub hit: u32,
    /// The next primitive to test.
    pub next: u32,
}

/// How many primitives a scene has.
#[must_use]
pub fn primitives(tables: &Tables) -> u32 {
    tables.settings.spheres + tables.settings.planes + tables.settings.triangles
}

/// Tests the primitives from `start.next` up to `end`; with `any`, stops at the first that is met.
///
/// Of two at one distance the one with the lower number is met, as only a nearer one replaces it.
#[must_use]
pub fn walk(tables: &Tables, ray: Ray, start: Found, end: u32, any: bool) -> Found {
    let mut found = start;
    let per_length_squared = 1.0 / ray.direction.dot(ray.direction);
    let planes_from = tables.settings.spheres;
    let triangles_from = planes_from + tables.settings.planes;

    let spheres_end = end.min(planes_from);
    while found.next < spheres_end && !(any && found.hit != NONE) {
        let i = found.next;
        let t = meet_sphere(ray, &tables.spheres[i as usize], per_length_squared, ray.leaves == i);
        if t < found.t {
            found.t = t;
            found.hit = i;
        }
        found.next = i + 1;
    }

    let planes_end = end.min(triangles_from);
    while found.next < planes_end && !(any && found.hit != NONE) {
        let i = found.next;
        let t = meet_plane(ray, &tables.planes[(i - planes_from) as usize]);
        if t < found.t && ray.leaves != i {
            found.t = t;
            found.hit = i;
        }
        found.next = i + 1;
    }

    let sheared = shear_of(ray.direction);
    while found.next < end && !(any && found.hit != NONE) {
        let i = found.next;
        let t = meet_triangle(ray, &tables.triangles[(i - triangles_from) as usize], sheared);
        if t < found.t && ray.leaves != i {
            found.t = t;
            found.hit = i;
        }
        found.next = i + 1;
    }
    found
}
