//! Models that stand in many places: in the tree once, met as brute force meets them, on both sides, in little memory.

use std::sync::Arc;

use twinlight::cpu::trace::CpuTrace;
use twinlight::cpu::trace::aim::Ray;
use twinlight::cpu::trace::instanced::primitive_at;
use twinlight::cpu::trace::seat::Seat;
use twinlight::cpu::trace::walk::{Walk, walk};
use twinlight::cpu::{Walker, Wides};
use twinlight::film::compare::{Standard, compare};
use twinlight::gpu::wgsl::Sources;
use twinlight::math::Vec3;
use twinlight::prepare::bvh::Halves;
use twinlight::prepare::{prepare, prepare_with};
use twinlight::scene::{self, Filter, Instance, Mesh, Scene};
use twinlight::tables::{FAR, INSTANCE, NONE, SPHERE, Tables};
use twinlight::trace;

use super::plain::meet;
use super::raster_frames::painted;
use super::stages::walk_along;
use super::trace_lace::lace;
use super::{Dice, Sliced, on_cpu, on_gpu, planted, root, tables_of};

/// Two models with holes, one of them with a second coat: both in many places, turned and scaled.
pub(super) fn crowd(number: u32, count: usize) -> Vec<Mesh> {
    let mut dice = Dice(number, 41);
    let base = [lace(number, number.is_multiple_of(2)), lace(number + 100, false)];
    let mut placed = |i: usize| {
        let mut mesh = base[i % 2].clone();
        (mesh.translate, mesh.rotate, mesh.scale) = (dice.point(1.0), dice.point(3.0), dice.within(0.1, 0.5));
        let [translate, rotate] = [dice.point(3.0), dice.point(3.0)];
        let place = Instance { number: i, translate, rotate, scale: dice.within(0.5, 1.5) };
        mesh.instance = (dice.below(3) > 0).then_some(place);
        mesh
    };
    (0..count).map(&mut placed).collect()
}

/// A scene of everything, and a crowd in it.
pub(super) fn crowded(number: u32) -> Scene {
    let mut scene = painted(number);
    scene.trace.filter = [Filter::Nearest, Filter::Bilinear, Filter::Mipmap][number as usize % 3];
    let mut dice = Dice(number, 43);
    scene.meshes = crowd(number, 12);
    for mesh in &mut scene.meshes {
        mesh.material = [None, None, Some(0), Some(1)][dice.below(4)];
    }
    scene
}

/// Every leaf of the world in turn, and for each instance every one of its model's, with the ray as the model sees it.
fn brute(tables: &Tables, ray: Ray, reach: f32, any: bool) -> Walk {
    let mut best = Walk::new(reach);
    let mut id = 0;
    let mut ask = |seat: &Seat, first: u32, count: u32| {
        for i in first..first + count {
            let leaf = &tables.leaves[i as usize];
            let number = i.wrapping_add(seat.numbers);
            let t = meet(seat, leaf, number);
            let nearer = t < best.t || (t == best.t && leaf.id + seat.ids < id);
            if leaf.kind != INSTANCE && nearer && seat.is_solid(tables, leaf, any) {
                (best.t, best.hit, id) = (t, number, leaf.id + seat.ids);
            }
        }
    };
    let world = tables.instances.iter().map(|of| of.leaves).min().unwrap_or(tables.leaves.len() as u32);
    ask(&Seat::in_world(tables, ray), 0, world);
    for of in &tables.instances {
        ask(&Seat::in_instance(tables, ray, of), of.leaves, of.count);
    }
    best
}

