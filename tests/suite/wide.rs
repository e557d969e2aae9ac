//! Small things on a ground that is far larger, by both methods.

use glam::Quat;
use twinlight::cpu::first::first;
use twinlight::explain::{Explainer, Samples};
use twinlight::math::Vec3;
use twinlight::prepare::{SPHERE_FACES, draw, sphere_faces};
use twinlight::scene::{Light, Maps, Mesh, Method, Reach, Scene, Show, Sphere, Triangle};
use twinlight::tables::Lens;

use super::agree::{alike, centered, found, traced_id};
use super::{root, scene_on_cpu, small};

/// Balls on a ground that is a sphere or a triangle a thousand times as large as they, under a sun; `up`: from the ground's
/// middle to the balls.
fn wide_ground(up: Vec3, round: bool) -> Scene {
    let mut scene = small(&root().join("scenes/stones.toml"), [199, 131], 1);
    let turn = Quat::from_rotation_arc(Vec3::Y, up);
    let at = |x: f32, y: f32, z: f32| turn * Vec3::new(x, y, z);
    let ball = |x: f32, z: f32, radius: f32| Sphere { center: at(x, radius, z), radius, material: 0 };
    scene.meshes.clear();
    scene.planes.clear();
    scene.triangles.clear();
    scene.spheres = vec![ball(-1.2, 0.0, 1.0), ball(1.2, 0.3, 1.0), ball(0.4, 2.0, 0.25)];
    if round {
        scene.spheres.push(Sphere { center: at(0.0, -1000.0, 0.0), radius: 1000.0, material: 0 });
    } else {
        let vertices = [at(-3000.0, 0.0, -2000.0), at(0.0, 0.0, 4000.0), at(3000.0, 0.0, -2000.0)];
        scene.triangles = vec![Triangle { vertices, material: 0, uvs: Triangle::UVS }];
    }
    (scene.camera.position, scene.camera.look_at) = (at(6.0, 2.6, 7.0), at(0.0, 0.6, 0.0));
    (scene.camera.up, scene.camera.fov) = (up, 0.61);
    (scene.camera.near, scene.camera.far) = (0.1, 5000.0);
    scene.lights =
        vec![Light::Directional { toward: at(0.4, 0.7, 0.5).normalize(), power: Vec3::ONE, camera: None }];
    scene.materials.truncate(1);
    scene.materials[0].maps = Maps::default();
    alike(scene)
}

/// A sphere as large as a ground has finer faces under what stands on it, and a sun a map for what is small.
#[test]
fn things_on_a_wide_ground_look_the_same_by_both_methods() {
    for up in [Vec3::Y, Vec3::NEG_Y, Vec3::X, Vec3::new(0.3, 0.1, -0.9).normalize(), Vec3::new(0.002, 1.0, 0.001)] {
        for round in [true, false] {
            let scene = wide_ground(up.normalize(), round);
            let faces = sphere_faces(&scene);
            assert!(faces[..3] == [SPHERE_FACES; 3] && (!round || faces[3] > SPHERE_FACES), "{faces:?}");
            let found = found(&scene, &centered(&scene));
            assert!(found.agrees() && found.alike * 20 > found.inner * 19, "{up}, round {round}: {found:?}");
            let [dark, other] = shadows_on(&scene, 3);
            assert!(dark > 150 && other * 4 < dark, "{up}, round {round}: {other} beside {dark} pixels in shadow");
        }
    }
}

/// In how many pixels that show a thing, by its traced number, no light reaches it as it is traced, and in how many that
/// is otherwise as it is drawn.
fn shadows_on(scene: &Scene, thing: u32) -> [usize; 2] {
    let mut shown = scene.clone();
    (shown.method, shown.raster.show) = (Method::Raster, Show::Shadow);
    let open = scene_on_cpu(&shown);
    let [width, height] = scene.film.size;
    let met = first(&centered(scene), 0..width, 0..height);
    let there = |p: &usize| traced_id(scene, open.ids()[*p]) == thing;
    let pixels = || (0..met.len()).filter(there);
    let dark = pixels().filter(|&p| met[p].shadow == 0.0).count();
    [dark, pixels().filter(|&p| (open.color(p as u32).x > 0.5) != (met[p].shadow > 0.5)).count()]
}

