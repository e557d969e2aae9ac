//! The tree against every primitive: each ray must find the same leaf at the same distance, to the bit.

use rayon::prelude::*;
use twinlight::cpu::trace::aim::Ray;
use twinlight::cpu::trace::seat::Seat;
use twinlight::cpu::trace::walk::{Walk, walk};
use twinlight::cpu::{Walker, Wides};
use twinlight::gpu::wgsl::Sources;
use twinlight::math::Vec3;
use twinlight::prepare::bvh::{Binned, Bounds, Builder, Halves, Tree};
use twinlight::prepare::{prepare, prepare_with};
use twinlight::scene::{self, Scene, Sphere, Triangle};
use twinlight::tables::{FAR, Leaf, NONE, Node, PLANE, SPHERE, Tables};

use super::plain::meet;
use super::{Dice, on_cpu, on_gpu, root, small};

/// A scene of these triangles and nothing else.
pub(super) fn scene_of(corners: &[[Vec3; 3]]) -> Scene {
    let mut scene = small(&root().join("scenes/pyramid.toml"), [9, 7], 1);
    scene.spheres.clear();
    scene.planes.clear();
    scene.triangles =
        corners.iter().map(|&vertices| Triangle { vertices, material: 0, uvs: Triangle::UVS }).collect();
    scene
}

/// Triangles of every size, a thousandth to whole, sharing corners now and then.
pub(super) fn soup(number: u32, count: usize) -> Vec<[Vec3; 3]> {
    let mut dice = Dice(number, 1 << 21);
    let mut all: Vec<[Vec3; 3]> = Vec::new();
    for i in 0..count {
        let size = 10_f32.powf(dice.within(-3.0, 0.0));
        let a = if i % 3 == 1 { all[i - 1][2] } else { dice.point(1.0) };
        all.push([a, a + dice.point(size), a + dice.point(size)]);
    }
    all
}

/// Triangles that lie in each other's middle, each half as large as the one before, every fifth one twice or more:
/// no plane parts them well, so that the tree is deep.
pub(super) fn deep() -> Vec<[Vec3; 3]> {
    let mut dice = Dice(5, 1 << 21);
    let mut all = Vec::new();
    for i in 0..500 {
        let size = 0.5_f32.powi(i % 40);
        let one = [dice.point(size), dice.point(size), dice.point(size)];
        all.extend(std::iter::repeat_n(one, if i % 5 == 0 { 1 + dice.below(6) } else { 1 }));
    }
    all
}

/// A part of the bust, as its file has it.
pub(super) fn bust(step: usize) -> Vec<[Vec3; 3]> {
    let scene = scene::load(&root().join("scenes/bust.toml")).unwrap_or_else(|e| panic!("{e}"));
    let model = &scene.meshes[0].model;
    let corners = |t: &scene::model::Triangle| t.corners.map(|c| model.positions[c.position as usize]);
    model.triangles.iter().step_by(step).map(corners).collect()
}

