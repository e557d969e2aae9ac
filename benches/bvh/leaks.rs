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

/// Corners whose every edge has two faces, and the middles of such edges: what no ray from outside goes past, but for
/// silhouettes, where all walks may miss.
fn targets(mesh: &Mesh) -> [Vec<Vec3>; 2] {
    let key = |v: Vec3| v.to_array().map(f32::to_bits);
    let mut edges = HashMap::new();
    for [a, b, c] in &mesh.triangles {
        for (p, q) in [(a, b), (b, c), (c, a)] {
            let ends = if key(*p) < key(*q) { (*p, *q) } else { (*q, *p) };
            edges.entry((key(ends.0), key(ends.1))).or_insert((ends, 0)).1 += 1;
        }
    }
    let mut corners = HashMap::new();
    for ((p, q), faces) in edges.values() {
        for end in [p, q] {
            let inner = corners.entry(key(*end)).or_insert((*end, true));
            inner.1 &= *faces == 2;
        }
    }
    // In an order of their own, not of the maps.
    let sorted = |mut all: Vec<Vec3>| {
        all.sort_by_key(|v| key(*v));
        let step = (all.len() / RAYS).max(1);
        all.into_iter().step_by(step).take(RAYS).collect()
    };
    let middles = edges.into_values().filter(|(_, faces)| *faces == 2).map(|((p, q), _)| (p + q) * 0.5);
    [sorted(corners.into_values().filter(|(_, inner)| *inner).map(|(v, _)| v).collect()), sorted(middles.collect())]
}

/// Prints, for each kind, how many rays met nothing up to a thousandth beyond what they were aimed at.
pub(crate) fn leaks(name: &str, mesh: &Mesh, tables: &Tables) {
    let aimed = |to: &Vec3| Asked { origin: mesh.seat.eye, far: 1.001, direction: *to - mesh.seat.eye, any: 0 };
    let sets = targets(mesh).map(|all| all.iter().map(aimed).collect::<Vec<_>>());
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
            "{name:>8} {:>8}  of {} rays leak: ours {ours}, Embree's robust mode {} ({:.2}), its fast one {}",
            SETS[set],
            rays.len(),
            theirs[0],
            ours as f64 / theirs[0] as f64,
            theirs[1],
        );
    }
}
