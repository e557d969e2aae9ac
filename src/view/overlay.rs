//! what made a pixel -> lines over the picture: a ray tree as it runs through the scene, or the face that is seen

use glam::{Vec2, Vec3};

use super::eye::Eye as _;
use crate::explain::{Explanation, Samples, Traced, Way};
use crate::scene::{Camera, Light, Scene};

/// What a line stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stroke {
    /// An edge of the face that is seen.
    Edge,
    /// A ray that came off a surface.
    Reflected,
    /// A ray that went through one.
    Refracted,
    /// A shadow ray that arrives at its light.
    Lit,
    /// A shadow ray that something stops.
    Blocked,
}

/// A line over the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// Its ends, in shares of the picture from its upper left corner; they may lie outside.
    pub ends: [Vec2; 2],
    /// What it stands for.
    pub stroke: Stroke,
}

/// More lines than these tell nothing.
const MOST: usize = 400;

/// The lines of an explanation over the picture that `scene` describes.
#[must_use]
pub fn lines(scene: &Scene, told: &Explanation) -> Vec<Line> {
    let [width, height] = told.size.map(|side| side as f32);
    let aspect = scene.camera.aspect.unwrap_or(width / height);
    let mut strokes = Vec::new();
    match &told.samples {
        Samples::Raster(samples) => {
            for seen in samples.iter().filter_map(|sample| sample.seen.as_ref()) {
                let [a, b, c] = seen.corners;
                strokes.extend([[a, b], [b, c], [c, a]].map(|ends| (ends, Stroke::Edge)));
            }
        }
        Samples::Trace(samples) => {
            let far = scene.bounds().map_or(10.0, |[middle, corner]| 2.0 * middle.distance(corner));
            for ray in samples.iter().flat_map(|sample| &sample.rays) {
                strokes.extend(of_ray(scene, ray, far));
            }
        }
    }
    strokes.truncate(MOST);
    let seen = |(ends, stroke)| Some(Line { ends: project(&scene.camera, aspect, ends)?, stroke });
    let mut lines: Vec<_> = strokes.into_iter().filter_map(seen).collect();
    // Samples of a pixel see the same faces.
    lines.dedup();
    lines
}

/// A ray of a tree and the shadow rays of what it meets. The primary one is a point of the picture.
fn of_ray(scene: &Scene, ray: &Traced, far: f32) -> Vec<([Vec3; 2], Stroke)> {
    let mut strokes = Vec::new();
    let end = ray.meets.as_ref().map_or(ray.origin + ray.direction * far, |meeting| meeting.point);
    match ray.way {
        Way::Primary => {}
        Way::Reflected => strokes.push(([ray.origin, end], Stroke::Reflected)),
        Way::Refracted => strokes.push(([ray.origin, end], Stroke::Refracted)),
    }
    let lights = ray.meets.iter().flat_map(|meeting| meeting.lights.iter().zip(&scene.lights));
    for (shadow, light) in lights.filter(|(shadow, _)| shadow.before) {
        let way = if matches!(light, Light::Point { .. }) { shadow.toward } else { shadow.toward * far };
        let stroke = if shadow.arrives { Stroke::Lit } else { Stroke::Blocked };
        strokes.push(([end, end + way], stroke));
    }
    strokes
}

/// A line in world space on the picture, as far as it lies before the eye.
fn project(camera: &Camera, aspect: f32, ends: [Vec3; 2]) -> Option<[Vec2; 2]> {
    let near = camera.near.max(1e-4);
    let [from, to] = ends.map(|point| camera.depth(point) - near);
    if from < 0.0 && to < 0.0 {
        return None;
    }
    let cut = ends[0] + (ends[1] - ends[0]) * (from / (from - to));
    let ends = [if from < 0.0 { cut } else { ends[0] }, if to < 0.0 { cut } else { ends[1] }];
    Some(ends.map(|point| camera.place(point) / Vec2::new(aspect, 1.0) + 0.5))
}
