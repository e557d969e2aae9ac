//! A mesh in, texture coordinates out: charts grown over faces of like direction, each flattened
//! along its mean normal, and packed side by side with gutters.

use crate::mesh::Mesh;
use crate::pack::pack;
use glam::{Vec2, Vec3, vec2};
use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap, HashSet};

/// Texture coordinates and, for each face, which three it uses.
pub struct Atlas {
    pub uv: Vec<Vec2>,
    pub faces: Vec<[u32; 3]>,
    pub charts: usize,
}

/// Faces flattened along `axis`; `right` and `above` span the plane.
struct Chart {
    faces: Vec<usize>,
    /// Which face lies on which grid cell.
    mask: HashMap<(i32, i32), usize>,
    axis: Vec3,
    right: Vec3,
    above: Vec3,
    /// Texture pixels per unit of length, relative to the other charts.
    zoom: f32,
}

impl Chart {
    fn new(axis: Vec3, zoom: f32) -> Chart {
        let up = if axis.y.abs() > 0.85 { Vec3::Z } else { Vec3::Y };
        let right = up.cross(axis).normalize();
        Chart { faces: Vec::new(), mask: HashMap::new(), axis, right, above: axis.cross(right), zoom }
    }

    fn flat(&self, p: Vec3) -> Vec2 {
        vec2(p.dot(self.right), p.dot(self.above)) * self.zoom
    }
}

/// How steeply a face may stand to its chart's plane (cosine): bounds the stretch.
const STEEP: f32 = 0.40;
/// The same for strays that would otherwise be charts of their own.
const STRAY: f32 = 0.15;
/// A chart of fewer faces than this is broken up if its neighbours can take them.
const FEW: usize = 24;
/// Grid on which a chart is checked against covering itself.
const PIXEL: f32 = 0.0016;

/// Unwraps for a square texture of `size` pixels; `zoom` says how much detail a place deserves,
/// `first` are the faces from which the first charts should grow, with their axes.
pub fn unwrap(
    mesh: &Mesh,
    size: usize,
    gutter: usize,
    zoom: &dyn Fn(Vec3) -> f32,
    first: &[(Vec3, Vec3)],
) -> Atlas {
    let charts = segment(mesh, zoom, first);
    let flats: Vec<Vec<[Vec2; 3]>> = charts
        .iter()
        .map(|c| c.faces.iter().map(|&f| mesh.faces[f].map(|k| c.flat(mesh.at[k as usize]))).collect())
        .collect();
    // The largest scale at which everything still fits, by bisection.
    let (mut low, mut high) = (100.0f32, 4000.0f32);
    let mut places = pack(&flats, low, size, gutter).unwrap_or_default();
    for _ in 0..12 {
        let scale = (low + high) * 0.5;
        match pack(&flats, scale, size, gutter) {
            Some(p) => (places, low) = (p, scale),
            None => high = scale,
        }
    }
    let mut atlas = Atlas { uv: Vec::new(), faces: vec![[0; 3]; mesh.faces.len()], charts: charts.len() };
    for (c, (chart, place)) in charts.iter().zip(&places).enumerate() {
        let mut known = HashMap::new();
        for (i, &f) in chart.faces.iter().enumerate() {
            for (k, v) in mesh.faces[f].into_iter().enumerate() {
                atlas.faces[f][k] = *known.entry(v).or_insert_with(|| {
                    atlas.uv.push(place.apply(flats[c][i][k] * low) / size as f32);
                    atlas.uv.len() as u32 - 1
                });
            }
        }
    }
    atlas
}

