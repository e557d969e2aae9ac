//! objects of every kind -> vertices, faces, paints and texels

use std::cmp::Ordering;
use std::collections::HashMap;
use std::ops::Range;
use std::sync::Arc;

use glam::{Vec2, Vec3};
use rayon::prelude::*;

use super::ball::balls;
use super::levels::{count, levels};
use crate::film::Transfer;
use crate::math::vector::unit;
use crate::scene::model::{self, Model};
use crate::scene::{Material, Mesh, Scene};
use crate::tables::{CLAMPED, CUT_OUT, Face, Map, NONE, ONE_SIDED, Paint, Vertex};

/// A drawing's triangles while they are gathered.
#[derive(Debug, Default)]
pub(super) struct Sheet {
    pub(super) vertices: Vec<Vertex>,
    pub(super) faces: Vec<Face>,
    pub(super) paints: Vec<Paint>,
    pub(super) texels: Vec<u32>,
    /// The scene's own pictures.
    pub(super) textures: Vec<Map>,
    /// What models are made of, after the scene's own materials.
    pub(super) materials: Vec<model::Material>,
    /// The first paint of each model that is dressed, by where it lies in memory.
    pub(super) known: HashMap<usize, u32>,
}

/// What a mesh's faces are painted with.
#[derive(Debug, Clone, Copy)]
enum Cover {
    /// Its model's materials, whose first paint is this.
    Own(u32),
    /// One of the scene's.
    With(usize),
}

const BARE: Map = Map { first: NONE, width: 0, height: 0, levels: 0, scale: Vec2::ONE, shift: Vec2::ZERO };

/// Faces that an infinite plane is drawn with.
pub const PLANE_FACES: u32 = 2 + 8 * RINGS;
/// Rings around the square of a plane that is as large as the scene.
const RINGS: u32 = 12;

impl Sheet {
    /// The scene's materials and the decoding curve, and nothing painted with them yet.
    pub(super) fn new(scene: &Scene) -> Self {
        let transfer = scene.film.transfer;
        let texels = (0..=255).map(|byte| transfer.decode(byte).to_bits()).collect();
        let mut sheet = Self { texels, ..Self::default() };
        sheet.textures = scene.textures.iter().map(|t| sheet.texture(t, transfer)).collect();
        sheet.paints = scene.materials.iter().map(|m| cover(m, &sheet.textures)).collect();
        sheet
    }

    /// Other numbers for the scene's materials, of which there are as many as before.
    pub(super) fn repaint(&mut self, scene: &Scene) {
        for (paint, material) in self.paints.iter_mut().zip(&scene.materials) {
            *paint = cover(material, &self.textures);
        }
    }

    /// All meshes where they stand.
    pub(super) fn meshes(&mut self, scene: &Scene) {
        for mesh in &scene.meshes {
            self.stand(mesh, scene, mesh.one_sided);
        }
    }

    /// A mesh where it stands.
    pub(super) fn stand(&mut self, mesh: &Mesh, scene: &Scene, one_sided: bool) {
        let paint = mesh.material.map_or_else(|| Cover::Own(self.dressed(mesh, scene)), Cover::With);
        self.mesh(mesh, one_sided, paint, |p| mesh.place(p), |n| mesh.turn(n));
    }

    /// A mesh as its model has it, for all that share it: what covers it is told by each of them.
    pub(super) fn model(&mut self, mesh: &Mesh, scene: &Scene) -> Range<usize> {
        let first = self.faces.len();
        let paint = mesh.material.map_or_else(|| Cover::Own(self.dressed(mesh, scene)), |_| Cover::With(0));
        self.mesh(mesh, scene.has_no_backs(mesh), paint, |p| p, |n| n);
        first..self.faces.len()
    }

    /// Turns each face from the `first` on, so that it begins with the corner that is first by x, y and z: faces with
    /// the same corners are met by a ray at one distance to the bit, whichever way round they go.
    pub(super) fn turn(&mut self, first: usize) {
        let Self { vertices, faces, .. } = self;
        let order = |p: Vec3, q: Vec3| p.to_array().partial_cmp(&q.to_array()).unwrap_or(Ordering::Equal);
        faces[first..].par_iter_mut().for_each(|face| {
            let mut corners = [face.a, face.b, face.c];
            let at = |i: usize| vertices[corners[i] as usize].position;
            let lead = (1..3).fold(0, |lead, i| if order(at(i), at(lead)).is_lt() { i } else { lead });
            corners.rotate_left(lead);
            [face.a, face.b, face.c] = corners;
        });
    }