/// Rays of all kinds: anywhere, along axes, at corners and edges, in the plane of triangles, from triangles on, from
/// far away, with directions of any length.
pub(super) fn ray(dice: &mut Dice, tables: &Tables) -> Ray {
    let (low, high) = (tables.settings.low, tables.settings.high);
    let size = (high - low).max_element();
    let anywhere = |dice: &mut Dice| low + (high - low) * (dice.point(0.75) + 0.5);
    if tables.leaves.is_empty() {
        return Ray { origin: anywhere(dice), direction: dice.direction(), leaves: NONE };
    }
    let i = dice.below(tables.leaves.len());
    let leaf = tables.leaves[i];
    let inside = |dice: &mut Dice, leaf: &Leaf| {
        if leaf.kind == SPHERE {
            return leaf.a + dice.direction() * leaf.b.x;
        }
        let (u, v) = (dice.unit(), dice.unit());
        leaf.a + (leaf.b - leaf.a) * (u * (1.0 - v)) + (leaf.c - leaf.a) * (u * v)
    };
    let (origin, direction, leaves) = match dice.below(8) {
        0 => (anywhere(dice), dice.direction(), NONE),
        1 => (anywhere(dice), [Vec3::X, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_X][dice.below(4)], NONE),
        2 => {
            let from = anywhere(dice);
            (from, [leaf.a, leaf.b, leaf.c][dice.below(3)] - from, NONE)
        }
        3 => {
            let from = anywhere(dice);
            (from, leaf.a + (leaf.b - leaf.a) * dice.unit() - from, NONE)
        }
        4 => {
            let from = anywhere(dice);
            (from, inside(dice, &leaf) - from, NONE)
        }
        // In the plane of a triangle.
        5 => (leaf.a, leaf.b - leaf.a, NONE),
        6 => (inside(dice, &leaf), dice.direction(), i as u32),
        _ => {
            let from = anywhere(dice) + dice.direction() * size * 10_f32.powf(dice.within(0.0, 5.0));
            (from, inside(dice, &leaf) - from, NONE)
        }
    };
    let length = 10_f32.powf(dice.within(-3.0, 3.0));
    let direction = if direction == Vec3::ZERO { Vec3::X } else { direction * length };
    Ray { origin, direction, leaves }
}

/// Every leaf in turn: what a walk must find.
pub(super) fn brute(tables: &Tables, ray: Ray, reach: f32, any: bool) -> Walk {
    let seat = Seat::in_world(tables, ray);
    let mut best = Walk::new(reach);
    let mut id = 0;
    for (leaf, i) in tables.leaves.iter().zip(0..) {
        let t = meet(&seat, leaf, i);
        let nearer = t < best.t || (t == best.t && leaf.id < id);
        if nearer && seat.is_solid(tables, leaf, any) {
            (best.t, best.hit, id) = (t, i, leaf.id);
        }
    }
    best
}

#[derive(Debug, Default)]
pub(super) struct Tally {
    pub(super) rays: usize,
    pub(super) hits: usize,
    pub(super) differ: usize,
}

/// So many rays, each asked for its nearest hit and for any.
pub(super) fn compare_rays(tables: &Tables, seed: u32, rays: usize) -> Tally {
    let wides = Wides::new(tables);
    let pierced = tables.leaves.iter().any(|leaf| leaf.kind > PLANE);
    let tally = |chunk: usize| {
        let mut dice = Dice(seed, (chunk as u32) << 18);
        let mut stack = vec![[0; 2]; tables.deep as usize];
        let mut walker = Walker::new(tables, &wides);
        let mut tally = Tally::default();
        for _ in 0..1000.min(rays - chunk * 1000) {
            let ray = ray(&mut dice, tables);
            let expected = brute(tables, ray, FAR, false);
            let found = walk(tables, &mut stack, ray, Walk::new(FAR), u32::MAX, false);
            let same = found.hit == expected.hit && found.t.to_bits() == expected.t.to_bits();
            let eight = walker.walk(ray, Walk::new(FAR), false);
            let same = same && eight.hit == expected.hit && eight.t.to_bits() == expected.t.to_bits();
            // Up to the hit there is nothing; up to a little beyond it there is something.
            let first = if pierced { brute(tables, ray, FAR, true) } else { expected };
            let free = walk(tables, &mut stack, ray, Walk::new(first.t), u32::MAX, true);
            let beyond = if first.hit == NONE { FAR } else { first.t.next_up() };
            let blocked = walk(tables, &mut stack, ray, Walk::new(beyond), u32::MAX, true);
            let same = same && free.hit == NONE && (blocked.hit == NONE) == (first.hit == NONE);
            let same = same && walker.walk(ray, Walk::new(first.t), true).hit == NONE;
            let same = same && (walker.walk(ray, Walk::new(beyond), true).hit == NONE) == (first.hit == NONE);
            assert_eq!(found.flags | free.flags | blocked.flags, 0, "a stack was full");
            tally.rays += 1;
            tally.hits += usize::from(expected.hit != NONE);
            tally.differ += usize::from(!same);
        }
        tally
    };
    let add =
        |a: Tally, b: Tally| Tally { rays: a.rays + b.rays, hits: a.hits + b.hits, differ: a.differ + b.differ };
    (0..rays.div_ceil(1000)).into_par_iter().map(tally).reduce(Tally::default, add)
}

