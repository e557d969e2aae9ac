//! Shadows that are drawn are where the ray tracer has them, near a light and far from it.

use twinlight::cpu::first::first;
use twinlight::math::Vec3;
use twinlight::prepare::prepare;
use twinlight::scene::{Camera, Light, Method, Plane, Scene, Show, Sphere, Triangle};

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

/// A floor with cubes under a lamp that is high above it, seen from the side.
fn cubes() -> Scene {
    let mut scene = small(&root().join("scenes/stones.toml"), [81, 61], 1);
    (scene.method, scene.raster.show, scene.raster.shadow) = (Method::Raster, Show::Shadow, 0.0);
    scene.raster.shadow_size = 1024;
    (scene.spheres, scene.meshes) = (Vec::new(), Vec::new());
    scene.planes = vec![Plane { point: Vec3::ZERO, normal: Vec3::Y, material: 0, tile: 1.0 }];
    let cube = |[x, z]: [f32; 2]| {
        let corner = |i: usize| {
            let side = |bit: usize| if i >> bit & 1 == 1 { 1.0 } else { -1.0 };
            Vec3::new(x + side(0), 1.0 + side(1), z + side(2))
        };
        let sides = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
        let halves = sides.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
        let face =
            move |corners: [usize; 3]| Triangle { vertices: corners.map(corner), material: 0, uvs: Triangle::UVS };
        halves.map(face).collect::<Vec<_>>()
    };
    scene.triangles = [[-3.0, 0.0], [3.0, 3.0], [3.0, -3.0], [-8.0, 0.0], [8.0, -4.0]].map(cube).concat();
    scene.lights = vec![Light::Point { position: Vec3::new(3.0, 10.0, 0.0), power: Vec3::ONE }];
    scene.camera.position = Vec3::new(0.0, 12.0, 16.0);
    scene.camera.look_at = Vec3::new(0.0, 0.5, 0.0);
    scene.camera.fov = 0.7;
    scene
}

/// Of all pixels, the share where drawn and traced light differ, and that where the traced is less than half.
fn apart(scene: &Scene) -> [f32; 2] {
    let film = scene_on_cpu(scene);
    let [width, height] = scene.film.size;
    let traced = first(&prepare(scene), 0..width, 0..height);
    let shares = |of: &dyn Fn(usize) -> bool| traced.iter().enumerate().filter(|(i, _)| of(*i)).count() as f32;
    let drawn = |i: usize| film.color(i as u32).x;
    let differ = shares(&|i| (drawn(i) > 0.5) != (traced[i].shadow > 0.5));
    let dark = shares(&|i| traced[i].shadow < 0.5);
    [differ, dark].map(|count| count / traced.len() as f32)
}

#[test]
fn shadows_of_any_light_are_where_the_ray_tracer_has_them() {
    let mut scene = cubes();
    let looking = |position: Vec3| Camera { position, look_at: Vec3::ZERO, ..scene.camera.clone() };
    let [near, far] = [looking(Vec3::new(4.0, 14.0, 4.0)), looking(Vec3::new(12.0, 44.0, 12.0))];
    let toward = Vec3::new(12.0, 44.0, 12.0).normalize();
    let seen = |camera: &Camera, fov: f32| Camera { near: 0.1, far: 1000.0, fov, ..camera.clone() };
    let lights = [
        scene.lights[0].clone(),
        Light::Point { position: Vec3::new(-20.0, 40.0, 9.0), power: Vec3::ONE },
        Light::Directional { toward, power: Vec3::ONE, camera: None },
    ];
    for light in lights {
        scene.lights = vec![light.clone()];
        let [differ, dark] = apart(&scene);
        assert!(dark > 0.01, "{dark} lies in shadow of {light:?}");
        assert!(differ < 0.02, "{differ} differs, {light:?}");
    }
    // A roof close to a lamp: its depths begin near, and the floor reaches far.
    let place = Vec3::new(0.2, 4.0, 0.6);
    for below in [0.3, 0.02] {
        let mut near = scene.clone();
        // As far as that, one square for the whole plane would be coarser in f32 than what is near the lamp.
        near.camera.far = 1e4;
        let corner = |x: f32, z: f32| place + Vec3::new(x, -1.0, z) * below;
        let vertices = [corner(0.0, 0.0), corner(0.1, 0.4), corner(0.4, 0.0)];
        near.triangles.push(Triangle { vertices, material: 0, uvs: Triangle::UVS });
        near.lights = vec![Light::Point { position: place, power: Vec3::ONE }];
        let [differ, dark] = apart(&near);
        assert!(dark > 0.03, "{dark} lies in shadow of a roof {below} below");
        assert!(differ < 0.03, "{differ} differs, a roof {below} below");
    }
    // A light's own camera sees from one point, so its shadows are those of a lamp there.
    for (camera, fov, from) in [(&near, 1.4, 0.1), (&far, 0.6, 0.1), (&near, 1.4, 0.02)] {
        let camera = Camera { near: from, ..seen(camera, fov) };
        let power = Vec3::ONE;
        scene.lights = vec![Light::Point { position: camera.position, power }];
        let lamp = scene_on_cpu(&scene);
        scene.lights = vec![Light::Directional { toward, power, camera: Some(camera) }];
        let seen = scene_on_cpu(&scene);
        let other = (0..lamp.pixels()).filter(|&p| (lamp.color(p).x > 0.5) != (seen.color(p).x > 0.5)).count();
        assert!(other * 50 < lamp.pixels() as usize, "{other} of {} pixels", lamp.pixels());
    }
}