/// Which lenses the lights of a scene on a wide ground have, as [width, what it spans in world space].
fn spans(scene: &Scene) -> Vec<[f32; 2]> {
    let across = |lens: &Lens| 2.0 / lens.x.truncate().length();
    draw(scene).lenses.iter().map(|lens| [lens.width as f32, across(lens)]).collect()
}

#[test]
fn the_map_of_small_things_is_of_the_things_on_the_ground_and_takes_nobodys_room() {
    let wide = wide_ground(Vec3::Y, true);
    let [small, all] = spans(&wide)[..] else { panic!("a sun has two maps") };
    assert!(small[1] < 10.0 && all[1] > 2000.0 && small[0] == 2048.0 && all[0] == 2048.0, "{small:?} {all:?}");
    // A speck beside them, or a sky around all of it, makes no other things small.
    for extra in [(Vec3::new(0.5, 0.0, 0.0), 1e-3), (Vec3::ZERO, 8e3)] {
        let mut scene = wide.clone();
        scene.spheres.push(Sphere { center: extra.0, radius: extra.1, material: 0 });
        assert!((spans(&scene)[0][1] - small[1]).abs() < 0.1, "{extra:?}: {:?}", spans(&scene));
    }
    // Six maps of a lamp and one of each sun fill the room: the suns' are smaller then, and the lamp's are not.
    let mut scene = wide.clone();
    scene.lights.insert(0, Light::Point { position: Vec3::new(2.0, 5.0, 1.0), power: Vec3::ONE });
    scene.lights.push(scene.lights[1].clone());
    let sides: Vec<f32> = spans(&scene).iter().map(|span| span[0]).collect();
    assert_eq!(sides, [[2048.0; 6].to_vec(), [1024.0; 4].to_vec()].concat());
    // Seventeen suns have a map each, as there is no room for two.
    scene.lights = vec![wide.lights[0].clone(); 17];
    assert_eq!(spans(&scene).len(), 17);
}

#[test]
fn what_is_small_is_found_beside_what_does_not_count() {
    let wide = wide_ground(Vec3::Y, true);
    let faces = sphere_faces(&wide)[3];
    let [small, _] = spans(&wide)[..] else { panic!("a sun has two maps") };
    // A marble on a ball: the ball is wide beside it, and the ground beside both.
    let mut scene = wide.clone();
    scene.spheres[0] = Sphere { center: Vec3::new(1.2, 2.05, 0.3), radius: 0.05, material: 0 };
    scene.spheres.remove(2);
    let [marble, ball, ground] = sphere_faces(&scene)[..] else { panic!("three spheres") };
    assert!(marble == SPHERE_FACES && ball > SPHERE_FACES && ground.abs_diff(faces) < faces / 8, "{ball} {ground}");
    // A corner of a model that no face uses.
    let mut scene = wide.clone();
    let mut bust = small_bust();
    let mut model = (*bust.model).clone();
    let before = bust.corners().count();
    model.positions.push(Vec3::splat(1e6));
    bust.model = std::sync::Arc::new(model);
    assert_eq!(bust.corners().count(), before);
    scene.meshes.push(bust);
    assert!(sphere_faces(&scene)[3] > SPHERE_FACES && spans(&scene)[0][1] < 2.0 * small[1]);
    // A ground so large that nothing beside it can be told apart from what is rounded off.
    let mut scene = wide_ground(Vec3::Y, false);
    scene.triangles[0].vertices.iter_mut().for_each(|corner| *corner *= 100.0);
    assert_eq!(spans(&scene).len(), 1);
}

/// An explained shadow names the map that was asked.
#[test]
fn which_of_a_suns_maps_is_asked_is_told() {
    let explainer =
        Explainer::new(&wide_ground(Vec3::Y, false), Method::Raster, &Reach::default()).expect("an explainer");
    let map = |pixel| {
        let Samples::Raster(samples) = explainer.pixel(pixel).expect("a pixel").samples else {
            panic!("it is drawn")
        };
        samples[0].seen.as_ref().and_then(|seen| seen.lights[0].shadow.as_ref()).map(|shadow| shadow.map)
    };
    assert_eq!([map([99, 65]), map([5, 40]), map([99, 2])], [Some("small things"), Some("all"), None]);
}

fn small_bust() -> Mesh {
    small(&root().join("scenes/bust.toml"), [8, 8], 1).meshes.swap_remove(0)
}
