//! an eye and the glass of a scene -> whether its rays start inside

use glam::{DVec3, Vec3};

use crate::scene::{Behavior, Mesh, Scene};

/// Whether the eye is inside an odd number of glass bodies: each surface that a ray passes takes it in or out again.
/// Planes have no inside.
pub(super) fn inside(scene: &Scene) -> bool {
    let eye = scene.camera.position;
    let glass = |material: usize| scene.materials.get(material).is_some_and(|m| m.behavior == Behavior::Glass);
    let spheres = scene.spheres.iter().filter(|s| glass(s.material) && s.center.distance(eye) < s.radius);
    let loose: Vec<_> = scene.triangles.iter().filter(|t| glass(t.material)).map(|t| t.vertices).collect();
    let meshes = scene.meshes.iter().filter(|mesh| mesh.material.is_some_and(glass) && encloses(mesh, eye));
    (spheres.count() + usize::from(surround(loose.iter().copied(), eye)) + meshes.count()) % 2 == 1
}

/// Whether a point of the world is inside a mesh.
fn encloses(mesh: &Mesh, point: Vec3) -> bool {
    let offset = point - mesh.place(Vec3::ZERO);
    let local = [Vec3::X, Vec3::Y, Vec3::Z].map(|axis| mesh.turn(axis).dot(offset) / mesh.size());
    let local = Vec3::from_array(local);
    let positions = &mesh.model.positions;
    let none = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    let (low, high) = positions.iter().fold(none, |(low, high), p| (low.min(*p), high.max(*p)));
    // Most are far from the eye, and not asked triangle by triangle.
    if local.cmple(low).any() || local.cmpge(high).any() {
        return false;
    }
    let corners = mesh.model.triangles.iter().map(|t| t.corners.map(|corner| positions[corner.position as usize]));
    surround(corners, local)
}

/// Ways that run along nothing that people build.
const WAYS: [DVec3; 3] =
    [DVec3::new(0.301, 0.907, 0.294), DVec3::new(-0.713, 0.412, 0.567), DVec3::new(0.463, -0.251, -0.850)];

/// Whether each way from a point crosses an odd number of triangles: not every one does where they leave a gap.
fn surround(triangles: impl Iterator<Item = [Vec3; 3]>, point: Vec3) -> bool {
    let mut odd = [false; WAYS.len()];
    for corners in triangles {
        let corners = corners.map(|corner| corner.as_dvec3() - point.as_dvec3());
        for (odd, way) in odd.iter_mut().zip(WAYS) {
            *odd ^= crosses(corners, way);
        }
    }
    odd == [true; WAYS.len()]
}

/// Whether a ray from the origin crosses a triangle.
fn crosses([a, b, c]: [DVec3; 3], way: DVec3) -> bool {
    let signs = [way.dot(a.cross(b)), way.dot(b.cross(c)), way.dot(c.cross(a))];
    let through = signs.iter().all(|s| *s > 0.0) || signs.iter().all(|s| *s < 0.0);
    let normal = (b - a).cross(c - a);
    through && normal.dot(a) * normal.dot(way) > 0.0
}
