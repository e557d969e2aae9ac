//! a ray and a tree -> the ray as the tree has it, and what the numbers of its leaves grow by

#![expect(clippy::inline_always, reason = "see `aim`")]

use glam::Vec3;

use crate::cpu::trace::aim::{Aim, Ray, aim_of};
use crate::cpu::trace::instanced::ray_within;
use crate::cpu::trace::meet::meet_sphere;
use crate::cpu::trace::solid::is_solid;
use crate::tables::{Instance, Leaf, PLANE, Sphere, Tables};

/// A ray as the tree in hand has it, and what numbers of leaves grow by: the world's, or those of an instance.
#[derive(Debug, Clone, Copy)]
pub struct Seat {
    /// The ray.
    pub ray: Ray,
    /// What hangs on it alone.
    pub aim: Aim,
    /// One over the square of its direction's length.
    pub per_length_squared: f32,
    /// What a leaf's number grows by, so that it is a hit.
    pub numbers: u32,
    /// What a leaf's id grows by.
    pub ids: u32,
    /// What a leaf's id and its material grow by, so that they are those of its face.
    pub faces: [u32; 2],
}

impl Seat {
    /// In the world's tree.
    #[inline(always)]
    #[must_use]
    pub fn in_world(tables: &Tables, ray: Ray) -> Self {
        let settings = &tables.settings;
        let faces = [0_u32.wrapping_sub(settings.spheres + settings.planes), 0];
        Self::of(ray, settings.low, settings.high, [0; 2], faces)
    }

    /// In the tree of an instance's model.
    #[must_use]
    pub fn in_instance(tables: &Tables, ray: Ray, placed: &Instance) -> Self {
        let numbers = (tables.settings.instances + placed.id).wrapping_sub(placed.leaves);
        Self::of(
            ray_within(ray, placed),
            placed.low,
            placed.high,
            [numbers, placed.id],
            [placed.face, placed.material],
        )
    }

    #[inline]
    fn of(ray: Ray, low: Vec3, high: Vec3, [numbers, ids]: [u32; 2], faces: [u32; 2]) -> Self {
        let per_length_squared = 1.0 / ray.direction.dot(ray.direction);
        Self { ray, aim: aim_of(ray, low, high), per_length_squared, numbers, ids, faces }
    }

    /// Whether a triangle that the ray meets is there.
    #[inline]
    #[must_use]
    pub fn is_solid(&self, tables: &Tables, leaf: &Leaf, any: bool) -> bool {
        let own = [leaf.id.wrapping_add(self.faces[0]), leaf.material.wrapping_add(self.faces[1])];
        leaf.kind <= PLANE || is_solid(tables, self, leaf, own, any)
    }

    /// The distance to a sphere below a node; `number` as that of a hit.
    #[inline(always)]
    #[must_use]
    pub fn meet_sphere(&self, leaf: &Leaf, number: u32) -> f32 {
        let sphere = Sphere { center: leaf.a, radius: leaf.b.x, ..bytemuck::Zeroable::zeroed() };
        meet_sphere(self.ray, &sphere, self.per_length_squared, self.ray.leaves == number)
    }
}
