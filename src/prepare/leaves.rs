//! objects of every kind -> leaves, and the trees over them

use glam::{Vec3, Vec4};
use rayon::prelude::*;

use super::bvh::{Bounds, Builder};
use super::instances::form;
use super::mesh::Sheet;
use crate::scene::{Plane, Scene};
use crate::tables::{CUT_OUT, Face, INSTANCE, Instance, Leaf, Node, ONE_SIDED, PLANE, SPHERE, TRIANGLE};

/// A scene's primitives and their trees, as [`Tables`](crate::tables::Tables) have them.
pub(super) struct Leaves {
    pub(super) all: Vec<Leaf>,
    pub(super) nodes: Vec<Node>,
    pub(super) deep: u32,
    pub(super) instances: Vec<Instance>,
    /// Primitives with ids from this on are those of instances.
    pub(super) loose: u32,
    /// Around all but planes.
    pub(super) bounds: Bounds,
}

/// All primitives, and on the sheet the faces of those that are triangles.
pub(super) fn leaves(scene: &Scene, sheet: &mut Sheet, builder: &dyn Builder) -> Leaves {
    let (alone, shared) = scene.alone_and_shared();
    sheet.triangles(scene);
    for mesh in alone.into_iter().map(|i| &scene.meshes[i]) {
        sheet.stand(mesh, scene, scene.has_no_backs(mesh));
    }
    sheet.turn(0);
    let along_u = |p: &Plane| p.axes()[0] / p.tile;
    let planes = scene.planes.iter().zip(scene.spheres.len() as u32..).map(|(p, id)| {
        let material = p.material as u32;
        Leaf { a: p.point, id, b: p.normal, material, c: along_u(p), kind: PLANE }
    });
    let mut all: Vec<Leaf> = planes.collect();
    let faces = sheet.faces.len();
    let loose = (scene.spheres.len() + all.len() + faces) as u32;
    let mut id = loose;
    let forms: Vec<_> = shared.into_iter().map(|meshes| form(scene, meshes, sheet, builder)).collect();
    let placed: Vec<Vec<_>> = forms.iter().map(|form| form.instances(scene, &mut id)).collect();
    let boxes = placed.iter().flatten().map(|(_, around)| *around).collect();
    let below = Below { scene, sheet, faces, boxes };
    let numbers: Vec<u32> = (0..below.count()).into_par_iter().filter(|&i| below.is_met(i)).collect();
    let tree = builder.build(numbers.par_iter().map(|&i| around(&below.leaf(i))).collect());
    let planes = all.len() as u32;
    let mut nodes: Vec<Node> =
        tree.nodes.into_iter().map(|node| Node { leaves: node.leaves + planes, ..node }).collect();
    all.par_extend(tree.order.par_iter().map(|&i| below.leaf(numbers[i as usize])));
    let mut deep = tree.deep;
    let mut instances = Vec::new();
    for (form, placed) in forms.iter().zip(placed) {
        let (root, leaves) = (nodes.len() as u32, all.len() as u32);
        let moved = |node: &Node| Node { children: node.children + root, leaves: node.leaves + leaves, ..*node };
        nodes.extend(form.tree.nodes.iter().map(moved));
        all.extend_from_slice(&form.leaves);
        instances.extend(placed.into_iter().map(|(instance, _)| Instance { root, leaves, ..instance }));
        deep = deep.max(2 * tree.deep + form.tree.deep + 1);
    }
    Leaves { all, nodes, deep, instances, loose, bounds: tree.bounds }
}

/// What may be below the nodes, by number: spheres, then faces, then instances. It is made when it is asked for, once
/// for its box and once for its place: that is faster than to keep it in between.
struct Below<'a> {
    scene: &'a Scene,
    sheet: &'a Sheet,
    /// How many of the sheet's are no instance's.
    faces: usize,
    /// Around each instance.
    boxes: Vec<Bounds>,
}

impl Below<'_> {
    fn count(&self) -> u32 {
        (self.scene.spheres.len() + self.faces + self.boxes.len()) as u32
    }

    /// Of a model, a face without area is met by no ray, and has no normal.
    fn is_met(&self, number: u32) -> bool {
        let solid = self.scene.spheres.len() + self.scene.triangles.len();
        (number as usize) < solid || across(&self.leaf(number)) != Vec3::ZERO || self.is_instance(number)
    }

    fn is_instance(&self, number: u32) -> bool {
        number as usize >= self.scene.spheres.len() + self.faces
    }

    fn leaf(&self, number: u32) -> Leaf {
        let i = number as usize;
        let spheres = self.scene.spheres.len();
        if let Some(sphere) = self.scene.spheres.get(i) {
            let [b, c] = [Vec3::X * sphere.radius, Vec3::ZERO];
            Leaf { a: sphere.center, id: number, b, material: sphere.material as u32, c, kind: SPHERE }
        } else if self.is_instance(number) {
            let place = i - spheres - self.faces;
            let [a, b] = [self.boxes[place].low, self.boxes[place].high].map(Vec4::truncate);
            Leaf { a, id: 0, b, material: place as u32, c: Vec3::ZERO, kind: INSTANCE }
        } else {
            triangle(self.sheet, &self.sheet.faces[i - spheres], number + self.scene.planes.len() as u32)
        }
    }
}

/// A face as a leaf.
pub(super) fn triangle(sheet: &Sheet, face: &Face, id: u32) -> Leaf {
    let [a, b, c] = [face.a, face.b, face.c].map(|i| sheet.vertices[i as usize].position);
    let marks = face.paint & (ONE_SIDED | CUT_OUT);
    Leaf { a, id, b, material: face.paint ^ marks, c, kind: TRIANGLE | marks }
}

/// Twice a triangle's area, along its normal.
pub(super) fn across(leaf: &Leaf) -> Vec3 {
    (leaf.b - leaf.a).cross(leaf.c - leaf.a)
}

/// The box around a primitive that is not a plane.
pub(super) fn around(leaf: &Leaf) -> Bounds {
    match leaf.kind {
        SPHERE => {
            let down = |x: f32| (x - leaf.b.x).next_down();
            let up = |x: f32| (x + leaf.b.x).next_up();
            let center = leaf.a.to_array();
            Bounds::around([Vec3::from_array(center.map(down)), Vec3::from_array(center.map(up))])
        }
        INSTANCE => Bounds::around([leaf.a, leaf.b]),
        _ => Bounds::around([leaf.a, leaf.b, leaf.c]),
    }
}