#[test]
fn three_million_rays_find_what_every_primitive_in_turn_says() {
    let meshes = [("soup", soup(1, 400)), ("deep", deep()), ("bust", bust(37))];
    for (i, (name, corners)) in meshes.into_iter().enumerate() {
        let tables = prepare(&scene_of(&corners));
        let tally = compare_rays(&tables, i as u32, 1_010_000);
        assert!(tally.hits * 4 > tally.rays, "{name}: {tally:?}: that is no test");
        assert_eq!(tally.differ, 0, "{name}: {tally:?}");
    }
    let whole = prepare(&scene_of(&bust(1)));
    let tally = compare_rays(&whole, 9, 10_000);
    assert_eq!(tally.differ, 0, "the whole bust: {tally:?}");
}

#[test]
fn scales_do_not_matter() {
    for power in [-8, -4, 0, 4, 8] {
        let scale = 10_f32.powi(power);
        let corners: Vec<_> = soup(2, 120).iter().map(|t| t.map(|v| v * scale)).collect();
        let far: Vec<_> =
            corners.iter().map(|t| t.map(|v| v + Vec3::new(7.0, -3.0, 5.0) * scale * 100.0)).collect();
        for corners in [corners, far] {
            let tables = prepare(&scene_of(&corners));
            let tally = compare_rays(&tables, 3, 20_000);
            assert!(tally.differ == 0 && tally.hits * 4 > tally.rays, "scale 1e{power}: {tally:?}");
        }
    }
}

#[test]
fn degenerate_lists_make_trees() {
    let mut dice = Dice(4, 0);
    let one = [dice.point(1.0), dice.point(1.0), dice.point(1.0)];
    let flat =
        |i: usize| [Vec3::new(i as f32, 0.0, 0.0), Vec3::new(i as f32 + 1.0, 0.0, 0.0), Vec3::new(0.5, 1.0, 0.0)];
    let line = [Vec3::ZERO, Vec3::X, Vec3::X * 2.0];
    let huge = [Vec3::splat(-1e9), Vec3::new(1e9, -1e9, 0.0), Vec3::new(0.0, 1e9, 1e9)];
    let tiny = [Vec3::ZERO, Vec3::X * 1e-12, Vec3::Y * 1e-12];
    let lists = [
        Vec::new(),
        vec![one],
        vec![one; 2],
        vec![one; 1363],
        vec![line; 9],
        (0..100).map(flat).collect(),
        [vec![huge, tiny], soup(6, 50)].concat(),
        [vec![huge; 20], vec![tiny; 20], vec![line; 20]].concat(),
    ];
    for (i, corners) in lists.iter().enumerate() {
        let tables = prepare(&scene_of(corners));
        assert!(tables.deep <= 40, "list {i}: {} nodes down", tables.deep);
        let tally = compare_rays(&tables, 7, 4000);
        assert_eq!(tally.differ, 0, "list {i}: {tally:?}");
    }
}

#[test]
fn spheres_among_triangles_are_found() {
    let mut scene = scene_of(&soup(8, 150));
    let mut dice = Dice(8, 0);
    for _ in 0..150 {
        let radius = 10_f32.powf(dice.within(-4.0, -0.5));
        scene.spheres.push(Sphere { center: dice.point(1.0), radius, material: 0 });
    }
    let tally = compare_rays(&prepare(&scene), 8, 100_000);
    assert!(tally.differ == 0 && tally.hits * 4 > tally.rays, "{tally:?}");
}

