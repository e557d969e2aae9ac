//! An eye inside of glass sees what is outside of it.

use twinlight::gpu::wgsl::Sources;
use twinlight::math::Vec3;
use twinlight::scene::{Behavior, Light, Material, Scene, Sphere, Triangle};

use super::{on_cpu, on_gpu, root, small, tables_of};

/// The eye at the origin, a lit ball before it, and a material of glass that bends as much as its index says.
fn world(index: f32) -> Scene {
    let mut scene = small(&root().join("scenes/room.toml"), [33, 21], 1);
    let matte = Material { reflect: 0.0, refract: 0.0, local: 1.0, exponent: 1.0, ..scene.materials[0].clone() };
    let glass = Material { behavior: Behavior::Glass, refract: 1.0, local: 0.0, index, ..matte.clone() };
    scene.materials = vec![matte, glass];
    (scene.planes, scene.triangles) = (Vec::new(), Vec::new());
    scene.film.background = Vec3::new(0.1, 0.2, 0.3);
    (scene.camera.position, scene.camera.look_at, scene.camera.up) = (Vec3::ZERO, Vec3::NEG_Z, Vec3::Y);
    scene.spheres = vec![Sphere { center: Vec3::new(0.5, 0.0, -6.0), radius: 1.5, material: 0 }];
    scene.lights = vec![Light::Directional { toward: Vec3::Y, power: Vec3::ONE, camera: None }];
    scene
}

/// How far the picture of a scene is from that of `world`, at most; the same on both sides.
fn apart(scene: &Scene) -> f32 {
    let [with, without] = [scene, &world(1.0)].map(|scene| on_cpu(&tables_of(scene)));
    assert!(on_gpu(&Sources::default(), &tables_of(scene)).expect("a film") == with, "both sides");
    let differ = |pixel| (with.color(pixel) - without.color(pixel)).abs().max_element();
    (0..with.pixels()).map(differ).fold(0.0, f32::max)
}

fn ball(scene: &mut Scene, center: Vec3, radius: f32) {
    scene.spheres.push(Sphere { center, radius, material: 1 });
}

/// The walls of a cube of glass around the origin, without the last of so many halves.
fn cube(scene: &mut Scene, missing: usize) {
    let corner = |i: usize| Vec3::from_array([0, 1, 2].map(|bit| if i >> bit & 1 == 1 { 1.0 } else { -1.0 }));
    let sides = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let halves = sides.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
    let face = |corners: [usize; 3]| Triangle { vertices: corners.map(corner), material: 1, uvs: Triangle::UVS };
    scene.triangles = halves.map(face).take(12 - missing).collect();
}

#[test]
fn from_the_middle_of_a_ball_of_glass_nothing_is_bent() {
    for few in [true, false] {
        let mut scene = world(1.5);
        ball(&mut scene, Vec3::ZERO, 2.0);
        if !few {
            // A triangle behind the eye: the scene is no longer one of few things.
            let vertices = [Vec3::new(0.0, 0.0, 9.0), Vec3::new(1.0, 0.0, 9.0), Vec3::new(0.0, 1.0, 9.0)];
            scene.triangles = vec![Triangle { vertices, material: 0, uvs: Triangle::UVS }];
        }
        let tables = tables_of(&scene);
        assert_eq!((tables.view.inside, tables.few), (1, few));
        assert!(apart(&scene) < 2e-2, "{}", apart(&scene));
    }
}

#[test]
fn walls_of_glass_have_an_inside_if_they_are_closed() {
    let mut scene = world(1.0);
    cube(&mut scene, 0);
    assert_eq!(tables_of(&scene).view.inside, 1);
    assert!(apart(&scene) < 1e-5, "{}", apart(&scene));
    // One in another: what enters both is outside again.
    ball(&mut scene, Vec3::ZERO, 3.0);
    assert_eq!(tables_of(&scene).view.inside, 0);
    scene.spheres.pop();
    scene.camera.position = Vec3::new(0.0, 0.0, 1.5);
    assert_eq!(tables_of(&scene).view.inside, 0, "before the cube");
    scene.camera.position = Vec3::ZERO;
    cube(&mut scene, 10);
    assert_eq!(tables_of(&scene).view.inside, 0, "a pane");
    scene.materials[1].behavior = Behavior::Mirror;
    cube(&mut scene, 0);
    assert_eq!(tables_of(&scene).view.inside, 0, "no glass");
}
