//! A drawing that two sides see differently -> a smaller one that they still see differently, as a text to look at.

use std::fmt::Write as _;

use twinlight::gpu::GpuRaster;
use twinlight::gpu::wgsl::Sources;
use twinlight::tables::{Drawing, Face, Lens, ONE_SIDED, TILE};

use super::gpu;
use super::raster_exact::{on_cpu, on_gpu, random_drawing};

/// Leaves out faces and makes numbers simpler, one after the other, for as long as the drawing `fails`.
pub(super) fn shrink(drawing: &Drawing, fails: impl Fn(&Drawing) -> bool) -> Drawing {
    let mut best = drawing.clone();
    while let Some(smaller) = smaller(&best).into_iter().find(&fails) {
        best = smaller;
    }
    best
}

/// All that is a little simpler, the boldest first. None of it can be made the same again, so shrinking ends.
fn smaller(drawing: &Drawing) -> Vec<Drawing> {
    let mut all = Vec::new();
    let faces = &drawing.faces;
    let mut length = faces.len() / 2;
    while length > 0 {
        let chunks = (0..faces.len()).step_by(length);
        all.extend(
            chunks.map(|i| with_faces(drawing, &[&faces[..i], &faces[faces.len().min(i + length)..]].concat())),
        );
        length /= 2;
    }
    let lens = drawing.eyes[0];
    let sized = |width: u32, height: u32| {
        let guard = |was: f32, old: u32, new: u32| was * old as f32 / new as f32;
        let (guard_x, guard_y) = (guard(lens.guard_x, lens.width, width), guard(lens.guard_y, lens.height, height));
        Lens { width, height, columns: width.div_ceil(TILE), guard_x, guard_y, ..lens }
    };
    let half = |side: u32| side.div_ceil(2);
    let lenses = [
        sized(half(lens.width), half(lens.height)),
        sized(half(lens.width), lens.height),
        sized(lens.width, half(lens.height)),
        Lens { slope: 0, ..lens },
        Lens { cull: 0, ..lens },
    ];
    all.extend(lenses.into_iter().filter(|l| *l != lens).map(|l| Drawing { eyes: vec![l], ..drawing.clone() }));
    for (i, axis) in (0..drawing.vertices.len()).flat_map(|i| (0..3).map(move |axis| (i, axis))) {
        let was = drawing.vertices[i].position[axis];
        // Zero, or rounded to ever finer steps.
        for simple in [0.0, was.round(), (was * 8.0).round() / 8.0, (was * 1024.0).round() / 1024.0] {
            if simple == was {
                break;
            }
            let mut other = drawing.clone();
            other.vertices[i].position[axis] = simple;
            all.push(other);
        }
    }
    all
}

/// The drawing with other faces, and with the vertices that these have.
fn with_faces(drawing: &Drawing, faces: &[Face]) -> Drawing {
    let mut used: Vec<_> = faces.iter().flat_map(|f| [f.a, f.b, f.c]).collect();
    used.sort_unstable();
    used.dedup();
    let place = |vertex: u32| used.iter().position(|u| *u == vertex).unwrap_or_default() as u32;
    let face = |f: &Face| Face { a: place(f.a), b: place(f.b), c: place(f.c), ..*f };
    let vertices = used.iter().map(|i| drawing.vertices[*i as usize]).collect();
    Drawing { vertices, faces: faces.iter().map(face).collect(), ..drawing.clone() }
}

/// All that a person needs to draw it by hand.
pub(super) fn text(drawing: &Drawing) -> String {
    let Lens { x, y, z, w, width, height, cull, small, slope, .. } = drawing.eyes[0];
    let mut text = format!("{width} x {height} pixels, small {small}, cull {cull}, slope {slope}\n");
    let _ = writeln!(text, "x {x}, y {y}, z {z}, w {w}");
    for (i, face) in drawing.faces.iter().enumerate() {
        let corners = [face.a, face.b, face.c].map(|i| drawing.vertices[i as usize].position.to_array());
        let sides = if face.paint & ONE_SIDED == 0 { "two-sided" } else { "one-sided" };
        let _ = writeln!(text, "face {i}, {sides}: {corners:?}");
    }
    text
}

/// A fault in the rule of who owns an edge needs one face to be seen, one in the order of equals needs two; and
/// neither needs an odd number.
#[test]
fn a_planted_fault_shrinks_to_a_drawing_that_shows_it() {
    let gpu = gpu();
    let faults = [
        ("raster/plan", "select(-1, 0, owned(a, b))", "0", 1),
        ("raster/clip", "meet(next, here, plane)", "meet(here, next, plane)", 1),
        ("raster/pixels", "(near == old.near) & (vec4u(id) > old.id)", "(near == old.near)", 2),
    ];
    for (file, right, wrong, faces) in faults {
        let text_of = Sources::default().get(file).expect("the file").into_owned();
        assert!(text_of.contains(right), "{file} has no {right}");
        let sources = Sources::default().with(file, text_of.replace(right, wrong));
        let kernels = GpuRaster::new(&gpu, &sources, &random_drawing(0)).expect("kernels");
        let fails = |d: &Drawing| on_gpu(&kernels, d, 1024).is_ok_and(|found| found != on_cpu(d).1);
        let drawing = (0..200).map(random_drawing).find(&fails).unwrap_or_else(|| panic!("nobody sees {wrong}"));
        let small = shrink(&drawing, fails);
        let shown = text(&small);
        println!("{wrong}:\n{shown}");
        assert!(fails(&small));
        assert!(small.faces.len() <= faces && small.eyes[0].pixels() < drawing.eyes[0].pixels(), "{shown}");
        assert_eq!(shown.lines().count(), 2 + small.faces.len());
        let short = |p: f32| p * 1024.0 == (p * 1024.0).round();
        let simple = small.vertices.iter().filter(|v| v.position.to_array().into_iter().all(short)).count();
        assert!(simple * 2 > small.vertices.len(), "{shown}");
    }
}
