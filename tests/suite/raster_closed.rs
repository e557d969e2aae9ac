//! Closed meshes that planes cut: no gap where two faces meet, and no pixel of both.

use std::collections::HashMap;

use rayon::prelude::*;
use twinlight::gpu::wgsl::Sources;
use twinlight::gpu::{GpuRaster, Variant};
use twinlight::math::Vec3;
use twinlight::math::vector::unit;
use twinlight::prepare::lens::{Pose, perspective};
use twinlight::tables::{Drawing, Face, NONE, Vertex};

use super::raster_exact::{on_cpu, on_gpu, random_drawing};
use super::{Dice, gpu};

const BALLS: u32 = 600;
const NEAR: f32 = 0.8;
const FAR: f32 = 1.7;
/// What the film spans at a distance of one: half its width and half its height.
const SPAN: [f32; 2] = [1.0, 0.7];

/// A ball of 8 n^2 faces around the eye, each corner at a distance of its own, nearer than the near plane and farther
/// than the far one: whichever way the eye looks, it looks at one face.
fn ball(number: u32) -> Drawing {
    let mut dice = Dice(number, 21);
    let n = 2 + dice.below(3) as i32;
    let size = [[61, 43], [33, 47]][dice.below(2)];
    let axis = unit(dice.point(1.0));
    let side = unit(axis.cross(dice.point(1.0)));
    let up = axis.cross(side);
    let mut places = HashMap::new();
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    for octant in 0..8 {
        let sign = [1, 2, 4].map(|bit| if octant & bit == 0 { 1 } else { -1 });
        let mut corner = |i: i32, j: i32| {
            let flat = [i * sign[0], j * sign[1], (n - i - j) * sign[2]];
            *places.entry(flat).or_insert_with(|| {
                let [x, y, z] = flat.map(|part| part as f32);
                let position = unit(axis * x + side * y + up * z) * dice.within(0.4, 2.6);
                vertices.push(Vertex { position, u: 0.0, normal: Vec3::Z, v: 0.0 });
                vertices.len() as u32 - 1
            })
        };
        for (i, j) in (0..n).flat_map(|i| (0..n - i).map(move |j| (i, j))) {
            faces.push(Face { a: corner(i, j), b: corner(i + 1, j), c: corner(i, j + 1), paint: 0 });
            if i + j + 2 <= n {
                faces.push(Face { a: corner(i, j + 1), b: corner(i + 1, j), c: corner(i + 1, j + 1), paint: 0 });
            }
        }
    }
    let pose = Pose { eye: Vec3::ZERO, axes: [Vec3::X, Vec3::Y, Vec3::Z] };
    let mut lens = perspective(&pose, SPAN, [NEAR, FAR], size, [0.0; 2]);
    lens.small = [1, 16, 64][number as usize % 3];
    Drawing { eyes: vec![lens], vertices, faces, ..random_drawing(0) }
}

/// How far along the view what is seen in a direction lies, in f64.
fn depth(drawing: &Drawing, [x, y]: [f64; 2]) -> f64 {
    let ray = Vec3::NEG_Z.as_dvec3().with_x(x).with_y(y);
    let met = drawing.faces.iter().filter_map(|face| {
        let [a, b, c] = [face.a, face.b, face.c].map(|i| drawing.vertices[i as usize].position.as_dvec3());
        let sides = [b.cross(c).dot(ray), c.cross(a).dot(ray), a.cross(b).dot(ray)];
        let whole = a.dot(b.cross(c));
        sides.iter().all(|side| side * whole >= 0.0).then(|| whole / (sides[0] + sides[1] + sides[2]))
    });
    met.fold(f64::INFINITY, |least, t| if t > 0.0 { least.min(t) } else { least })
}

