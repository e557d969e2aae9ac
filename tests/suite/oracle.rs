//! The recursive tracer in f64, and pictures made with it.

#[path = "recursive.rs"]
mod recursive;

use glam::DVec3;
pub(super) use recursive::Recursive;
use twinlight::cpu::trace::primary::place;
use twinlight::prepare::{pose, prepare};
use twinlight::scene::Scene;

type Real = f64;
type Vector = DVec3;

fn real(x: f32) -> f64 {
    f64::from(x)
}

pub(super) fn vector(v: glam::Vec3) -> DVec3 {
    v.as_dvec3()
}

/// The ray through a sample, by the spec's own words (2.2): X and Y on the near plane, rows from the bottom.
pub(super) fn primary(scene: &Scene, x: u32, y: u32, sample: u32) -> DVec3 {
    let [width, height] = scene.film.size.map(f64::from);
    let [right, up, back] = pose(&scene.camera).map(vector);
    let n = real(scene.camera.near);
    let tall = 2.0 * n * (real(scene.camera.fov) / 2.0).tan();
    let wide = tall * scene.camera.aspect.map_or(width / height, real);
    let at = place(&prepare(scene).view, sample).as_dvec2();
    let from_bottom = height - 1.0 - f64::from(y);
    let px = wide * (f64::from(x) + at.x - width / 2.0) / width;
    let py = tall * (from_bottom + at.y - height / 2.0) / height;
    (right * px + up * py - back * n).normalize()
}

/// The mean color of a pixel's samples.
pub(super) fn pixel(oracle: &Recursive<'_>, scene: &Scene, x: u32, y: u32) -> DVec3 {
    let samples = scene.trace.samples;
    let eye = vector(scene.camera.position);
    let colors = (0..samples).map(|s| oracle.trace(eye, primary(scene, x, y, s), false, scene.trace.depth));
    colors.sum::<DVec3>() / f64::from(samples)
}