/// Rays anywhere, at corners and edges of instances, from one of their triangles on, and from far away.
pub(super) fn ray_at_instance(dice: &mut Dice, tables: &Tables) -> Ray {
    let settings = &tables.settings;
    let anywhere = |dice: &mut Dice| settings.low + (settings.high - settings.low) * (dice.point(0.75) + 0.5);
    let of = &tables.instances[dice.below(tables.instances.len())];
    let hit = of.id + settings.instances + dice.below(of.count as usize) as u32;
    let leaf = primitive_at(tables, hit).leaf;
    let (u, v) = (dice.unit(), dice.unit());
    let inside = leaf.a + (leaf.b - leaf.a) * (u * (1.0 - v)) + (leaf.c - leaf.a) * (u * v);
    let from = anywhere(dice);
    let (origin, direction, leaves) = match dice.below(7) {
        0 => (from, dice.direction(), NONE),
        1 => (from, [Vec3::X, Vec3::NEG_Y, Vec3::Z][dice.below(3)], NONE),
        2 => (from, [leaf.a, leaf.b, leaf.c][dice.below(3)] - from, NONE),
        3 => (from, leaf.a + (leaf.b - leaf.a) * u - from, NONE),
        4 => (inside, dice.direction(), hit),
        5 => (leaf.a, leaf.b - leaf.a, NONE),
        _ => {
            let away = from + dice.direction() * 10_f32.powf(dice.within(0.0, 5.0));
            (away, inside - away, NONE)
        }
    };
    let length = 10_f32.powf(dice.within(-3.0, 3.0));
    Ray { origin, direction: if direction == Vec3::ZERO { Vec3::X } else { direction * length }, leaves }
}

/// How many of so many rays find what brute force does not; and how many find anything.
fn compare_rays(tables: &Tables, seed: u32, rays: usize) -> (usize, usize) {
    let wides = Wides::new(tables);
    let mut walker = Walker::new(tables, &wides);
    let mut dice = Dice(seed, 1 << 21);
    let mut stack = vec![[0; 2]; tables.deep as usize];
    let (mut differ, mut hits) = (0, 0);
    let is = |a: &Walk, b: &Walk| a.hit == b.hit && a.t.to_bits() == b.t.to_bits();
    for i in 0..rays {
        let ray = ray_at_instance(&mut dice, tables);
        let expected = brute(tables, ray, FAR, false);
        let found = walk(tables, &mut stack, ray, Walk::new(FAR), u32::MAX, false);
        let mut same = is(&found, &expected) && is(&walker.walk(ray, Walk::new(FAR), false), &expected);
        // In small portions, each from where the one before was put down.
        if i % 4 == 0 {
            let mut portions = Walk::new(FAR);
            while !portions.over(tables, false) {
                portions = walk(tables, &mut stack, ray, Walk { turns: 0, ..portions }, 1 + i as u32 % 5, false);
            }
            same &= is(&portions, &expected);
        }
        let first = brute(tables, ray, FAR, true);
        let beyond = if first.hit == NONE { FAR } else { first.t.next_up() };
        for (reach, met) in [(first.t, false), (beyond, first.hit != NONE)] {
            let any = walk(tables, &mut stack, ray, Walk::new(reach), u32::MAX, true);
            same &= (any.hit != NONE) == met && any.flags == 0;
            same &= (walker.walk(ray, Walk::new(reach), true).hit != NONE) == met;
        }
        assert_eq!(found.flags, 0, "a stack was full");
        differ += usize::from(!same);
        hits += usize::from(expected.hit != NONE);
    }
    (differ, hits)
}

#[test]
fn rays_meet_in_instances_what_every_primitive_in_turn_says() {
    for number in 0..12 {
        let scene = Scene { planes: Vec::new(), ..crowded(number) };
        for tables in [prepare(&scene), prepare_with(&scene, &Halves)] {
            assert!(tables.instances.len() >= 4, "scene {number}");
            let (differ, hits) = compare_rays(&tables, number, 10_000);
            assert!(differ == 0 && hits > 3000, "scene {number}: {differ} differ, {hits} hit");
        }
    }
}

