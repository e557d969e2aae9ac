//! the things of a scene -> the box around those that are small beside the rest

use glam::Vec3;

use crate::scene::{Mesh, Scene};

/// How many times as large as all smaller ones together a thing is, at least, that makes them small.
const LARGER: f32 = 8.0;

/// The lowest and the highest corner of the box around all things that are smaller than the one that is largest beside
/// those before it; nothing if none is that much larger than they are.
pub(super) fn small_things(scene: &Scene) -> Option<[Vec3; 2]> {
    let size = |[low, high]: [Vec3; 2]| low.distance(high);
    let spheres = scene.spheres.iter().map(|s| [s.center - s.radius, s.center + s.radius]);
    let triangles = scene.triangles.iter().map(|t| around(t.vertices));
    let placed = |mesh: &Mesh| around(mesh.model.positions.iter().map(|p| mesh.place(*p)));
    let mut boxes: Vec<_> = spheres.chain(triangles).chain(scene.meshes.iter().map(placed)).collect();
    boxes.retain(|thing| size(*thing) > 0.0 && size(*thing).is_finite());
    boxes.sort_by(|a, b| size(*a).total_cmp(&size(*b)));
    let mut boxes = boxes.into_iter();
    let (mut smaller, mut most, mut found) = (boxes.next()?, LARGER, None);
    for thing in boxes {
        let larger = size(thing) / size(smaller);
        if larger >= most {
            (most, found) = (larger, Some(smaller));
        }
        smaller = [smaller[0].min(thing[0]), smaller[1].max(thing[1])];
    }
    found
}

fn around(points: impl IntoIterator<Item = Vec3>) -> [Vec3; 2] {
    let none = [Vec3::INFINITY, Vec3::NEG_INFINITY];
    points.into_iter().fold(none, |[low, high], p| [low.min(p), high.max(p)])
}
