//! Faces with holes and without backs in the ray tracer: the same on both sides, and holes where the pictures say.

use std::sync::Arc;

use twinlight::cpu::trace::aim::Ray;
use twinlight::cpu::trace::walk::{Walk, walk};
use twinlight::film::compare::{Standard, compare};
use twinlight::gpu::wgsl::Sources;
use twinlight::math::{Vec2, Vec3};
use twinlight::prepare::prepare;
use twinlight::scene::model::{Content, Corner, Map, Material, Model, Texture, Triangle};
use twinlight::scene::{Behavior, Filter, Light, Mesh, Scene};
use twinlight::tables::{CUT_OUT, FAR, NONE, ONE_SIDED};

use super::bvh::compare_rays;
use super::raster_frames::painted;
use super::{Dice, on_cpu, on_gpu, planted, tables_of};

/// Texels along a side of the picture.
const SIDE: u32 = 16;

/// Squares, every third of them whole; in all others the picture cuts a round hole.
pub(super) fn lace(number: u32, one_sided: bool) -> Mesh {
    let mut dice = Dice(number, 23);
    let mut model = Model { groups: vec![String::new()], ..Model::default() };
    for i in 0..24 {
        let (first, middle) = (model.positions.len() as u32, dice.point(3.0));
        let across = dice.direction() * dice.within(0.5, 2.0);
        let up = across.cross(dice.direction());
        for [x, y] in [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]] {
            model.positions.push(middle + across * x + up * y);
            model.uvs.push(Vec2::new(x, y) * 0.5 + 0.5);
        }
        model.normals.push(across.cross(up).normalize_or(Vec3::X));
        let corner = |k: u32| Corner { position: first + k, uv: first + k, normal: i };
        for [b, c] in [[1, 2], [2, 3]] {
            let corners = [corner(0), corner(b), corner(c)];
            model.triangles.push(Triangle { corners, material: u32::from(i % 3 > 0), group: 0 });
        }
    }
    let alpha = |x: u32, y: u32| {
        let away = Vec2::new(x as f32 + 0.5, y as f32 + 0.5) - SIDE as f32 / 2.0;
        (away.length() * 255.0 / SIDE as f32 * 1.8) as u8
    };
    let texels = (0..SIDE * SIDE).map(|i| [9, 9, 9, alpha(i % SIDE, i / SIDE)]).collect();
    let texture = Texture {
        file: String::new(),
        content: Content::Scalar,
        width: SIDE,
        height: SIDE,
        texels,
        has_alpha: true,
    };
    model.textures = vec![texture];
    let scale = Vec2::splat(1.0 + (number % 2) as f32);
    let holes = Map { texture: 0, scale, offset: dice.point(1.0).truncate(), clamp: false, strength: 1.0 };
    let cut = Material { opacity_map: Some(holes), ..Material::named("lace") };
    model.materials = vec![Material::named("whole"), cut];
    Mesh { one_sided, ..Mesh::of(Arc::new(model)) }
}

/// A scene of everything, with laces in it, which is one-sided in every second one.
pub(super) fn laced(number: u32) -> Scene {
    let mut scene = painted(number);
    scene.trace.filter = [Filter::Nearest, Filter::Bilinear, Filter::Mipmap][number as usize % 3];
    scene.meshes = vec![lace(number, number.is_multiple_of(2))];
    // What a back keeps from the light.
    scene.lights.push(Light::Directional { toward: Vec3::new(0.3, 0.6, 0.74), power: Vec3::ONE, camera: None });
    scene.meshes[0].material = if number % 5 == 4 { Some(0) } else { None };
    scene
}

#[test]
fn traced_holes_are_the_same_to_the_bit() {
    let mut through = 0;
    for number in 0..24 {
        let tables = tables_of(&laced(number));
        let cpu = on_cpu(&tables);
        let gpu = on_gpu(&Sources::default(), &tables).expect("a film");
        let comparison = compare(&cpu, &gpu, Standard::Exact).expect("one size");
        assert!(comparison.passes(), "random scene {number}: {comparison:#?}");
        let mut whole = tables;
        whole.leaves.iter_mut().for_each(|leaf| leaf.kind &= !(CUT_OUT | ONE_SIDED));
        let whole = on_cpu(&whole);
        through += (0..cpu.pixels()).filter(|&p| cpu.id(p) != whole.id(p)).count();
    }
    assert!(through > 1000, "only {through} pixels show what lies behind a hole");
}

#[test]
fn rays_through_holes_find_what_every_primitive_in_turn_says() {
    for number in 0..10 {
        let scene = Scene { planes: Vec::new(), ..laced(number) };
        let tally = compare_rays(&prepare(&scene), number, 20_000);
        assert!(tally.differ == 0 && tally.hits * 8 > tally.rays, "scene {number}: {tally:?}");
    }
}