#[test]
fn a_tree_is_the_same_with_any_number_of_threads() {
    // More boxes than one core works at alone, parted by planes and not.
    for corners in [soup(11, 40_000), vec![soup(12, 1)[0]; 20_000]] {
        let boxes: Vec<Bounds> = corners.iter().map(|corners| Bounds::around(*corners)).collect();
        let build = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
            pool.install(|| Binned.build(boxes.clone()))
        };
        let one = build(1);
        for threads in [2, 3, 8] {
            assert!(one == build(threads), "on {threads} threads");
        }
        let mut order = one.order;
        order.sort_unstable();
        assert!(order.iter().copied().eq(0..boxes.len() as u32), "each box is a leaf's once");
    }
}

/// The cross-check: a tree that is built in another way, two children a node.
#[test]
fn a_tree_of_two_children_says_the_same() {
    let coincident = vec![soup(4, 1)[0]; 60];
    for (i, corners) in [soup(3, 400), deep(), bust(37), coincident, Vec::new()].iter().enumerate() {
        let tables = prepare_with(&scene_of(corners), &Halves);
        let two = |node: &Node| (node.inner & 255).count_ones() + (node.held & 0o1111_1111).count_ones() <= 2;
        assert!(tables.nodes.iter().all(two), "list {i}");
        let tally = compare_rays(&tables, i as u32, 50_000);
        assert_eq!(tally.differ, 0, "list {i}: {tally:?}");
    }
    let scene = small(&root().join("scenes/bust.toml"), [61, 43], 1);
    let film = on_cpu(&prepare(&scene));
    let tables = prepare_with(&scene, &Halves);
    assert!(film == on_cpu(&tables), "no tree shows in a picture");
    assert!(film == on_gpu(&Sources::default(), &tables).expect("a film"), "nor on the GPU");
}

/// What is wrong with a tree: boxes that are a step too small, a child that is not there, children that are those of
/// another.
struct Faulty(Fault);

type Fault = fn(&mut Tree);

impl Builder for Faulty {
    fn build(&self, boxes: Vec<Bounds>) -> Tree {
        let mut tree = Binned.build(boxes);
        (self.0)(&mut tree);
        tree
    }
}

#[test]
fn planted_faults_in_trees_are_seen() {
    fn each(tree: &mut Tree, fault: impl Fn(&mut Node)) {
        tree.nodes.iter_mut().for_each(fault);
    }
    let faults: [(&str, Fault); 5] = [
        ("a box a step too small", |tree| each(tree, |n| n.high_x[0] = n.high_x[0].saturating_sub(0x0101_0101))),
        ("a box a step too late", |tree| each(tree, |n| n.low_z[1] |= 0x0101_0101)),
        ("a child dropped", |tree| each(tree, |n| n.held &= !7)),
        ("a leaf short of a primitive", |tree| each(tree, |n| n.held &= !0o4444_0000)),
        ("children of another", |tree| tree.nodes[0].children += 1),
    ];
    let scene = scene_of(&soup(1, 400));
    for (what, fault) in faults {
        let mut tables = prepare_with(&scene, &Faulty(fault));
        tables.nodes.push(tables.nodes[1]);
        assert!(compare_rays(&tables, 1, 20_000).differ > 0, "{what} goes unnoticed");
    }
}

/// A walk that asks the leaves in another order, and one that takes the first of two: the tie is what tells them.
#[test]
fn of_coincident_primitives_the_lowest_number_is_met() {
    let corners = vec![[Vec3::new(-1.0, -1.0, 0.0), Vec3::new(1.0, -1.0, 0.0), Vec3::Y]; 40];
    let tables = prepare(&scene_of(&corners));
    let order: Vec<u32> = tables.leaves.iter().map(|leaf| leaf.id).collect();
    let mut turned = tables.clone();
    turned.leaves.reverse();
    let mut stack = vec![[0; 2]; tables.deep as usize];
    for tables in [&tables, &turned] {
        let ray = Ray { origin: Vec3::Z * 3.0, direction: Vec3::NEG_Z, leaves: NONE };
        let found = walk(tables, &mut stack, ray, Walk::new(FAR), u32::MAX, false);
        assert_eq!(tables.leaves[found.hit as usize].id, 0, "{order:?}");
    }
}
