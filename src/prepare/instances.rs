//! meshes that share a model -> the model's leaves and its tree once, and where each of them stands

use glam::{Vec3, Vec4};

use super::bvh::{Bounds, Builder, Tree};
use super::leaves::{across, around, triangle};
use super::mesh::Sheet;
use crate::scene::{Mesh, Scene};
use crate::tables::{Instance, Leaf};

/// 64 units in the last place: what rounding takes off a point on its way from a model to the world and back is less
/// than a quarter of that.
const MARGIN: f32 = 3.8146973e-6;

/// What many meshes share.
pub(super) struct Form {
    pub(super) leaves: Vec<Leaf>,
    pub(super) tree: Tree,
    /// The first of its faces.
    face: u32,
    /// Those that share it, in their order.
    meshes: Vec<usize>,
}

/// The leaves and the tree of a mesh's model, whose faces come to those of the sheet.
pub(super) fn form(scene: &Scene, meshes: Vec<usize>, sheet: &mut Sheet, builder: &dyn Builder) -> Form {
    let faces = sheet.model(&scene.meshes[meshes[0]], scene);
    let face = faces.start as u32;
    sheet.turn(faces.start);
    let all = sheet.faces[faces].iter().zip(0..).map(|(face, id)| triangle(sheet, face, id));
    let all: Vec<Leaf> = all.filter(|leaf| across(leaf) != Vec3::ZERO).collect();
    let tree = builder.build(all.iter().map(around).collect());
    let leaves = tree.order.iter().map(|&i| all[i as usize]).collect();
    Form { leaves, tree, face, meshes }
}

impl Form {
    /// Where its meshes stand, each with the box around it; `id` counts their primitives through. The tree's own root
    /// and its first leaf are number 0 as yet.
    pub(super) fn instances(&self, scene: &Scene, id: &mut u32) -> Vec<(Instance, Bounds)> {
        let each = self.meshes.iter().map(|&i| &scene.meshes[i]);
        let placed = each.map(|mesh| {
            let placed = self.place(mesh, *id);
            *id += mesh.model.triangles.len() as u32;
            placed
        });
        // What has no leaves has no box either.
        placed.filter(|_| !self.leaves.is_empty()).collect()
    }

    fn place(&self, mesh: &Mesh, id: u32) -> (Instance, Bounds) {
        let size = mesh.size();
        let [x, y, z] = [Vec3::X, Vec3::Y, Vec3::Z].map(|axis| mesh.turn(axis) * size);
        let origin = mesh.place(Vec3::ZERO);
        let [low, high] = [self.tree.bounds.low, self.tree.bounds.high].map(Vec4::truncate);
        let corner = |i: usize| {
            let at = |axis: usize| if i & 1 << axis == 0 { low[axis] } else { high[axis] };
            origin + x * at(0) + y * at(1) + z * at(2)
        };
        let most = low.abs().max(high.abs());
        let reach = origin.abs() + x.abs() * most.x + y.abs() * most.y + z.abs() * most.z;
        let margin = reach.max_element() * MARGIN;
        let around = Bounds::around((0..8).map(corner));
        let more = Vec3::splat(margin).extend(0.0);
        let instance = Instance {
            x,
            root: 0,
            y,
            leaves: 0,
            z,
            id,
            origin,
            face: self.face,
            low,
            material: mesh.material.map_or(0, |material| material as u32),
            high,
            shrink: 1.0 / (size * size),
            margin,
            count: self.leaves.len() as u32,
            pad: [0; 2],
        };
        (instance, Bounds { low: around.low - more, high: around.high + more })
    }
}