/// Splits the mesh into charts.
fn segment(mesh: &Mesh, zoom: &dyn Fn(Vec3) -> f32, first: &[(Vec3, Vec3)]) -> Vec<Chart> {
    let corners = |f: usize| mesh.faces[f].map(|k| mesh.at[k as usize]);
    let cross: Vec<Vec3> = (0..mesh.faces.len())
        .map(|f| {
            let [a, b, c] = corners(f);
            (b - a).cross(c - a)
        })
        .collect();
    let middle = |f: usize| corners(f).iter().sum::<Vec3>() / 3.0;
    let mut edges: HashMap<(u32, u32), usize> = HashMap::new();
    for (i, f) in mesh.faces.iter().enumerate() {
        for k in 0..3 {
            edges.insert((f[k], f[(k + 1) % 3]), i);
        }
    }
    let beside = |f: usize| {
        let t = mesh.faces[f];
        [0, 1, 2].map(|k| edges[&(t[(k + 1) % 3], t[k])])
    };
    let mut taken = vec![false; mesh.faces.len()];
    let mut charts = Vec::new();
    // Big faces first: they sit in the middle of smooth regions.
    let mut order: Vec<usize> = (0..mesh.faces.len()).collect();
    order.sort_by(|&a, &b| cross[b].length_squared().total_cmp(&cross[a].length_squared()).then(a.cmp(&b)));
    let nearest = |p: Vec3| {
        (0..mesh.faces.len())
            .min_by(|&a, &b| middle(a).distance_squared(p).total_cmp(&middle(b).distance_squared(p)))
            .unwrap_or(0)
    };
    let grow = |seed: usize, axis: Vec3, taken: &[bool]| {
        let mut chart = Chart::new(axis, zoom(middle(seed)));
        let mut seen = HashSet::from([seed]);
        let mut queue = BinaryHeap::from([Reverse((0u32, seed))]);
        while let Some(Reverse((_, f))) = queue.pop() {
            let flat = corners(f).map(|p| chart.flat(p));
            if !claim(&mut chart.mask, f, flat, |g| mesh.faces[g].iter().any(|k| mesh.faces[f].contains(k))) {
                continue;
            }
            chart.faces.push(f);
            for g in beside(f) {
                let lean = cross[g].normalize().dot(axis);
                if !taken[g] && lean > STEEP && seen.insert(g) {
                    // Near and flat faces first, so that charts come out round.
                    let cost = middle(g).distance(middle(seed)) + 0.1 * (1.0 - lean);
                    queue.push(Reverse((cost.to_bits(), g)));
                }
            }
        }
        chart
    };
    let seeds = first.iter().map(|&(p, axis)| (nearest(p), Some(axis)));
    for (seed, axis) in seeds.chain(order.into_iter().map(|f| (f, None))) {
        if taken[seed] {
            continue;
        }
        let axis = axis.unwrap_or_else(|| {
            let draft = grow(seed, cross[seed].normalize(), &taken);
            let mean = draft.faces.iter().map(|&f| cross[f]).sum::<Vec3>().normalize();
            // The mean may lean away from the seed itself; then the seed's own normal serves.
            if mean.dot(cross[seed].normalize()) > STEEP { mean } else { cross[seed].normalize() }
        });
        let chart = grow(seed, axis, &taken);
        for &f in &chart.faces {
            taken[f] = true;
        }
        charts.push(chart);
    }
    // Give the faces of small charts to larger neighbours where those have room.
    let mut home = vec![0; mesh.faces.len()];
    for (i, c) in charts.iter().enumerate() {
        c.faces.iter().for_each(|&f| home[f] = i);
    }
    for _ in 0..4 {
        for i in 0..charts.len() {
            if charts[i].faces.len() >= FEW {
                continue;
            }
            for f in std::mem::take(&mut charts[i].faces) {
                let next = beside(f).map(|g| home[g]).into_iter().find(|&h| {
                    let there = &mut charts[h];
                    let flat = corners(f).map(|p| there.flat(p));
                    h != i
                        && there.faces.len() > 1
                        && cross[f].normalize().dot(there.axis) > STRAY
                        && claim(&mut there.mask, f, flat, |g| {
                            mesh.faces[g].iter().any(|k| mesh.faces[f].contains(k))
                        })
                });
                home[f] = next.unwrap_or(i);
                charts[home[f]].faces.push(f);
            }
        }
    }
    charts.retain(|c| !c.faces.is_empty());
    charts
}

/// Marks the pixels of a flattened face; refuses if one belongs to a face that is no neighbour.
fn claim(mask: &mut HashMap<(i32, i32), usize>, f: usize, t: [Vec2; 3], kin: impl Fn(usize) -> bool) -> bool {
    let mut fresh = Vec::new();
    let t = t.map(|p| p / PIXEL);
    for (x, y) in pixels(t) {
        match mask.get(&(x, y)) {
            Some(&g) if !kin(g) => return false,
            Some(_) => {}
            None => fresh.push((x, y)),
        }
    }
    mask.extend(fresh.into_iter().map(|xy| (xy, f)));
    true
}

/// The pixels whose centres a triangle covers.
pub fn pixels(t: [Vec2; 3]) -> impl Iterator<Item = (i32, i32)> {
    let low = t[0].min(t[1]).min(t[2]).floor().as_ivec2();
    let high = t[0].max(t[1]).max(t[2]).ceil().as_ivec2();
    let side = |a: Vec2, b: Vec2, p: Vec2| (b - a).perp_dot(p - a);
    let area = side(t[0], t[1], t[2]);
    (low.y..high.y).flat_map(move |y| (low.x..high.x).map(move |x| (x, y))).filter(move |&(x, y)| {
        let p = vec2(x as f32 + 0.5, y as f32 + 0.5);
        (0..3).all(|i| side(t[i], t[(i + 1) % 3], p) * area.signum() >= 0.0)
    })
}
