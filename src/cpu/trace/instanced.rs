//! an instance of a model -> a ray as the model sees it, and what it meets there as the world sees it

use glam::Vec3;

use crate::cpu::shade::look::sum_by;
use crate::cpu::trace::aim::Ray;
use crate::math::vector::unit;
use crate::tables::{Instance, Leaf, Tables, Vertex};

/// The distances along the ray are the same: its direction shrinks with the world.
#[must_use]
pub fn ray_within(ray: Ray, placed: &Instance) -> Ray {
    let within = |v: Vec3| Vec3::new(v.dot(placed.x), v.dot(placed.y), v.dot(placed.z)) * placed.shrink;
    Ray { origin: within(ray.origin - placed.origin), direction: within(ray.direction), leaves: ray.leaves }
}

/// A point of the model in the world.
fn point_of(p: Vec3, placed: &Instance) -> Vec3 {
    sum_by(p, placed.x, placed.y, placed.z) + placed.origin
}

/// The instance that a hit belongs to, if any. Hits on instances are numbered by ids, after all leaves of the world.
#[must_use]
pub fn instance_of(tables: &Tables, hit: u32) -> Option<&Instance> {
    let settings = &tables.settings;
    let id = hit.checked_sub(settings.instances).filter(|id| *id >= settings.loose)?;
    tables.instances.get(tables.instances.partition_point(|placed| placed.id <= id).checked_sub(1)?)
}

/// What a ray has met: in the world, with its own id and material.
#[derive(Debug, Clone, Copy)]
pub struct Primitive<'a> {
    /// As if it stood in the world's own tree.
    pub leaf: Leaf,
    /// Of a triangle.
    pub face: u32,
    /// The instance that it is part of.
    pub holder: Option<&'a Instance>,
}

/// The primitive of a hit.
#[must_use]
pub fn primitive_at(tables: &Tables, hit: u32) -> Primitive<'_> {
    let settings = &tables.settings;
    let Some(placed) = instance_of(tables, hit) else {
        let leaf = tables.leaves[hit as usize];
        let face = leaf.id.wrapping_sub(settings.spheres + settings.planes);
        return Primitive { leaf, face, holder: None };
    };
    let own = tables.leaves[(hit - settings.instances - placed.id + placed.leaves) as usize];
    let [a, b, c] = [own.a, own.b, own.c].map(|p| point_of(p, placed));
    let leaf = Leaf { a, id: own.id + placed.id, b, material: own.material + placed.material, c, kind: own.kind };
    Primitive { leaf, face: own.id + placed.face, holder: Some(placed) }
}

/// A corner of a face in the world.
#[must_use]
pub fn corner_of(tables: &Tables, i: u32, holder: Option<&Instance>) -> Vertex {
    let corner = tables.vertices[i as usize];
    let Some(placed) = holder else { return corner };
    let normal = unit(sum_by(corner.normal, placed.x, placed.y, placed.z));
    Vertex { position: point_of(corner.position, placed), normal, ..corner }
}
