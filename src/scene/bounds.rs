//! a scene -> the ball around all that has an end

use glam::Vec3;

use super::Scene;

impl Scene {
    /// The middle of the box around all spheres, triangles and models, and a corner of it; nothing if there is none.
    #[must_use]
    pub fn bounds(&self) -> Option<[Vec3; 2]> {
        let spheres = self.spheres.iter().flat_map(|s| [s.center - s.radius, s.center + s.radius]);
        let triangles = self.triangles.iter().flat_map(|t| t.vertices);
        let meshes = self.meshes.iter().flat_map(|m| m.model.positions.iter().map(|p| m.place(*p)));
        let none = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        let (low, high) =
            spheres.chain(triangles).chain(meshes).fold(none, |(low, high), p| (low.min(p), high.max(p)));
        (low.x <= high.x).then(|| [(low + high) * 0.5, high])
    }
}