/// One copy, a huge one, tiny ones, far from where the model's own origin is, and models of nothing.
#[test]
fn scales_and_places_of_instances_do_not_matter() {
    for power in [-6, -3, 0, 3, 6] {
        let scale = 10_f32.powi(power);
        let mut scene = Scene { planes: Vec::new(), ..crowded(1) };
        (scene.spheres, scene.triangles) = (Vec::new(), Vec::new());
        for mesh in &mut scene.meshes {
            mesh.translate = (mesh.translate + Vec3::new(0.0, 300.0, -200.0)) * scale;
            mesh.scale *= scale;
            mesh.instance = None;
        }
        let nothing = Mesh::of(Arc::new(scene::model::Model::default()));
        scene.meshes.extend([nothing.clone(), nothing]);
        let (differ, hits) = compare_rays(&prepare(&scene), 5, 20_000);
        assert!(differ == 0 && hits > 6000, "1e{power}: {differ} differ, {hits} hit");
    }
}

#[test]
fn planted_faults_in_instances_are_seen() {
    let faults: [fn(&mut Tables); 5] = [
        |t| t.leaves.iter_mut().filter(|leaf| leaf.kind == INSTANCE).for_each(|leaf| leaf.material /= 2),
        |t| t.nodes.iter_mut().for_each(|node| node.high_x[0] = node.high_x[0].saturating_sub(0x0101_0101)),
        |t| t.instances[0].root = t.instances[t.instances.len() - 1].root,
        |t| t.instances[0].count -= 1,
        |t| t.leaves.iter_mut().filter(|leaf| leaf.kind == INSTANCE).for_each(|leaf| leaf.kind = SPHERE),
    ];
    let scene = Scene { planes: Vec::new(), ..crowded(3) };
    for (i, fault) in faults.into_iter().enumerate() {
        let mut tables = prepare(&scene);
        tables.instances.sort_by_key(|of| of.id);
        let right = tables.clone();
        fault(&mut tables);
        // What brute force does not read of the tables is seen against it, and the rest against the tables as they were.
        let mut dice = Dice(3, 1 << 21);
        let mut stack = vec![[0; 2]; tables.deep as usize];
        let seen = (0..20_000).any(|_| {
            let ray = ray_at_instance(&mut dice, &right);
            let found = walk(&tables, &mut stack, ray, Walk::new(FAR), u32::MAX, false);
            let expected = brute(&tables, ray, FAR, false);
            found.hit != expected.hit || found.t.to_bits() != expected.t.to_bits()
        });
        assert!(seen, "nobody sees fault {i}");
    }
}

#[test]
fn instances_are_traced_the_same_to_the_bit() {
    let mut met = 0;
    for number in 0..16 {
        let tables = tables_of(&crowded(number));
        let cpu = on_cpu(&tables);
        let gpu = on_gpu(&Sources::default(), &tables).expect("a film");
        let comparison = compare(&cpu, &gpu, Standard::Exact).expect("one size");
        assert!(comparison.passes(), "random scene {number}: {comparison:#?}");
        met += cpu.ids().iter().filter(|id| **id != NONE && **id >= tables.settings.loose).count();
        for (budget, pixels, rounds) in [(5, 1000, 1), (17, 65, 3)] {
            let mut stages = Sliced { stages: CpuTrace::new(&tables), budget, pixels, rounds };
            let Ok(film) = trace::frame(&mut stages, &tables, &mut |_| ());
            assert!(film == cpu, "random scene {number}, budget {budget}");
        }
    }
    assert!(met > 2000, "only {met} pixels see an instance");
}

#[test]
fn stages_of_instances_are_the_same() {
    for number in [2, 5] {
        let tables = tables_of(&crowded(number));
        walk_along(&tables, 8000, 2, &format!("crowded scene {number}"));
        walk_along(&tables, 4 + number, 12, &format!("crowded scene {number}, small budget"));
    }
}

