//! A fine closed mesh in, a coarse closed mesh out: edge collapses in order of quadric error
//! (Garland and Heckbert, Surface Simplification Using Quadric Error Metrics, 1997).

use crate::mesh::Mesh;
use glam::{DMat3, DVec3, Vec3};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Squared distance to a set of planes, as a quadratic form.
#[derive(Clone, Copy, Default)]
struct Quadric {
    a: DMat3Sum,
    b: DVec3,
    c: f64,
}

/// A sum of outer products; only its own type because glam's zero matrix is not its default.
#[derive(Clone, Copy)]
struct DMat3Sum(DMat3);

impl Default for DMat3Sum {
    fn default() -> Self {
        DMat3Sum(DMat3::ZERO)
    }
}

impl Quadric {
    fn plane(n: DVec3, p: DVec3, weight: f64) -> Quadric {
        let d = -n.dot(p);
        let outer = DMat3::from_cols(n * n.x, n * n.y, n * n.z);
        Quadric { a: DMat3Sum(outer * weight), b: n * d * weight, c: d * d * weight }
    }

    /// A weak spring to a point: it keeps flat regions evenly divided.
    fn point(p: DVec3, weight: f64) -> Quadric {
        Quadric { a: DMat3Sum(DMat3::IDENTITY * weight), b: -p * weight, c: p.length_squared() * weight }
    }

    fn plus(self, o: Quadric) -> Quadric {
        Quadric { a: DMat3Sum(self.a.0 + o.a.0), b: self.b + o.b, c: self.c + o.c }
    }

    fn error(&self, p: DVec3) -> f64 {
        (p.dot(self.a.0 * p) + 2.0 * self.b.dot(p) + self.c).max(0.0)
    }

    /// The best place for the vertex that replaces `u` and `v`.
    fn best(&self, u: DVec3, v: DVec3) -> DVec3 {
        let middle = (u + v) * 0.5;
        if self.a.0.determinant().abs() > 1e-12 * self.a.0.x_axis.length().powi(3) {
            let p = -(self.a.0.inverse() * self.b);
            if p.is_finite() && p.distance(middle) < u.distance(v) * 1.5 {
                return p;
            }
        }
        [u, v, middle].into_iter().min_by(|x, y| self.error(*x).total_cmp(&self.error(*y))).unwrap_or(middle)
    }
}

/// Collapses edges until `target` faces are left; `weight` says how dear a place is.
pub fn simplify(mesh: &Mesh, target: usize, weight: &dyn Fn(Vec3) -> f32) -> Mesh {
    let mut work = Work::new(mesh, weight);
    // An edge that was refused may do later, when its neighbours have gone: hence the rounds.
    for _ in 0..4 {
        work.refill();
        while work.alive > target {
            let Some(Reverse((_, u, v, age_u, age_v))) = work.heap.pop() else {
                break;
            };
            let (u, v) = (u as usize, v as usize);
            if work.age[u] == age_u && work.age[v] == age_v {
                work.collapse(u, v);
            }
        }
    }
    work.finish()
}

type Candidate = (u64, u32, u32, u32, u32);

struct Work {
    at: Vec<DVec3>,
    quadric: Vec<Quadric>,
    /// Faces round each vertex; empty once the vertex is gone.
    round: Vec<Vec<u32>>,
    faces: Vec<[u32; 3]>,
    /// Bumped when a vertex moves, so that stale heap entries are known.
    age: Vec<u32>,
    /// Cost as bits (order of non-negative floats), then the edge, then its ends' ages.
    heap: BinaryHeap<Reverse<Candidate>>,
    alive: usize,
}

impl Work {
    fn new(mesh: &Mesh, weight: &dyn Fn(Vec3) -> f32) -> Work {
        let at: Vec<DVec3> = mesh.at.iter().map(|p| p.as_dvec3()).collect();
        let mut quadric = vec![Quadric::default(); at.len()];
        let mut round = vec![Vec::new(); at.len()];
        for (i, f) in mesh.faces.iter().enumerate() {
            let [a, b, c] = f.map(|k| at[k as usize]);
            let cross = (b - a).cross(c - a);
            let area = cross.length();
            let w = area * f64::from(weight(((a + b + c) / 3.0).as_vec3()));
            for &k in f {
                let p = at[k as usize];
                let q = Quadric::plane(cross.normalize_or_zero(), a, w).plus(Quadric::point(p, w * 2e-4));
                quadric[k as usize] = quadric[k as usize].plus(q);
                round[k as usize].push(i as u32);
            }
        }
        let age = vec![0; at.len()];
        Work {
            at,
            quadric,
            round,
            faces: mesh.faces.clone(),
            age,
            heap: BinaryHeap::new(),
            alive: mesh.faces.len(),
        }
    }

