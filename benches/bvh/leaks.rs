//! rays at corners and edges of a closed mesh -> how many of them slip through, beside Embree's robust mode

use std::collections::HashMap;

use twinlight::cpu::trace::walk::{Walk, walk};
use twinlight::math::Vec3;
use twinlight::tables::{NONE, Tables};

use crate::meshes::Mesh;
use crate::peer::{self, Peer};
use crate::rays::Asked;

const SETS: [&str; 2] = ["corners", "edges"];
/// `RTC_SCENE_FLAG_ROBUST`.
const ROBUST: u32 = 4;
const RAYS: usize = 400_000;

/// An edge, how many faces have it, and the third corners of the first two of them.
struct Edge {
    ends: [Vec3; 2],
    faces: usize,
    tips: [Vec3; 2],
}

impl Edge {
    /// Whether no ray from the eye to a point of it may go past: one of its two faces lies on each side of the ray.
    ///
    /// Where both lie on the same side, or one is seen from its edge, it is a silhouette. In f64 a sum of products of
    /// differences of f32 has the right sign, but for next to none.
    fn is_closed(&self, eye: Vec3, to: Vec3) -> bool {
        let [p, q] = self.ends.map(Vec3::as_dvec3);
        let across = (to - eye).as_dvec3().cross(q - p);
        let [a, b] = self.tips.map(|tip| across.dot(tip.as_dvec3() - p));
        self.faces == 2 && a * b < 0.0
    }
}

fn key(v: Vec3) -> [u32; 3] {
    v.to_array().map(f32::to_bits)
}

/// Corners and middles of edges that no ray from the eye may go past; how many others there are.
fn targets(mesh: &Mesh) -> [(Vec<Vec3>, usize); 2] {
    let eye = mesh.seat.eye;
    let mut edges = HashMap::new();
    for [a, b, c] in &mesh.triangles {
        for (p, q, tip) in [(a, b, c), (b, c, a), (c, a, b)] {
            let ends = if key(*p) < key(*q) { [*p, *q] } else { [*q, *p] };
            let edge = edges.entry(ends.map(key)).or_insert(Edge { ends, faces: 0, tips: [*tip; 2] });
            edge.tips[edge.faces.min(1)] = *tip;
            edge.faces += 1;
        }
    }
    let mut corners = HashMap::new();
    let mut middles = Vec::new();
    for edge in edges.values() {
        let [p, q] = edge.ends;
        for end in edge.ends {
            corners.entry(key(end)).or_insert((end, true)).1 &= edge.is_closed(eye, end);
        }
        let middle = (p + q) * 0.5;
        middles.push((middle, edge.is_closed(eye, middle)));
    }
    // In an order of their own, not of the maps.
    let sorted = |all: Vec<(Vec3, bool)>| {
        let others = all.iter().filter(|(_, closed)| !closed).count();
        let mut all: Vec<_> = all.into_iter().filter(|(_, closed)| *closed).map(|(v, _)| v).collect();
        all.sort_by_key(|v| key(*v));
        let step = (all.len() / RAYS).max(1);
        (all.into_iter().step_by(step).take(RAYS).collect(), others)
    };
    [sorted(corners.into_values().collect()), sorted(middles)]
}

/// Prints, for each kind, how many rays met nothing up to a thousandth beyond what they were aimed at.
pub(crate) fn leaks(name: &str, mesh: &Mesh, tables: &Tables) {
    let aimed = |to: &Vec3| Asked { origin: mesh.seat.eye, far: 1.001, direction: *to - mesh.seat.eye, any: 0 };
    let targets = targets(mesh);
    let sets = targets.each_ref().map(|(all, _)| all.iter().map(aimed).collect::<Vec<_>>());
    peer::write(name, &mesh.triangles, &SETS, &sets);
    let [mut robust, mut fast] = [ROBUST, 0].map(|flags| Peer::new(name, 1, flags, &SETS));
    for (set, rays) in sets.iter().enumerate() {
        let mut stack = vec![[0; 2]; tables.deep as usize];
        let mut lost = |asked: &&Asked| {
            walk(tables, &mut stack, asked.ray(), Walk::new(asked.far), u32::MAX, false).hit == NONE
        };
        let ours = rays.iter().filter(|asked| lost(asked)).count();
        let theirs = [&mut robust, &mut fast].map(|peer| rays.len() - peer.pass(set).hits);
        println!(
            "{name:>8} {:>8}  of {} rays leak ({} at silhouettes and borders left out): ours {ours}, Embree's robust mode {} ({:.2}), its fast one {}",
            SETS[set],
            rays.len(),
            targets[set].1,
            theirs[0],
            ours as f64 / theirs[0] as f64,
            theirs[1],
        );
    }
}