/// Whether a pixel must show a face, or must not; neither where a plane cuts the ball within a pixel of it. Tips of the
/// ball are so thin that all around of them may be on the other side: the corners' rounding is asked for, too.
fn wanted(drawing: &Drawing, pixel: usize) -> Option<bool> {
    let [width, height] = [drawing.eyes[0].width, drawing.eyes[0].height].map(f64::from);
    let [column, row] = [pixel as f64 % width, (pixel as f64 / width).floor()];
    let mut inside = (0..18).map(|i| {
        let step = if i < 9 { 1.0 } else { 1.0 / 64.0 };
        let x = (column + 0.5 + f64::from(i % 3 - 1) * step) / width * 2.0 - 1.0;
        let y = 1.0 - (row + 0.5 + f64::from(i % 9 / 3 - 1) * step) / height * 2.0;
        let t = depth(drawing, [x * f64::from(SPAN[0]), y * f64::from(SPAN[1])]);
        f64::from(NEAR) < t && t < f64::from(FAR)
    });
    let first = inside.next()?;
    inside.all(|other| other == first).then_some(first)
}

/// How many faces each pixel shows, one drawn after the other.
fn hits(drawing: &Drawing) -> Vec<u32> {
    let mut hits = vec![0; drawing.eyes[0].pixels() as usize];
    let mut alone = drawing.clone();
    for face in &drawing.faces {
        alone.faces = vec![*face];
        for (hit, id) in hits.iter_mut().zip(&on_cpu(&alone).1[1]) {
            *hit += u32::from(*id != NONE);
        }
    }
    hits
}

/// Pixels with two faces, with none where there must be one, and with one where there must be none; and pixels in which
/// that could be told.
fn wrong(drawing: &Drawing, as_of: &Drawing) -> ([usize; 3], [usize; 2]) {
    let (mut wrong, mut asked) = ([0; 3], [0; 2]);
    for (pixel, hits) in hits(drawing).into_iter().enumerate() {
        wrong[0] += usize::from(hits > 1);
        if let Some(wanted) = wanted(as_of, pixel) {
            wrong[1] += usize::from(wanted && hits == 0);
            wrong[2] += usize::from(!wanted && hits > 0);
            asked[usize::from(wanted)] += 1;
        }
    }
    (wrong, asked)
}

#[test]
fn closed_meshes_cut_by_planes_have_no_gap_and_no_double_hit() {
    let asked = (0..BALLS).into_par_iter().map(|number| {
        let drawing = ball(number);
        let (wrong, asked) = wrong(&drawing, &drawing);
        assert_eq!(wrong, [0; 3], "ball {number}: pixels hit twice, gaps, and hits where the planes cut");
        asked
    });
    let asked = asked.reduce(|| [0; 2], |a, b| [a[0] + b[0], a[1] + b[1]]);
    assert!(asked.iter().all(|asked| *asked > 200_000), "{asked:?} pixels show none and one");
}

#[test]
fn closed_meshes_are_cut_the_same() {
    let gpu = gpu();
    let kernels = GpuRaster::of(&gpu, &Sources::default(), &ball(0), Variant::of(&gpu)).expect("kernels");
    for number in 0..100 {
        let drawing = ball(number);
        let on_gpu = on_gpu(&kernels, &drawing, 1 << 12).expect("a drawing");
        assert!(on_cpu(&drawing).1 == on_gpu, "ball {number}");
    }
}

#[test]
fn a_ball_that_is_not_closed_has_gaps_or_double_hits() {
    let (mut gaps, mut doubles) = (0, 0);
    for number in 0..8 {
        let whole = ball(number);
        let mut open = whole.clone();
        open.faces.remove(open.faces.len() / 3);
        gaps += wrong(&open, &whole).0[1];
        // Each face has corners of its own, a hundredth off.
        let mut loose = whole.clone();
        let mut dice = Dice(number, 22);
        loose.vertices.clear();
        for face in &mut loose.faces {
            let first = loose.vertices.len() as u32;
            for corner in [face.a, face.b, face.c] {
                let vertex = whole.vertices[corner as usize];
                let position = vertex.position + dice.point(1e-2);
                loose.vertices.push(Vertex { position, ..vertex });
            }
            *face = Face { a: first, b: first + 1, c: first + 2, ..*face };
        }
        let wrong = wrong(&loose, &whole).0;
        gaps += wrong[1];
        doubles += wrong[0];
    }
    assert!(gaps > 100 && doubles > 50, "{gaps} gaps, {doubles} double hits");
}
