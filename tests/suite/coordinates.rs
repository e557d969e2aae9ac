//! Texture coordinates that are too large to lie anywhere.

use std::sync::Arc;

use twinlight::film::compare::{Standard, compare};
use twinlight::gpu::wgsl::Sources;
use twinlight::math::{Vec2, Vec3};
use twinlight::scene::model::{Content, Corner, Map, Material, Model, Texture, Triangle};
use twinlight::scene::{Filter, Light, Mesh, Method, Scene, Show};

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
        for filter in [Filter::Nearest, Filter::Bilinear, Filter::Mipmap] {
            let mut scene = square(uvs, map);
            (scene.raster.filter, scene.trace.filter) = (filter, filter);
            for method in [Method::Raster, Method::Trace] {
                scene.method = method;
                holds(&scene, &format!("coordinates {number}, {filter:?}, {method:?}"));
            }
            for show in [Show::Normal, Show::Uv] {
                (scene.method, scene.raster.show) = (Method::Raster, show);
                holds(&scene, &format!("coordinates {number}, {filter:?}, {show:?}"));
            }
        }
    }
}
