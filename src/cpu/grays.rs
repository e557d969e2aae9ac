//! a drawing that shows depths -> the gray of every distance

use super::raster::CpuRaster;
use crate::prepare::glance;
use crate::raster::{Raster as _, draw};
use crate::scene::{Scene, Show};
use crate::tables::{DEEP, Drawing, NO_DEPTH};

/// One in so many pixels may be nearer than white or farther than the darkest gray: specks before the eye, a horizon.
const SPECKS: usize = 50;
/// What is farthest is so gray: nothing is black.
const FARTHEST: f32 = 0.1;
/// The least that inverse distances differ by, as a share of the nearest's: what is flat has one gray.
const FLAT: f64 = 0.05;

/// Where depths are shown, makes the grays go over what the whole picture shows, as a glance at it tells: whatever part of
/// it is asked for then has the same ones. Inverse distances are what a depth buffer holds (spec, fig. 1.14).
pub fn grays(scene: &Scene, drawing: &mut Drawing) {
    if scene.raster.show != Show::Depth {
        return;
    }
    let lens = glance(scene);
    let mut stages = CpuRaster::new(drawing);
    let Ok(mut image) = stages.image((lens.width * lens.height) as usize, false);
    let Ok(()) = draw(&mut stages, &lens, &mut image);
    let mut depths = image.seen().0;
    depths.retain(|depth| *depth != NO_DEPTH);
    depths.sort_unstable();
    let specks = depths.len() / SPECKS;
    let [nearest, farthest] =
        if depths.is_empty() { [0, DEEP] } else { [depths[specks], depths[depths.len() - 1 - specks]] };
    let (near, far) = (f64::from(scene.camera.near), f64::from(scene.camera.far));
    // Of clip z, which is far / (far - near) * (w - near), over w.
    let inverse = |depth: u32| (1.0 - f64::from(depth) / f64::from(DEEP) * (far - near) / far) / near;
    let (most, least) = (inverse(nearest), inverse(farthest));
    let times = f64::from(1.0 - FARTHEST) / (most - least).max(FLAT * most);
    let middle = f64::from(1.0 + FARTHEST) / 2.0;
    drawing.canvas.depth_times = times as f32;
    (drawing.canvas.depth_least, drawing.canvas.depth_most) = (FARTHEST, 1.0);
    drawing.canvas.depth_plus = (middle - times * (most + least) / 2.0) as f32;
}
