//! objects of every kind -> leaves, the materials of models, and the tree over them

use glam::Vec3;
use rayon::prelude::*;

use super::bvh::{Bounds, Builder, Tree};
use super::tint;
use crate::scene::{Mesh, Plane, Scene, model};
use crate::tables::{Leaf, MIRROR, Material, PLANE, SPHERE, TRIANGLE};

/// A scene's primitives and their tree.
pub(super) struct Leaves {
    pub(super) all: Vec<Leaf>,
    pub(super) tree: Tree,
    /// What models are made of, after the scene's own.
    pub(super) materials: Vec<Material>,
}

/// All primitives: planes, then the others in the order of their tree.
pub(super) fn leaves(scene: &Scene, builder: &dyn Builder) -> Leaves {
    let mut id = 0_u32;
    let mut leaf = |kind: u32, material: usize, [a, b, c]: [Vec3; 3]| {
        id += 1;
        Leaf { a, id: id - 1, b, material: material as u32, c, kind }
    };
    let none = Vec3::ZERO;
    let mut below: Vec<Leaf> = Vec::new();
    for s in &scene.spheres {
        below.push(leaf(SPHERE, s.material, [s.center, Vec3::X * s.radius, none]));
    }
    let along_u = |p: &Plane| p.axes()[0] / p.tile;
    let mut leaves: Vec<Leaf> =
        scene.planes.iter().map(|p| leaf(PLANE, p.material, [p.point, p.normal, along_u(p)])).collect();
    for t in &scene.triangles {
        below.push(leaf(TRIANGLE, t.material, t.vertices));
    }
    let mut materials = Vec::new();
    for mesh in &scene.meshes {
        let first = scene.materials.len() + materials.len();
        if mesh.material.is_none() {
            materials.extend(mesh.model.materials.iter().map(dress));
        }
        for (corners, material) in triangles(mesh) {
            let triangle = leaf(TRIANGLE, mesh.material.unwrap_or(first + material as usize), corners);
            // One without area is met by no ray, and has no normal.
            if across(corners) != Vec3::ZERO {
                below.push(triangle);
            }
        }
    }
    let boxes: Vec<Bounds> = below.par_iter().map(around).collect();
    let mut tree = builder.build(&boxes);
    for node in &mut tree.nodes {
        node.leaves += leaves.len() as u32;
    }
    leaves.par_extend(tree.order.par_iter().map(|&i| below[i as usize]));
    Leaves { all: leaves, tree, materials }
}

fn across([a, b, c]: [Vec3; 3]) -> Vec3 {
    (b - a).cross(c - a)
}

/// A model's triangles in world space, each with which of the model's materials it is made of.
fn triangles(mesh: &Mesh) -> impl Iterator<Item = ([Vec3; 3], u32)> {
    let positions: Vec<Vec3> = mesh.model.positions.iter().map(|p| mesh.place(*p)).collect();
    mesh.model
        .triangles
        .iter()
        .map(move |t| (t.corners.map(|corner| positions[corner.position as usize]), t.material))
}

fn dress(m: &model::Material) -> Material {
    Material {
        color: m.diffuse,
        local_weight: 1.0,
        tint: tint(m.diffuse),
        reflect_weight: 0.0,
        refract_weight: 0.0,
        exponent: m.exponent,
        index: 1.0,
        behavior: MIRROR,
    }
}

/// The box around a primitive that is not a plane.
fn around(leaf: &Leaf) -> Bounds {
    if leaf.kind == SPHERE {
        let down = |x: f32| (x - leaf.b.x).next_down();
        let up = |x: f32| (x + leaf.b.x).next_up();
        let center = leaf.a.to_array();
        return Bounds::around([Vec3::from_array(center.map(down)), Vec3::from_array(center.map(up))]);
    }
    Bounds::around([leaf.a, leaf.b, leaf.c])
}
