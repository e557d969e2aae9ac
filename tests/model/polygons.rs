//! Polygons of many shapes: n - 2 triangles, every side once, the right area, nothing inside out.

use std::collections::HashMap;

use glam::{Mat3, Vec3};
use twinlight::scene::model::polygon::{Cut, Cutter};

/// Checks what holds for every polygon; returns the sum of the triangles' areas along `axis` and the
/// sum of the sizes of these areas.
fn cut(corners: &[Vec3], axis: Vec3, simple: bool) -> (Cut, f64, f64) {
    let mut triangles = Vec::new();
    let how = Cutter::default().cut(corners, &mut triangles);
    assert_eq!(triangles.len(), corners.len() - 2, "{corners:?}");
    // Each side of the polygon belongs to one triangle, each diagonal to two that run against each other.
    let mut sides: HashMap<(u32, u32), i32> = HashMap::new();
    for triangle in &triangles {
        for (a, b) in [(0, 1), (1, 2), (2, 0)] {
            *sides.entry((triangle[a], triangle[b])).or_default() += 1;
        }
    }
    let count = corners.len() as u32;
    for (&(a, b), &times) in &sides {
        assert_eq!(times, 1, "side {a} {b} in {triangles:?}");
        assert!((a + 1) % count == b || sides.contains_key(&(b, a)), "side {a} {b} in {triangles:?}");
    }
    assert!((0..count).all(|at| sides.contains_key(&(at, (at + 1) % count))));
    let area = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|at| corners[at as usize].as_dvec3());
        (b - a).cross(c - a).dot(axis.as_dvec3()) * 0.5
    };
    if how == Cut::Ears && simple {
        assert!(triangles.iter().all(|triangle| area(triangle) != 0.0), "flat: {triangles:?} {corners:?}");
    }
    (how, triangles.iter().map(area).sum(), triangles.iter().map(|triangle| area(triangle).abs()).sum())
}

fn flat(points: &[(f32, f32)]) -> Vec<Vec3> {
    points.iter().map(|&(x, y)| Vec3::new(x, y, 0.0)).collect()
}

/// In every position in space, starting at every corner, both ways around.
fn all_ways(points: &[(f32, f32)], wanted: Option<Cut>) {
    let turns = [
        Mat3::IDENTITY,
        Mat3::from_cols(Vec3::Y, Vec3::Z, Vec3::X),
        Mat3::from_cols(Vec3::Z, Vec3::X, Vec3::Y),
        Mat3::from_cols(-Vec3::X, Vec3::Y, -Vec3::Z),
    ];
    for turn in turns {
        for start in 0..points.len() {
            for backward in [false, true] {
                let mut points = flat(points);
                points.rotate_left(start);
                if backward {
                    points.reverse();
                }
                let points: Vec<_> = points.into_iter().map(|point| turn * point).collect();
                let (how, area, size) = cut(&points, turn * Vec3::Z, true);
                assert!(
                    (area.abs() - size).abs() <= 1e-9 * size,
                    "triangles overlap or stick out: {area} {size} {points:?}"
                );
                assert_eq!(area < 0.0, backward, "inside out");
                if let Some(wanted) = wanted {
                    assert_eq!(how, wanted);
                }
            }
        }
    }
}

#[test]
fn simple_polygons() {
    let ears = Some(Cut::Ears);
    all_ways(&[(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)], Some(Cut::Fan));
    all_ways(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)], Some(Cut::Fan));
    // Dart, L, U, comb, spiral, arrow; L with corners on its sides.
    all_ways(&[(0.0, 0.0), (4.0, 0.0), (1.0, 1.0), (0.0, 4.0)], ears);
    all_ways(&[(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0)], ears);
    all_ways(
        &[(0.0, 0.0), (3.0, 0.0), (3.0, 3.0), (2.0, 3.0), (2.0, 1.0), (1.0, 1.0), (1.0, 3.0), (0.0, 3.0)],
        ears,
    );
    all_ways(
        &[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0), (0.0, 1.0)],
        ears,
    );
    let mut comb: Vec<_> = (0..41)
        .map(|at| (at as f32, if at % 2 == 0 { 0.0 } else { 9.0 + (at % 5) as f32 }))
        .chain([(40.0, -3.0), (0.0, -3.0)])
        .collect();
    comb.reverse();
    all_ways(&comb, ears);
    all_ways(
        &[
            (0.0, 0.0),
            (6.0, 0.0),
            (6.0, 6.0),
            (1.0, 6.0),
            (1.0, 2.0),
            (4.0, 2.0),
            (4.0, 4.0),
            (3.0, 4.0),
            (3.0, 3.0),
            (2.0, 3.0),
            (2.0, 5.0),
            (5.0, 5.0),
            (5.0, 1.0),
            (0.0, 1.0),
        ],
        ears,
    );
    // A square with a square hole, joined by a bridge.
    all_ways(
        &[
            (0.0, 0.0),
            (9.0, 0.0),
            (9.0, 9.0),
            (0.0, 9.0),
            (0.0, 0.0),
            (3.0, 3.0),
            (3.0, 6.0),
            (6.0, 6.0),
            (6.0, 3.0),
            (3.0, 3.0),
        ],
        ears,
    );
}

/// Stars with random rays around the origin are simple, and mostly very concave.
#[test]
fn random_stars() {
    let mut random = crate::fuzz::Random(0x9E37_79B9_7F4A_7C15);
    for round in 0..3000 {
        let count = 4 + round % 60;
        let points: Vec<_> = (0..count)
            .map(|at| {
                let angle = at as f32 / count as f32 * std::f32::consts::TAU;
                let ray = 1.0 + (random.below(1000) as f32) / 100.0;
                Vec3::new(angle.cos() * ray, angle.sin() * ray, 0.0)
            })
            .collect();
        let (how, area, size) = cut(&points, Vec3::Z, true);
        assert!((area - size).abs() <= 1e-6 * size, "{how:?} {area} {size} {points:?}");
        assert_ne!(how, Cut::Crossing);
    }
}

/// Polygons that cross themselves, or are points and lines: the count and the sides still hold.
#[test]
fn broken_polygons() {
    assert_eq!(cut(&flat(&[(0.0, 0.0), (2.0, 2.0), (2.0, 0.0), (0.0, 3.0)]), Vec3::Z, false).0, Cut::Crossing);
    cut(&flat(&[(0.0, 0.0); 7]), Vec3::Z, false);
    cut(&flat(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (1.0, 0.0)]), Vec3::Z, false);
    let mut random = crate::fuzz::Random(7);
    for round in 0..3000 {
        let points: Vec<_> = (0..4 + round % 12)
            .map(|_| Vec3::new(random.below(5) as f32, random.below(5) as f32, random.below(3) as f32))
            .collect();
        cut(&points, Vec3::Z, false);
    }
}