/// The opacity at a point of a face, in f64 and between the four nearest texels; `None` where it is next to a half.
fn opacity(scene: &Scene, triangle: usize, weights: [f64; 3]) -> Option<bool> {
    let model = &scene.meshes[0].model;
    let Triangle { corners, material, .. } = model.triangles[triangle];
    let Some(map) = model.materials[material as usize].opacity_map else { return Some(true) };
    let uvs = corners.map(|corner| model.uv(corner).as_dvec2());
    let uv = uvs[0] * weights[0] + uvs[1] * weights[1] + uvs[2] * weights[2];
    let full = uv * map.scale.as_dvec2() + map.offset.as_dvec2();
    let [x, y] = [full.x, full.y].map(|at| at.rem_euclid(1.0) * f64::from(SIDE) - 0.5);
    let alpha = |x: i64, y: i64| {
        let [x, y] = [x, y].map(|at| at.rem_euclid(i64::from(SIDE)) as u32);
        f64::from(model.textures[0].texels[((SIDE - 1 - y) * SIDE + x) as usize][3]) / 255.0
    };
    let (column, row) = (x.floor() as i64, y.floor() as i64);
    let mixed = |p: f64, q: f64, share: f64| p + (q - p) * share;
    let low = mixed(alpha(column, row), alpha(column + 1, row), x - x.floor());
    let high = mixed(alpha(column, row + 1), alpha(column + 1, row + 1), x - x.floor());
    let value = mixed(low, high, y - y.floor());
    ((value - 0.5).abs() > 1e-2).then_some(value > 0.5)
}

/// Rays at points of faces: what stops them is what f64 says is there, and its back stops only those for any hit.
#[test]
fn holes_and_backs_are_where_the_model_has_them() {
    let mut counts = [0; 4];
    for number in 0..20 {
        let mut scene = laced(number * 2);
        scene.trace.filter = Filter::Bilinear;
        scene.meshes[0].material = None;
        (scene.spheres, scene.planes, scene.triangles) = (Vec::new(), Vec::new(), Vec::new());
        let mut dice = Dice(number, 31);
        let model = Arc::clone(&scene.meshes[0].model);
        for (i, triangle) in model.triangles.iter().enumerate() {
            // Alone, so that nothing else is in the way.
            let alone = Model { triangles: vec![*triangle], ..(*model).clone() };
            scene.meshes[0].model = Arc::new(alone);
            let tables = prepare(&scene);
            let mut stack = vec![[0; 2]; tables.deep as usize];
            let corners = triangle.corners.map(|corner| model.positions[corner.position as usize]);
            let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
            scene.meshes[0].model = Arc::clone(&model);
            for _ in 0..50 {
                let (u, v) = (dice.unit(), dice.unit());
                let weights = [1.0 - u, u * (1.0 - v), u * v];
                let to = corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2];
                let origin = to + dice.direction() * 5.0;
                let across = normal.normalize_or_zero().dot((to - origin) / 5.0);
                let Some(there) = opacity(&scene, i, weights.map(f64::from)) else { continue };
                if across.abs() < 0.05 || weights.iter().any(|w| *w < 1e-3) {
                    continue;
                }
                let ray = Ray { origin, direction: to - origin, leaves: NONE };
                let mut met = |any| walk(&tables, &mut stack, ray, Walk::new(FAR), u32::MAX, any).hit != NONE;
                assert_eq!(met(false), there && across < 0.0, "scene {number}, triangle {i}");
                assert_eq!(met(true), there, "scene {number}, triangle {i}, any");
                counts[usize::from(there) * 2 + usize::from(across < 0.0)] += 1;
            }
        }
    }
    assert!(counts.iter().all(|count| *count > 500), "{counts:?}");
}

/// What is made of glass keeps its backs, or nothing would come out of it again.
#[test]
fn glass_has_two_sides() {
    let mut scene = laced(0);
    scene.meshes[0].material = Some(0);
    for (behavior, marked) in [(Behavior::Glass, false), (Behavior::Mirror, true)] {
        scene.materials[0].behavior = behavior;
        assert_eq!(prepare(&scene).leaves.iter().any(|leaf| leaf.kind & ONE_SIDED != 0), marked, "{behavior:?}");
    }
}

#[test]
fn planted_faults_in_traced_holes_are_seen() {
    let faults = [
        ("trace/solid", "any || front", "front"),
        ("trace/solid", "(aim.shear.z > 0.0)", "(aim.shear.z < 0.0)"),
        ("trace/solid", "e / area", "e.yzx / area"),
        ("trace/seat", "0u - settings.spheres - settings.planes", "0u - settings.planes"),
        ("trace/solid", "solid && (leaf.kind & CUT_OUT) != 0u", "false"),
        ("trace/walk", "nearer && leaf.kind > PLANE", "false"),
        ("trace/walk", "seat.materials, any)", "seat.materials, true)"),
        ("shade/texture", "mixed(low, high, up) >= 0.5", "mixed(low, high, up) >= 0.45"),
    ];
    let tables: Vec<_> = (0..6).map(|number| tables_of(&laced(number))).collect();
    let wanted: Vec<_> = tables.iter().map(on_cpu).collect();
    planted(&faults, &tables, &wanted, |sources, thing| Some(on_gpu(sources, thing).expect("a film")));
}