/// The bias is a share of what a map shows where things are: not of a floor that reaches far beyond them.
#[test]
fn small_things_cast_shadows_on_wide_floors() {
    let mut scene = cubes();
    scene.planes.clear();
    let ball = |x: f32, radius: f32| Sphere { center: Vec3::new(x, radius, 0.0), radius, material: 0 };
    scene.spheres = vec![ball(-0.7, 0.5), ball(0.6, 0.25)];
    scene.lights = vec![Light::Point { position: Vec3::new(1.0, 4.0, 1.0), power: Vec3::ONE }];
    scene.camera.position = Vec3::new(0.5, 3.0, 4.0);
    for half in [20.0, 1000.0, 4000.0] {
        let corner = |x: f32, z: f32| Vec3::new(x, 0.0, z) * half;
        let [a, b, c, d] = [corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0)];
        let face = |vertices| Triangle { vertices, material: 0, uvs: Triangle::UVS };
        scene.triangles = vec![face([a, b, c]), face([a, c, d])];
        let [differ, dark] = apart(&scene);
        assert!(dark > 0.02, "{dark} lies in shadow, half a floor is {half}");
        assert!(differ < 0.015, "{differ} differs, half a floor is {half}");
    }
}

/// A floor that is cut close to a light's own camera is off by what f32 rounds off there; the bias must be above it.
#[test]
fn floors_that_are_cut_close_to_a_light_do_not_shadow_themselves() {
    let mut scene = cubes();
    scene.planes.clear();
    let corner = |x: f32, z: f32| Vec3::new(x, 0.0, z) * 100.0;
    let [a, b, c, d] = [corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0)];
    let face = |vertices| Triangle { vertices, material: 0, uvs: Triangle::UVS };
    scene.triangles = vec![face([a, b, c]), face([a, c, d])];
    scene.spheres = vec![Sphere { center: Vec3::Y * 0.7, radius: 0.5, material: 0 }];
    scene.raster.shadow_size = 2048;
    (scene.camera.position, scene.camera.look_at) = (Vec3::new(2.0, 3.0, 5.0), Vec3::Y * 0.5);
    let position = Vec3::new(4.082_483, 8.164_966, 4.082_483);
    let camera =
        Camera { position, look_at: Vec3::ZERO, near: 0.05, far: 1000.0, fov: 0.5236, ..scene.camera.clone() };
    let toward = Vec3::new(1.0, 2.0, 1.0).normalize();
    scene.lights = vec![Light::Directional { toward, power: Vec3::ONE, camera: Some(camera) }];
    let film = scene_on_cpu(&scene);
    let dark = (0..film.pixels()).filter(|&p| film.color(p).x < 0.5).count();
    assert!(dark > 20 && dark * 10 < film.pixels() as usize, "{dark} of {} pixels", film.pixels());
}