#[test]
fn planted_faults_in_kernels_of_instances_are_seen() {
    let faults = [
        ("trace/instanced", "* placed.shrink;\n    let way", "* 0.99;\n    let way"),
        ("trace/instanced", "own.id + placed.face", "own.id + placed.id"),
        ("trace/instanced", "own.material + placed.material", "own.material"),
        ("trace/instanced", "first_id_of(min(next, last)) <= id", "first_id_of(min(next, last)) < id"),
        ("trace/instanced", "unit(fence(sum_by(corner.normal", "(fence(sum_by(corner.normal"),
        ("trace/walk", "size == base && !is_open(group)", "size == base + 1u"),
        ("trace/seat", "settings.instances + placed.id", "placed.id"),
        ("trace/walk", "leaf.id + seat.faces, leaf.material + seat.materials", "leaf.id, leaf.material"),
        ("trace/surface", ", primitive.margin)", ", 0.0)"),
    ];
    let tables: Vec<_> = (0..6).map(|number| tables_of(&crowded(number))).collect();
    let wanted: Vec<_> = tables.iter().map(on_cpu).collect();
    planted(&faults, &tables, &wanted, |sources, thing| on_gpu(sources, thing).ok());
}

/// The same models, each in a file of its own, so that each has its own place in the tree.
#[test]
fn instances_look_like_models_of_their_own() {
    let (mut inner, mut off) = (0, 0);
    for number in 0..8 {
        let scene = crowded(number);
        let mut apart = scene.clone();
        for mesh in &mut apart.meshes {
            mesh.model = Arc::new((*mesh.model).clone());
        }
        let [one, other] = [&scene, &apart].map(tables_of);
        assert!(!one.instances.is_empty() && other.instances.is_empty());
        let [one, other] = [on_cpu(&one), on_cpu(&other)];
        inner += one.pixels();
        let close = |p: u32| (one.color(p) - other.color(p)).abs().max_element() < 1.0 / 255.0;
        off += (0..one.pixels()).filter(|p| !close(*p)).count();
    }
    // Edges that go through a sample, and what mirrors and glass make of the last bits.
    assert!(off * 100 < inner as usize, "{off} of {inner} pixels differ");
}

#[test]
fn an_instance_takes_a_few_hundred_bytes() {
    let bytes = |count: usize| {
        let scene = Scene { meshes: crowd(1, count), ..crowded(1) };
        let mut all = 0;
        tables_of(&scene).each_bytes(&mut |part| all += part.len());
        all + scene.meshes.len() * size_of::<Mesh>()
    };
    let [few, many] = [20, 2020].map(bytes);
    assert!((many - few) / 2000 < 400, "{} bytes an instance", (many - few) / 2000);
}

const FILE: &str = r#"
[camera]
position = [0, 0, 5]
look_at = [0, 0, 0]
[film]
size = [8, 8]
[[material]]
name = "gold"
color = [1, 0.8, 0.2]
[[object.mesh]]
path = "meshes/ground.obj"
[[object.mesh]]
path = "meshes/ground.obj"
translate = [0, 1, 0]
scale = 2
instance = [{}, { translate = [3, 0, 0], rotate = [0, 90, 0], scale = 0.5, material = "gold" }]
"#;

#[test]
fn instances_stand_where_their_file_says() {
    let read = |text: &str| scene::parse(text, &root().join("scenes/instances.toml"));
    let scene = read(FILE).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(scene.meshes.len(), 3);
    let places: Vec<_> = scene.meshes.iter().map(|mesh| mesh.place(Vec3::X)).collect();
    assert_eq!(places[..2], [Vec3::X, Vec3::new(2.0, 1.0, 0.0)]);
    assert!(places[2].distance(Vec3::new(3.0, 0.5, -1.0)) < 1e-6, "{}", places[2]);
    assert_eq!([0, 1, 2].map(|i| scene.meshes[i].material), [None, None, Some(0)]);
    // Those of one coat share their model's tree.
    assert_eq!(scene.alone_and_shared(), (vec![2], vec![vec![0, 1]]));
    let wrong = read(&FILE.replace("scale = 0.5", "scale = 0")).expect_err("no scale").to_string();
    assert!(wrong.contains("object.mesh[1].instance[1].scale"), "{wrong}");
    let wrong = read(&FILE.replace("material = \"gold\" }", "material = \"gild\" }")).expect_err("no such");
    assert!(wrong.to_string().contains("the materials are \"gold\""), "{wrong}");
}