    /// The first of the paints of a model, whose pictures are there once.
    fn dressed(&mut self, mesh: &Mesh, scene: &Scene) -> u32 {
        let model = &mesh.model;
        if let Some(&first) = self.known.get(&Arc::as_ptr(model).addr()) {
            return first;
        }
        let textures: Vec<Map> = model.textures.iter().map(|t| self.texture(t, scene.film.transfer)).collect();
        let first = self.paints.len() as u32;
        self.paints.extend(model.materials.iter().map(|m| dress(m, &textures)));
        self.materials.extend(model.materials.iter().cloned());
        self.known.insert(Arc::as_ptr(model).addr(), first);
        first
    }

    fn mesh(
        &mut self,
        mesh: &Mesh,
        one_sided: bool,
        cover: Cover,
        place: impl Fn(Vec3) -> Vec3,
        turn: impl Fn(Vec3) -> Vec3,
    ) {
        let Model { positions, normals, triangles, .. } = &*mesh.model;
        let side = if one_sided { ONE_SIDED } else { 0 };
        let mut known = HashMap::new();
        for triangle in triangles {
            let [a, b, c] = triangle.corners.map(|corner| {
                *known.entry((corner.position, corner.uv, corner.normal)).or_insert_with(|| {
                    let uv = mesh.model.uv(corner);
                    let position = place(positions[corner.position as usize]);
                    let normal = unit(turn(normals[corner.normal as usize]));
                    self.vertices.push(Vertex { position, u: uv.x, normal, v: uv.y });
                    self.vertices.len() as u32 - 1
                })
            });
            let paint = match cover {
                Cover::Own(first) => first + triangle.material,
                Cover::With(material) => material as u32,
            };
            let cut = self.paints.get(paint as usize).is_some_and(|paint| paint.opacity_map.first != NONE);
            self.faces.push(Face { a, b, c, paint: paint | side | if cut { CUT_OUT } else { 0 } });
        }
    }

    /// Every level of a picture.
    fn texture(&mut self, texture: &model::Texture, transfer: Transfer) -> Map {
        let first = self.texels.len() as u32;
        self.texels.extend_from_slice(&levels(texture, transfer));
        Map { first, width: texture.width, height: texture.height, levels: count(texture), ..BARE }
    }

    /// Columns go from u = 0 to 1 and rows from v = 1 to 0.
    pub(super) fn spheres(&mut self, scene: &Scene) {
        for (sphere, ball) in scene.spheres.iter().zip(balls(scene)) {
            let first = self.vertices.len() as u32;
            for &row in &ball.rows {
                for &u in &ball.columns {
                    // The last column is the first one to the bit, so that the seam is closed.
                    let turn = if u == 1.0 { 0.0 } else { u * std::f32::consts::TAU };
                    let fall = row * std::f32::consts::PI;
                    let ring = if row == 0.0 || row == 1.0 { 0.0 } else { fall.sin() };
                    let normal = Vec3::new(ring * turn.cos(), fall.cos(), -ring * turn.sin());
                    let position = sphere.center + normal * sphere.radius;
                    self.vertices.push(Vertex { position, u, normal, v: 1.0 - row });
                }
            }
            let paint = sphere.material as u32;
            let columns = ball.columns.len() as u32;
            for (i, j) in (1..ball.rows.len() as u32).flat_map(|j| (1..columns).map(move |i| (i - 1, j - 1))) {
                let a = first + j * columns + i;
                let below = a + columns;
                self.faces.push(Face { a, b: below, c: below + 1, paint });
                self.faces.push(Face { a, b: below + 1, c: a + 1, paint });
            }
        }
    }

    pub(super) fn triangles(&mut self, scene: &Scene) {
        let first = self.vertices.len() as u32;
        let corners = scene.triangles.par_iter().map(|triangle| {
            let [p, q, r] = triangle.vertices;
            let normal = unit((q - p).cross(r - p));
            let corner = |i: usize| (triangle.vertices[i], triangle.uvs[i]);
            [0, 1, 2].map(|i| vertex(&corner(i), normal))
        });
        let corners: Vec<[Vertex; 3]> = corners.collect();
        self.vertices.append(&mut corners.into_flattened());
        self.faces.par_extend(scene.triangles.par_iter().enumerate().map(|(i, triangle)| {
            let a = first + 3 * i as u32;
            Face { a, b: a + 1, c: a + 2, paint: triangle.material as u32 }
        }));
    }

