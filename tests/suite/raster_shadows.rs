//! What is near a point light casts a shadow, as the ray tracer has it.

use twinlight::cpu::first::first;
use twinlight::math::Vec3;
use twinlight::prepare::{draw, prepare};
use twinlight::scene::{Light, Method, Scene, Show, Sphere, Triangle};
use twinlight::tables::DEEP;

use super::{root, scene_on_cpu, small};

/// A globe of radius 100, a light half a unit above it, and small roofs so far below the light.
fn lit(roofs: &[f32]) -> Scene {
    let mut scene = small(&root().join("scenes/stones.toml"), [9, 9], 1);
    (scene.planes, scene.method, scene.raster.show) = (Vec::new(), Method::Raster, Show::Shadow);
    scene.raster.shadow_size = 512;
    scene.spheres = vec![Sphere { center: Vec3::ZERO, radius: 100.0, material: 0 }];
    let place = Vec3::Y * 100.5;
    let roof = |&below: &f32| {
        let corner = |x: f32, z: f32| place + Vec3::new(x, -1.0, z) * below;
        let vertices = [corner(-1.0, -1.0), corner(0.0, 2.0), corner(1.0, -1.0)];
        Triangle { vertices, material: 0, uvs: Triangle::UVS }
    };
    scene.triangles = roofs.iter().map(roof).collect();
    scene.lights = vec![Light::Point { position: place, power: Vec3::ONE }];
    (scene.camera.near, scene.camera.fov) = (1e-3, 1e-3);
    scene
}

/// The share of the light that reaches the globe `x` from its highest point, by both methods.
fn seen(scene: &Scene, x: f32) -> f32 {
    let mut scene = scene.clone();
    let ground = Vec3::new(x, (1e4 - x * x).sqrt(), 0.0);
    scene.camera.position = ground + Vec3::new(0.0, 0.05, 0.2);
    scene.camera.look_at = ground;
    let traced = first(&prepare(&scene), 4..5, 4..5)[0].shadow;
    assert_eq!(scene_on_cpu(&scene).color(4 * 9 + 4).x, traced, "drawn and traced, {x} away");
    traced
}

#[test]
fn what_is_near_a_point_light_casts_a_shadow() {
    // The far side of the globe is 200 away, a thousandth of that 0.2.
    for below in [0.3, 0.15, 0.02, 0.005] {
        let scene = lit(&[below]);
        assert_eq!([0.1, 3.0].map(|x| seen(&scene, x)), [0.0, 1.0], "a roof {below} below the light");
    }
}

#[test]
fn the_bias_is_as_it_was_unless_something_is_near() {
    let bias = |roofs: &[f32]| draw(&lit(roofs)).lenses[0].bias;
    let usual = (lit(&[]).raster.bias * DEEP as f32) as u32;
    assert_eq!([bias(&[]), bias(&[0.45])], [usual; 2]);
    assert!((usual / 5..usual / 2).contains(&bias(&[0.1])), "{} of {usual}", bias(&[0.1]));
    assert!((usual / 101..usual / 99).contains(&bias(&[1e-6])), "{} of {usual}", bias(&[1e-6]));
}
