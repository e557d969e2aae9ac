//! A model that stands in the scene, once or many times.

use std::collections::HashMap;
use std::sync::Arc;

use glam::{EulerRot, Quat, Vec3};

use super::model::Model;
use super::{Behavior, Scene};

/// A model and where it stands.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    /// Shared by all meshes of one file.
    pub model: Arc<Model>,
    /// Where its origin stands, in world space.
    pub translate: Vec3,
    /// Radians that it is turned about x, then about y, then about z.
    pub rotate: Vec3,
    /// Above zero.
    pub scale: f32,
    /// Which of the scene's materials covers it instead of its own.
    pub material: Option<usize>,
    /// Whether its faces are seen from their front alone.
    pub one_sided: bool,
    /// Which of the instances of its table it is, if this has any, and where that stands.
    pub instance: Option<Instance>,
}

/// Where a mesh that is placed already stands in its turn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Instance {
    /// Its number among those of its mesh.
    pub number: usize,
    /// Where the mesh's own world has its origin, in world space.
    pub translate: Vec3,
    /// As [`Mesh::rotate`].
    pub rotate: Vec3,
    /// Above zero.
    pub scale: f32,
}

impl Mesh {
    /// A model as it is.
    #[must_use]
    pub fn of(model: Arc<Model>) -> Self {
        Self {
            model,
            translate: Vec3::ZERO,
            rotate: Vec3::ZERO,
            scale: 1.0,
            material: None,
            one_sided: false,
            instance: None,
        }
    }

    /// A direction of the model in world space, of the same length.
    #[must_use]
    pub fn turn(&self, v: Vec3) -> Vec3 {
        let v = turned(v, self.rotate);
        self.instance.map_or(v, |instance| turned(v, instance.rotate))
    }

    /// A point of the model in world space.
    #[must_use]
    pub fn place(&self, p: Vec3) -> Vec3 {
        let p = turned(p * self.scale, self.rotate) + self.translate;
        self.instance.map_or(p, |i| turned(p * i.scale, i.rotate) + i.translate)
    }

    /// The corners of its triangles, in world space.
    pub fn corners(&self) -> impl Iterator<Item = Vec3> {
        let positions = self.model.triangles.iter().flat_map(|t| t.corners).map(|corner| corner.position);
        positions.map(|position| self.place(self.model.positions[position as usize]))
    }

    /// How much larger it is in the world.
    #[must_use]
    pub fn size(&self) -> f32 {
        self.scale * self.instance.map_or(1.0, |instance| instance.scale)
    }
}

fn turned(v: Vec3, by: Vec3) -> Vec3 {
    if by == Vec3::ZERO {
        return v;
    }
    // z y x: x is the first to turn.
    Quat::from_euler(EulerRot::ZYX, by.z, by.y, by.x) * v
}

impl Scene {
    /// Whether a mesh's faces have no backs for the ray tracer: what goes into glass has to come out of it.
    #[must_use]
    pub fn has_no_backs(&self, mesh: &Mesh) -> bool {
        let glass = |material: usize| self.materials[material].behavior == Behavior::Glass;
        mesh.one_sided && !mesh.material.is_some_and(glass)
    }

    /// The meshes that stand alone, and those that share a model and all that rays ask of it: as numbers of
    /// [`Scene::meshes`], in their order, those that share together.
    #[must_use]
    pub fn alone_and_shared(&self) -> (Vec<usize>, Vec<Vec<usize>>) {
        let mut groups: Vec<Vec<usize>> = Vec::new();
        let mut known = HashMap::new();
        for (i, mesh) in self.meshes.iter().enumerate() {
            // What is scaled beyond all measure has no way back to its model in 32 bits.
            if !(1e-12..1e12).contains(&mesh.size()) {
                groups.push(vec![i]);
                continue;
            }
            let kind = (Arc::as_ptr(&mesh.model), self.has_no_backs(mesh), mesh.material.is_some());
            let group = *known.entry(kind).or_insert_with(|| {
                groups.push(Vec::new());
                groups.len() - 1
            });
            groups[group].push(i);
        }
        let (alone, shared): (Vec<_>, Vec<_>) = groups.into_iter().partition(|group| group.len() == 1);
        (alone.concat(), shared)
    }
}