    /// Infinite planes reach as far as the far plane: a square around the point of them that is nearest to the scene's
    /// middle, as large as the scene, and rings around it, each twice as wide. So what is near has corners that are
    /// near, and f32 is as fine there as where things are; only the last ring follows the eye.
    pub(super) fn planes(&mut self, scene: &Scene, middle: Option<(Vec3, f32)>) {
        let eye = scene.camera.position;
        let (middle, size) = middle.unwrap_or((eye, scene.camera.far * 1e-3));
        for plane in &scene.planes {
            let foot = |from: Vec3| from - plane.normal * plane.normal.dot(from - plane.point);
            let center = foot(middle);
            let reach = scene.camera.far * 2.0 + center.distance(foot(eye));
            let axes = plane.axes();
            let maps = &scene.materials[plane.material].maps;
            let scales = || [maps.color, maps.normal, maps.specular].into_iter().flatten().map(|map| map.scale);
            let start = [0, 1].map(|i| {
                let copies = (center - plane.point).dot(axes[i]) / plane.tile;
                // Whole copies are left out where they are alike, so that the coordinates are fine in the middle.
                if scales().all(|scale| scale[i].fract() == 0.0) { copies.fract() } else { copies }
            });
            let first = self.vertices.len() as u32;
            for ring in 0..=RINGS {
                let half = size * (1 << ring) as f32;
                let half = if ring == RINGS { half.max(reach) } else { half };
                self.vertices.extend([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|way: [f32; 2]| {
                    let position = center + axes[0] * (way[0] * half) + axes[1] * (way[1] * half);
                    let [u, v] = [0, 1].map(|i| start[i] + way[i] * half / plane.tile);
                    Vertex { position, u, normal: plane.normal, v }
                }));
            }
            let paint = plane.material as u32;
            let mut face = |[a, b, c]: [u32; 3]| {
                self.faces.push(Face { a: first + a, b: first + b, c: first + c, paint });
            };
            face([0, 1, 2]);
            face([0, 2, 3]);
            for inner in (0..4 * RINGS).step_by(4) {
                let outer = inner + 4;
                for (i, j) in [(0, 1), (1, 2), (2, 3), (3, 0)] {
                    face([outer + i, outer + j, inner + j]);
                    face([outer + i, inner + j, inner + i]);
                }
            }
        }
    }
}

fn vertex(&(position, uv): &(Vec3, Vec2), normal: Vec3) -> Vertex {
    Vertex { position, u: uv.x, normal, v: uv.y }
}

fn lay(map: Option<model::Map>, textures: &[Map]) -> Map {
    let clamped = |m: &model::Map| if m.clamp { CLAMPED } else { 0 };
    map.map_or(BARE, |m| {
        let picture = textures[m.texture as usize];
        Map { levels: picture.levels | clamped(&m), scale: m.scale, shift: m.offset, ..picture }
    })
}

/// The scene's own material in the place of one with the same maps.
pub(super) fn recover(m: &Material, old: Paint) -> Paint {
    Paint { color: m.color * m.local, exponent: m.exponent, ..old }
}

/// The scene's own material.
fn cover(m: &Material, textures: &[Map]) -> Paint {
    let bare = Paint {
        color: Vec3::ZERO,
        exponent: 0.0,
        specular: Vec3::ONE,
        bump: m.maps.normal.map_or(1.0, |m| m.strength),
        diffuse_map: lay(m.maps.color, textures),
        normal_map: lay(m.maps.normal, textures),
        specular_map: lay(m.maps.specular, textures),
        exponent_map: BARE,
        opacity_map: BARE,
    };
    recover(m, bare)
}

/// A model's.
fn dress(m: &model::Material, textures: &[Map]) -> Paint {
    let map = |map| lay(map, textures);
    Paint {
        color: m.diffuse,
        exponent: m.exponent,
        specular: m.specular,
        bump: m.normal_map.map_or(1.0, |m| m.strength),
        diffuse_map: map(m.diffuse_map),
        normal_map: map(m.normal_map),
        specular_map: map(m.specular_map),
        exponent_map: map(m.exponent_map),
        opacity_map: map(m.opacity_map),
    }
}
