//! spheres -> the columns and rows of faces that each is drawn with

use std::f64::consts::{PI, TAU};

use glam::Vec3;

use crate::scene::{Scene, Sphere};

/// Columns and rows of a sphere's faces.
const AROUND: u32 = 96;
const DOWN: u32 = 48;
/// Faces that a sphere is drawn with, unless it is wide.
pub const SPHERE_FACES: u32 = 2 * AROUND * DOWN;
/// How many times as large as all smaller things together a sphere is wide: their ground, if they are at it.
const WIDE: f32 = 8.0;
/// How many times their size they may be away from it.
const AT_IT: f32 = 2.0;
/// The first columns and rows of a wide sphere, as a share of the things' size, and how much farther each is from the
/// first ones than the one before: faces are off by less than a hundredth of how far they are from the things, times the
/// angle that this way spans on the sphere.
const FIRST: f64 = 0.25;
const WIDER: f64 = 1.25;
/// The finest, in radians: f32 tells no finer ones apart.
const FINEST: f64 = 1e-6;

/// How a sphere is drawn.
#[derive(Debug, Clone)]
pub(super) struct Ball {
    /// Where columns begin and the last one ends, as shares of the way around.
    pub(super) columns: Vec<f32>,
    /// Where rows begin and the last one ends, as shares of the way from the top down.
    pub(super) rows: Vec<f32>,
}

impl Ball {
    pub(super) fn faces(&self) -> u32 {
        2 * (self.columns.len() as u32 - 1) * (self.rows.len() as u32 - 1)
    }
}

/// How many faces each of a scene's spheres is drawn with.
#[must_use]
pub fn sphere_faces(scene: &Scene) -> Vec<u32> {
    balls(scene).iter().map(Ball::faces).collect()
}

/// How each of a scene's spheres is drawn.
pub(super) fn balls(scene: &Scene) -> Vec<Ball> {
    let usual = Ball { columns: even(AROUND), rows: even(DOWN) };
    let mut balls = vec![usual; scene.spheres.len()];
    let mut order: Vec<usize> = (0..scene.spheres.len()).collect();
    order.sort_by(|a, b| scene.spheres[*a].radius.total_cmp(&scene.spheres[*b].radius));
    let mut seen = if order.is_empty() { None } else { scene.bounds_without_spheres() };
    for number in order {
        let sphere = &scene.spheres[number];
        let around = sphere.bounds();
        let [low, high] = seen.unwrap_or(around);
        let (middle, size) = ((low + high) * 0.5, low.distance(high) * 0.5);
        let away = (middle.distance(sphere.center) - sphere.radius).abs();
        if seen.is_some() && sphere.radius >= WIDE * size && away <= AT_IT * size {
            balls[number].refine(sphere, middle, size);
        }
        seen = Some([low.min(around[0]), high.max(around[1])]);
    }
    balls
}

/// 0, 1 / count ... 1.
fn even(count: u32) -> Vec<f32> {
    (0..=count).map(|i| i as f32 / count as f32).collect()
}

/// Ways from the middle of the finest columns or rows to the next ones, in radians, up to what columns and rows are
/// anyway.
fn steps(first: f64) -> impl Iterator<Item = f64> {
    let usual = TAU / f64::from(AROUND);
    let wider = |step: &f64| Some(step * WIDER);
    std::iter::successors(Some(first.max(FINEST)), wider).take_while(move |step| step * (WIDER - 1.0) < usual)
}

impl Ball {
    /// More columns and rows where `middle` is nearest, around which things of this size stand.
    fn refine(&mut self, sphere: &Sphere, middle: Vec3, size: f32) {
        let way = (middle - sphere.center).as_dvec3();
        let across = way.x.hypot(way.z);
        let turn = (-way.z).atan2(way.x).rem_euclid(TAU) / TAU;
        let fall = across.atan2(way.y) / PI;
        let first = FIRST * f64::from(size) / f64::from(sphere.radius);
        let add = |all: &mut Vec<f32>, at: f64, first: f64, whole: f64| {
            let beside = |step: f64| [at - step / whole, at + step / whole];
            all.extend(std::iter::once(at).chain(steps(first).flat_map(beside)).map(|at| at as f32));
        };
        add(&mut self.rows, fall, first, PI);
        self.rows.retain(|row| (0.0..=1.0).contains(row));
        // Columns are narrow near the poles as they are.
        let narrow = across / way.length() + 4.0 * first;
        if first / narrow < TAU / f64::from(AROUND) {
            add(&mut self.columns, turn, first / narrow, TAU);
            for column in &mut self.columns {
                *column = if *column == 1.0 { 1.0 } else { column.rem_euclid(1.0) };
            }
        }
        for all in [&mut self.columns, &mut self.rows] {
            all.sort_by(f32::total_cmp);
            all.dedup();
        }
    }
}