    fn refill(&mut self) {
        self.heap.clear();
        for f in 0..self.faces.len() {
            let [a, b, c] = self.faces[f].map(|k| k as usize);
            for (u, v) in [(a, b), (b, c), (c, a)] {
                if u < v {
                    self.push(u, v);
                }
            }
        }
    }

    fn push(&mut self, u: usize, v: usize) {
        let q = self.quadric[u].plus(self.quadric[v]);
        let cost = q.error(q.best(self.at[u], self.at[v]));
        self.heap.push(Reverse((cost.to_bits(), u as u32, v as u32, self.age[u], self.age[v])));
    }

    fn neighbours(&self, u: usize) -> Vec<u32> {
        let mut out: Vec<u32> = self.round[u].iter().flat_map(|&f| self.faces[f as usize]).collect();
        out.sort_unstable();
        out.dedup();
        out.retain(|&k| k as usize != u);
        out
    }

    /// Merges `v` into `u`, unless that would pinch the surface or turn a face over.
    fn collapse(&mut self, u: usize, v: usize) {
        let (around_u, around_v) = (self.neighbours(u), self.neighbours(v));
        // The link condition: a closed surface stays one if exactly two neighbours are shared.
        if around_u.iter().filter(|k| around_v.binary_search(k).is_ok()).count() != 2 {
            return;
        }
        let q = self.quadric[u].plus(self.quadric[v]);
        let p = q.best(self.at[u], self.at[v]);
        if !self.stays_fair(u, v, p) || !self.stays_fair(v, u, p) {
            return;
        }
        let from_v = std::mem::take(&mut self.round[v]);
        for f in from_v {
            let face = self.faces[f as usize];
            if face.contains(&(u as u32)) {
                for k in face {
                    self.round[k as usize].retain(|&g| g != f);
                }
                self.faces[f as usize] = [0; 3];
                self.alive -= 1;
            } else {
                self.faces[f as usize] = face.map(|k| if k as usize == v { u as u32 } else { k });
                self.round[u].push(f);
            }
        }
        self.at[u] = p;
        self.quadric[u] = q;
        self.age[u] += 1;
        self.age[v] += 1;
        for k in self.neighbours(u) {
            let k = k as usize;
            self.push(u.min(k), u.max(k));
        }
    }

    /// Whether the faces at `u` that do not touch `v` keep their side and a decent shape.
    fn stays_fair(&self, u: usize, v: usize, p: DVec3) -> bool {
        let cross = |t: [DVec3; 3]| (t[1] - t[0]).cross(t[2] - t[0]);
        let ring = self.round[u].iter().chain(&self.round[v]);
        let mean: DVec3 = ring.map(|&f| cross(self.faces[f as usize].map(|k| self.at[k as usize]))).sum();
        self.round[u].iter().map(|&f| self.faces[f as usize]).filter(|f| !f.contains(&(v as u32))).all(|f| {
            let old = f.map(|k| self.at[k as usize]);
            let new = f.map(|k| if k as usize == u { p } else { self.at[k as usize] });
            let (a, b) = (cross(old), cross(new));
            // Area over the longest edge squared: a sliver may stay one, but none may be made.
            let plump = |t: [DVec3; 3], area: f64| {
                area / (0..3).map(|i| t[i].distance_squared(t[(i + 1) % 3])).fold(0.0, f64::max)
            };
            let was = plump(old, a.length());
            // A sliver's own normal means little; then the mean of the ring decides.
            let side = if was > 0.1 { a } else { mean };
            side.dot(b) > 0.3 * side.length() * b.length() && plump(new, b.length()) > (was * 0.7).min(0.1)
        })
    }

    fn finish(self) -> Mesh {
        let mut rename = vec![u32::MAX; self.at.len()];
        let mut out = Mesh { at: Vec::new(), faces: Vec::new() };
        for f in self.faces.iter().filter(|f| f[0] != f[1]) {
            out.faces.push(f.map(|k| {
                if rename[k as usize] == u32::MAX {
                    rename[k as usize] = out.at.len() as u32;
                    out.at.push(self.at[k as usize].as_vec3());
                }
                rename[k as usize]
            }));
        }
        out
    }
}
