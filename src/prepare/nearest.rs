//! a point and faces -> how far the nearest of them is

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use crate::tables::Drawing;

/// The distance to the nearest point of any face; nothing if that is more than `most`.
pub(super) fn nearest(drawing: &Drawing, from: Vec3, most: f32) -> Option<f32> {
    let distance = |corners: [Vec3; 3]| {
        let [a, b, c] = corners;
        let beside = (a.min(b).min(c) - from).max(from - a.max(b).max(c)).max_element();
        // Most faces are far away, and their boxes say so.
        if beside > most { f64::INFINITY } else { to_triangle(corners.map(|corner| (corner - from).as_dvec3())) }
    };
    let faces = drawing.faces.par_iter().map(|face| [face.a, face.b, face.c]);
    let all = faces.map(|face| distance(face.map(|i| drawing.vertices[i as usize].position)));
    let least = all.reduce(|| f64::INFINITY, f64::min);
    (least <= f64::from(most)).then_some(least as f32)
}

/// From the origin.
fn to_triangle([a, b, c]: [DVec3; 3]) -> f64 {
    let normal = (b - a).cross(c - a);
    let edges = [(a, b), (b, c), (c, a)];
    if normal != DVec3::ZERO && edges.iter().all(|(p, q)| p.cross(*q).dot(normal) >= 0.0) {
        return normal.normalize().dot(a).abs();
    }
    edges.map(|(p, q)| to_segment(p, q)).into_iter().fold(f64::INFINITY, f64::min)
}

fn to_segment(p: DVec3, q: DVec3) -> f64 {
    let way = q - p;
    let length = way.length_squared();
    let share = if length > 0.0 { (-p.dot(way) / length).clamp(0.0, 1.0) } else { 0.0 };
    (p + way * share).length()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_triangle_is_as_near_as_its_inside_its_edges_and_its_corners() {
        let corners = [DVec3::ZERO, DVec3::X * 4.0, DVec3::Y * 4.0];
        let cases = [
            ([1.0, 1.0, 2.0], 2.0),
            ([1.0, -3.0, 4.0], 5.0),
            ([-2.0, -2.0, 1.0], 3.0),
            ([4.0, 4.0, 0.0], 8_f64.sqrt()),
        ];
        for (from, wanted) in cases {
            for turn in [[0, 1, 2], [1, 2, 0], [0, 2, 1]] {
                let found = to_triangle(turn.map(|i| corners[i] - DVec3::from_array(from)));
                assert!((found - wanted).abs() < 1e-12, "{from:?}: {found}");
            }
        }
        assert_eq!(to_triangle([DVec3::X * 2.0; 3]), 2.0, "a face without an area");
    }
}
