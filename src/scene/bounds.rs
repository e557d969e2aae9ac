//! a scene -> the ball around all that has an end

use glam::Vec3;

use super::{Mesh, Scene, Sphere};

impl Scene {
    /// The middle of the box around all spheres, triangles and models, and a corner of it; nothing if there is none.
    #[must_use]
    pub fn bounds(&self) -> Option<[Vec3; 2]> {
        let spheres = self.spheres.iter().flat_map(Sphere::bounds);
        let [low, high] = around(spheres.chain(self.bounds_without_spheres().into_iter().flatten()))?;
        Some([(low + high) * 0.5, high])
    }

    /// The lowest and the highest corner of the box around all triangles and models; nothing if there is none.
    #[must_use]
    pub fn bounds_without_spheres(&self) -> Option<[Vec3; 2]> {
        let triangles = self.triangles.iter().flat_map(|t| t.vertices);
        around(triangles.chain(self.meshes.iter().flat_map(Mesh::corners)))
    }
}

impl Sphere {
    /// The lowest and the highest corner of the box around it.
    #[must_use]
    pub fn bounds(&self) -> [Vec3; 2] {
        [self.center - self.radius, self.center + self.radius]
    }
}

/// The lowest and the highest corner of the box around points; nothing if there are none.
pub(crate) fn around(points: impl IntoIterator<Item = Vec3>) -> Option<[Vec3; 2]> {
    let none = [Vec3::INFINITY, Vec3::NEG_INFINITY];
    let [low, high] = points.into_iter().fold(none, |[low, high], p| [low.min(p), high.max(p)]);
    (low.x <= high.x).then_some([low, high])
}
