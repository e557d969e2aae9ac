//! A mesh and its atlas in, an OBJ out. Numbers are rounded first and used rounded by all that
//! follows, so that the maps fit the file and not some finer thing in memory.

use crate::mesh::Mesh;
use crate::unwrap::Atlas;
use glam::{Vec2, Vec3};
use std::collections::HashMap;
use std::fmt::Write;

pub struct Model {
    pub at: Vec<Vec3>,
    pub normals: Vec<Vec3>,
    pub uv: Vec<Vec2>,
    pub faces: Vec<[u32; 3]>,
    pub uv_faces: Vec<[u32; 3]>,
}

fn round(x: f32, places: f32) -> f32 {
    (x * places).round() / places
}

/// Positions rounded as the file will hold them.
pub fn settle(mesh: &mut Mesh) {
    for p in &mut mesh.at {
        *p = Vec3::from_array(p.to_array().map(|x| round(x, 1e4)));
    }
}

impl Model {
    pub fn new(mesh: Mesh, atlas: Atlas) -> Model {
        let normals = normals(&mesh);
        let uv = atlas.uv.iter().map(|p| Vec2::new(round(p.x, 1e5), round(p.y, 1e5))).collect();
        Model { at: mesh.at, normals, uv, faces: mesh.faces, uv_faces: atlas.faces }
    }

    pub fn obj(&self, name: &str) -> String {
        let mut s = format!("# Made by scenes/make; do not edit.\nmtllib {name}.mtl\no {name}\n");
        for p in &self.at {
            let _ = writeln!(s, "v {} {} {}", p.x, p.y, p.z);
        }
        for p in &self.uv {
            let _ = writeln!(s, "vt {} {}", p.x, p.y);
        }
        for n in &self.normals {
            let _ = writeln!(s, "vn {} {} {}", n.x, n.y, n.z);
        }
        let _ = writeln!(s, "usemtl {name}");
        for (f, t) in self.faces.iter().zip(&self.uv_faces) {
            let [a, b, c] = f.map(|k| k + 1);
            let [x, y, z] = t.map(|k| k + 1);
            let _ = writeln!(s, "f {a}/{x}/{a} {b}/{y}/{b} {c}/{z}/{c}");
        }
        s
    }

    /// What a well-made mesh may not have; a line for the report, or what is wrong.
    pub fn check(&self) -> Result<String, String> {
        let mut edges: HashMap<(u32, u32), u32> = HashMap::new();
        for f in &self.faces {
            for k in 0..3 {
                *edges.entry((f[k], f[(k + 1) % 3])).or_default() += 1;
            }
        }
        let open = edges.iter().filter(|(e, n)| **n != 1 || edges.get(&(e.1, e.0)) != Some(&1)).count();
        let mut flat = 0;
        let mut folded = 0;
        let mut mirrored = 0;
        for (f, t) in self.faces.iter().zip(&self.uv_faces) {
            let [a, b, c] = f.map(|k| self.at[k as usize]);
            let cross = (b - a).cross(c - a);
            flat += usize::from(cross.length() < 1e-9);
            folded += usize::from(f.iter().any(|&k| self.normals[k as usize].dot(cross) <= 0.0));
            let [a, b, c] = t.map(|k| self.uv[k as usize]);
            mirrored += usize::from((b - a).perp_dot(c - a) <= 0.0);
        }
        let finite = self.at.iter().chain(&self.normals).all(|p| p.is_finite());
        let bad = open + flat + mirrored;
        let line = format!(
            "{} vertices, {} triangles, {} uvs; {open} edges not shared by exactly two, {flat} flat faces, \
             {folded} faces turned from a vertex normal, {mirrored} mirrored in the atlas, finite: {finite}, euler {}",
            self.at.len(),
            self.faces.len(),
            self.uv.len(),
            self.at.len() as i64 - self.faces.len() as i64 / 2,
        );
        if bad == 0 && finite { Ok(line) } else { Err(line) }
    }
}

/// Vertex normals weighted by the angle of each face (Thuermer and Wuethrich, 1998).
fn normals(mesh: &Mesh) -> Vec<Vec3> {
    let mut out = vec![Vec3::ZERO; mesh.at.len()];
    for f in &mesh.faces {
        let t = f.map(|k| mesh.at[k as usize]);
        let n = (t[1] - t[0]).cross(t[2] - t[0]).normalize();
        for k in 0..3 {
            let angle = (t[(k + 1) % 3] - t[k]).angle_between(t[(k + 2) % 3] - t[k]);
            out[f[k] as usize] += n * angle;
        }
    }
    out.iter().map(|n| Vec3::from_array(n.normalize().to_array().map(|x| round(x, 1e3)))).collect()
}
