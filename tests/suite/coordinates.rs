//! Texture coordinates beyond a picture: where its edge goes on, and where they are too large to lie anywhere.

use std::sync::Arc;

use twinlight::film::compare::{Standard, compare};
use twinlight::gpu::wgsl::Sources;
use twinlight::math::{Vec2, Vec3};
use twinlight::scene::model::{Content, Corner, Map, Material, Model, Texture, Triangle};
use twinlight::scene::{Filter, Light, Mesh, Method, Scene, Show};

use twinlight::tables::NONE;

use super::{Dice, root, scene_on_cpu, scene_on_gpu, small};

/// A square from (-1, -1) to (1, 1) that fills the film, with pictures of noise; its corners' coordinates are counted
/// counterclockwise from the lower left.
fn square(uvs: [[f32; 2]; 4], map: Map) -> Scene {
    let mut dice = Dice(7, 41);
    let mut texture = |content| {
        let texels = (0..15).map(|_| dice.bits().to_le_bytes()).collect();
        Texture { file: String::new(), content, width: 5, height: 3, texels, has_alpha: true }
    };
    let textures = [Content::Color, Content::Normal, Content::Scalar].map(&mut texture).into();
    let [color, normal, holes] = [0, 1, 2].map(|texture| Some(Map { texture, ..map }));
    let plain = Material { diffuse: Vec3::ONE, diffuse_map: color, normal_map: normal, ..Material::named("") };
    let cut = Material { opacity_map: holes, ..plain.clone() };
    let corner = |i| Corner { position: i, uv: i, normal: 0 };
    let model = Model {
        positions: [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]| Vec3::new(x, y, 0.0)).into(),
        uvs: uvs.map(Vec2::from_array).into(),
        normals: vec![Vec3::Z],
        triangles: [([0, 1, 2], 0), ([0, 2, 3], 1)]
            .map(|(corners, material)| Triangle { corners: corners.map(corner), material, group: 0 })
            .into(),
        materials: vec![plain, cut],
        textures,
        groups: vec![String::new()],
        warnings: Vec::new(),
    };
    let mut scene = small(&root().join("scenes/bust.toml"), [24, 24], 1);
    scene.meshes = vec![Mesh::of(Arc::new(model))];
    scene.lights = vec![Light::Directional { toward: Vec3::Z, power: Vec3::ONE, camera: None }];
    (scene.camera.position, scene.camera.look_at) = (Vec3::Z * 4.0, Vec3::ZERO);
    scene.camera.fov = 2.0 * 0.25_f32.atan();
    scene
}

const FILTERS: [Filter; 3] = [Filter::Nearest, Filter::Bilinear, Filter::Mipmap];

const PLAIN: Map = Map { texture: 0, scale: Vec2::ONE, offset: Vec2::ZERO, clamp: false, strength: 1.0 };

/// The same on both sides, and nowhere what is no number.
fn holds(scene: &Scene, told: &str) {
    let film = scene_on_cpu(scene);
    let gpu = scene_on_gpu(&Sources::default(), scene).expect("a film");
    let comparison = compare(&film, &gpu, Standard::Exact).expect("one size");
    assert!(comparison.passes(), "{told}: {comparison:#?}");
    assert!((0..film.pixels()).all(|pixel| film.color(pixel).is_finite()), "{told}: a color that is no number");
}

#[test]
fn coordinates_too_large_to_lie_anywhere_are_the_same_on_both_sides() {
    let far =
        [[[3e38, 0.0], [1.0, 0.1], [1.0, 1.0], [0.0, 1.0]], [[3e38, -3e38], [-3e38, 2e38], [1e30, 1.0], [0.0; 2]]];
    let map = Map { scale: Vec2::splat(10.0), ..PLAIN };
    for (number, uvs) in far.into_iter().enumerate() {
        for (filter, clamp) in FILTERS.into_iter().flat_map(|filter| [(filter, false), (filter, true)]) {
            let mut scene = square(uvs, Map { clamp, ..map });
            (scene.raster.filter, scene.trace.filter) = (filter, filter);
            for method in [Method::Raster, Method::Trace] {
                scene.method = method;
                holds(&scene, &format!("coordinates {number}, {filter:?}, {clamp}, {method:?}"));
            }
            for show in [Show::Normal, Show::Uv] {
                (scene.method, scene.raster.show) = (Method::Raster, show);
                holds(&scene, &format!("coordinates {number}, {filter:?}, {clamp}, {show:?}"));
            }
        }
    }
}

/// A picture and as much around it on all sides: a pixel is an eighth of it.
fn in_the_middle(scale: f32) -> Scene {
    let scale = Vec2::splat(scale);
    let map = Map { scale, offset: (Vec2::ONE - scale) * 0.5, clamp: true, ..PLAIN };
    let mut scene = square([[-1.0, -1.0], [2.0, -1.0], [2.0, 2.0], [-1.0, 2.0]], map);
    (scene.method, scene.raster.show) = (Method::Raster, Show::Albedo);
    scene
}

#[test]
fn a_clamped_picture_ends_in_its_edge() {
    let mut scene = in_the_middle(1.0);
    scene.raster.filter = Filter::Nearest;
    let film = scene_on_cpu(&scene);
    let [color, _, holes] = &scene.meshes[0].model.textures[..] else { panic!("three pictures") };
    let texel = |of: &Texture, x: u32, y: u32| {
        let at = |i: u32, size: f32| (((i as f32 + 0.5) / 8.0 - 1.0) * size).clamp(0.0, size - 1.0) as usize;
        of.texels[at(y, 3.0) * 5 + at(x, 5.0)]
    };
    let (mut there, mut gone) = (0, 0);
    // Each pixel off the diagonal, on which both triangles meet; the upper one is cut out.
    for [x, y] in (0..24).flat_map(|y| (0..24).map(move |x| [x, y])).filter(|[x, y]| x + y != 23) {
        let pixel = y * 24 + x;
        if x + y < 23 && texel(holes, x, y)[3] < 128 {
            assert_eq!(film.id(pixel), NONE, "{x} {y}");
            gone += 1;
        } else {
            let [red, green, blue, _] = texel(color, x, y).map(|byte| scene.film.transfer.decode(byte));
            assert_eq!(film.color(pixel), Vec3::new(red, green, blue), "{x} {y}");
            there += 1;
        }
    }
    assert!(there > 300 && gone > 50, "{there} {gone}");
}

/// Between texels and at every level: all columns right of the picture are of one color in each row.
#[test]
fn clamped_pictures_are_the_same_on_both_sides_and_between_their_texels() {
    for (filter, scale) in FILTERS.into_iter().flat_map(|filter| [(filter, 1.0), (filter, 4.0)]) {
        let mut scene = in_the_middle(scale);
        (scene.raster.filter, scene.trace.filter) = (filter, filter);
        let film = scene_on_cpu(&scene);
        for row in 0..24 {
            let away = |x: u32| (film.color(row * 24 + 23 - x) - film.color(row * 24 + 23)).length();
            assert!((0..8.min(row)).all(|x| away(x) < 1e-3), "{filter:?}, {scale}, row {row}");
        }
        for method in [Method::Raster, Method::Trace] {
            (scene.method, scene.raster.show) = (method, Show::Color);
            holds(&scene, &format!("{filter:?}, {scale}, {method:?}"));
        }
    }
}
