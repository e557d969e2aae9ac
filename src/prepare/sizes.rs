//! the things of a scene -> the box around those that are small beside the rest

use glam::Vec3;

use crate::scene::{Scene, Sphere, around};

/// How many times as large as all smaller ones together a thing is, at least, that makes them small.
const LARGER: f32 = 8.0;

/// The lowest and the highest corner of the box around all things that are small beside the next larger one; of several
/// such steps the one between the largest. A sphere all around the others is a sky, and no such thing.
pub(super) fn small_things(scene: &Scene) -> Option<[Vec3; 2]> {
    let size = |[low, high]: [Vec3; 2]| low.distance(high);
    let spheres = scene.spheres.iter().map(|sphere| (sphere.bounds(), Some(sphere)));
    let triangles = scene.triangles.iter().filter_map(|t| around(t.vertices));
    let meshes = scene.meshes.iter().filter_map(|mesh| around(mesh.corners()));
    let flat = triangles.chain(meshes).map(|thing| (thing, None));
    let mut boxes: Vec<_> = spheres.chain(flat).collect();
    boxes.retain(|(thing, _)| size(*thing) > 0.0 && size(*thing).is_finite());
    boxes.sort_by(|a, b| size(a.0).total_cmp(&size(b.0)));
    let mut boxes = boxes.into_iter();
    let (mut smaller, mut found) = (boxes.next()?.0, None);
    for (thing, sphere) in boxes {
        let [low, high] = smaller;
        // The corner of the box that is farthest from its middle.
        let is_sky = |s: &Sphere| (s.center - low).abs().max((high - s.center).abs()).length() <= s.radius;
        if size(thing) >= LARGER * size(smaller) && !sphere.is_some_and(is_sky) {
            found = Some(smaller);
        }
        smaller = [low.min(thing[0]), high.max(thing[1])];
    }
    found
}
