//! Answers known on paper, each with the equation of the spec.

use glam::{DVec3, Vec2, Vec3};
use twinlight::cpu::trace::primary::primary;
use twinlight::cpu::trace::scatter::scatter;
use twinlight::cpu::trace::surface::Surface;
use twinlight::math::vector::unit;
use twinlight::scene::{Behavior, Camera, Light, Maps, Material, Plane, Scene, Sphere};
use twinlight::tables::{self, Tables};

use super::{on_cpu, root, small, tables_of};

/// An empty scene: the eye at the origin looks along -z, one sample a pixel.
fn empty() -> Scene {
    let mut scene = small(&root().join("scenes/room.toml"), [33, 21], 1);
    scene.camera = Camera { aspect: None, ..scene.camera };
    scene.spheres.clear();
    scene.planes.clear();
    scene.lights.clear();
    scene.materials = vec![Material {
        name: "m".to_owned(),
        color: Vec3::ONE,
        local: 1.0,
        reflect: 0.0,
        refract: 0.0,
        exponent: 1.0,
        index: 1.5,
        behavior: Behavior::Mirror,
        maps: Maps::default(),
    }];
    scene
}

fn close(found: Vec3, expected: Vec3, what: &str) {
    assert!(
        (found - expected).abs().max_element() <= 2e-6 * (1.0 + expected.max_element()),
        "{what}: {found} for {expected}"
    );
}

#[test]
fn section_2_2_the_corners_of_the_film_are_the_corners_of_the_view() {
    let mut scene = empty();
    scene.film.size = [40, 30];
    let view = tables_of(&scene).view;
    let half = (scene.camera.fov / 2.0).tan();
    // The lower left corner of the lower left pixel, and of the pixel in the very middle.
    close(primary(&view, 29 * 40, 0), unit(Vec3::new(-half * 4.0 / 3.0, -half, -1.0)), "lower left");
    close(primary(&view, 14 * 40 + 20, 0), Vec3::NEG_Z, "the middle");
    scene.camera.up = Vec3::X;
    let turned = tables_of(&scene).view;
    close(primary(&turned, 29 * 40, 0), unit(Vec3::new(-half, half * 4.0 / 3.0, -1.0)), "lying on its side");
}

/// The outlines of a sphere in a mirror plane `away` from the eye, and of that sphere mirrored about one 10 away.
fn mirrored(away: f32) -> [Vec<bool>; 2] {
    // A sphere seen in a mirror plane is the sphere mirrored, seen without one.
    let mut mirrored = empty();
    mirrored.film.size = [65, 43];
    mirrored.materials[0].local = 0.0;
    mirrored.materials[0].reflect = 1.0;
    mirrored.materials.push(Material {
        name: "lit".to_owned(),
        local: 1.0,
        reflect: 0.0,
        ..empty().materials[0].clone()
    });
    mirrored.planes = vec![Plane { point: Vec3::new(0.0, 0.0, -away), normal: Vec3::Z, material: 0, tile: 1.0 }];
    mirrored.spheres = vec![Sphere { center: Vec3::new(1.0, 0.5, 4.0), radius: 3.5, material: 1 }];
    mirrored.lights =
        vec![Light::Directional { toward: unit(Vec3::new(1.0, 1.0, 3.0)), power: Vec3::ONE, camera: None }];
    let mut direct = mirrored.clone();
    direct.planes.clear();
    direct.spheres[0].center.z = -24.0;
    direct.lights =
        vec![Light::Directional { toward: unit(Vec3::new(1.0, 1.0, -3.0)), power: Vec3::ONE, camera: None }];
    let outline = |scene: &Scene| {
        let mut scene = scene.clone();
        scene.film.background = Vec3::new(0.0, 0.0, 0.25);
        let film = on_cpu(&tables_of(&scene));
        (0..film.pixels()).map(|p| film.color(p).z != 0.25).collect::<Vec<_>>()
    };
    [outline(&mirrored), outline(&direct)]
}

#[test]
fn equation_2_6_a_mirror_shows_what_stands_behind_it() {
    let [found, expected] = mirrored(10.0);
    assert_eq!(found, expected);
    assert!(expected.iter().filter(|&&on| on).count() > 20);
    // The mutant: a mirror that stands a little farther off.
    let [found, _] = mirrored(10.3);
    assert_ne!(found, expected);
}

fn glass(index: f32) -> tables::Material {
    let mut scene = empty();
    let reflect = 0.25;
    scene.materials[0] =
        Material { behavior: Behavior::Glass, refract: 0.5, reflect, index, ..scene.materials[0].clone() };
    tables_of(&scene).materials[0]
}

fn bend(index: f32, inside: u32, degrees: f64) -> (Vec3, twinlight::cpu::trace::scatter::Branches) {
    let angle = degrees.to_radians();
    let direction = DVec3::new(angle.sin(), -angle.cos(), 0.0).as_vec3();
    let surface = Surface {
        point: Vec3::ZERO,
        normal: Vec3::Y,
        shading: Vec3::Y,
        material: glass(index),
        specular: Vec3::ONE,
        margin: 0.0,
        back: Vec3::ZERO,
    };
    (direction, scatter(direction, inside, &surface, Vec2::splat(0.5)))
}

#[test]
fn equation_2_7_is_snells_law() {
    for index in [1.0, 1.33, 1.5, 2.4] {
        for degrees in [0.0, 10.0, 30.0, 41.0, 60.0, 89.0_f64] {
            for inside in [0, 1] {
                let ratio = if inside == 1 { f64::from(index) } else { 1.0 / f64::from(index) };
                let sine = degrees.to_radians().sin() * ratio;
                if sine >= 0.999 {
                    continue;
                }
                let (_, branches) = bend(index, inside, degrees);
                let expected = DVec3::new(sine, -(1.0 - sine * sine).sqrt(), 0.0);
                close(branches.refracted.direction, expected.as_vec3(), "the refracted ray");
                // The mutant: glass that is a little denser.
                let (_, denser) = bend(index * 1.001, inside, degrees);
                let off = (denser.refracted.direction - expected.as_vec3()).length();
                assert!(degrees == 0.0 || off > 1e-5, "{off} at {degrees} degrees");
                assert_eq!(branches.refracted.inside, 1 - inside);
                assert_eq!((branches.refracted.weight.x, branches.reflected.weight.x), (0.5, 0.25));
            }
        }
    }
}

#[test]
fn beyond_the_critical_angle_everything_is_reflected() {
    for index in [1.33_f32, 1.5, 2.4] {
        let critical = (1.0 / f64::from(index)).asin().to_degrees();
        let (_, below) = bend(index, 1, critical - 0.01);
        assert_eq!((below.refracted.weight.x, below.reflected.weight.x), (0.5, 0.25), "just below {critical}");
        assert!(below.refracted.direction.y > -0.05, "it leaves along the surface");
        let (direction, beyond) = bend(index, 1, critical + 0.01);
        assert_eq!((beyond.refracted.weight.x, beyond.reflected.weight.x), (0.0, 0.75), "just beyond {critical}");
        assert_eq!(beyond.reflected.inside, 1, "the ray goes on inside");
        // The mutant: the same angle in glass that is a little thinner.
        let (_, thinner) = bend(index * 0.999, 1, critical + 0.01);
        assert_eq!(thinner.refracted.weight.x, 0.5, "its critical angle lies beyond");
        close(beyond.reflected.direction, Vec3::new(direction.x, -direction.y, 0.0), "the mirror direction");
    }
}

type Mutant = fn(&mut Tables);

/// The largest error of a furnace: a lamp and the eye in the middle of a mirror sphere.
///
/// Every ray from the middle comes back to it: each hit sees lamp and eye along its normal, so both terms are 1, and
/// the sum over d rays is 2 local (1 + r + ... + r^(d-1)).
fn furnace(depth: u32, reflect: f32, fault: impl Fn(&mut Tables)) -> f32 {
    let mut scene = empty();
    scene.trace.depth = depth;
    scene.trace.cutoff = 0.0;
    scene.materials[0].local = 0.1;
    scene.materials[0].reflect = reflect;
    scene.spheres = vec![Sphere { center: Vec3::ZERO, radius: 3.0, material: 0 }];
    scene.lights = vec![Light::Point { position: Vec3::ZERO, power: Vec3::new(0.5, 1.0, 0.25) }];
    let sum: f64 = (0..depth).map(|k| f64::from(reflect).powi(k as i32)).sum();
    let expected = Vec3::new(0.5, 1.0, 0.25) * (0.2 * sum) as f32;
    let mut tables = tables_of(&scene);
    fault(&mut tables);
    let film = on_cpu(&tables);
    let error = |p: u32| (film.color(p) - expected).abs().max_element() / (1.0 + expected.max_element());
    (0..film.pixels()).map(error).fold(0.0, f32::max)
}

#[test]
fn the_furnace_a_lamp_in_the_middle_of_a_mirror_sphere() {
    for depth in [1, 2, 6, 20] {
        for reflect in [0.0, 0.5, 0.9] {
            let error = furnace(depth, reflect, |_| ());
            assert!(error <= 2e-6, "{error} at depth {depth}, reflecting {reflect}");
        }
    }
    let mutants: [(&str, Mutant); 5] = [
        ("a lamp beside the middle", |t| t.lights[0].place.x = 0.05),
        ("a weaker lamp", |t| t.lights[0].power *= 0.9999),
        ("a mirror that takes more", |t| t.materials[0].reflect_weight *= 0.9999),
        ("a ray less", |t| t.settings.max_depth -= 1),
        ("a brighter highlight", |t| t.materials[0].local_weight *= 1.0001),
    ];
    for (what, mutant) in mutants {
        assert!(furnace(6, 0.5, mutant) > 1e-5, "{what} goes unnoticed");
    }
}

#[test]
fn figure_1_11_lamberts_cosine_and_phongs_lobe_on_a_plane() {
    let mut scene = empty();
    scene.materials[0].exponent = 7.0;
    scene.planes = vec![Plane { point: Vec3::new(0.0, 0.0, -5.0), normal: Vec3::Z, material: 0, tile: 1.0 }];
    scene.lights = vec![Light::Point { position: Vec3::new(1.0, 2.0, 3.0), power: Vec3::ONE }];
    for specular in [twinlight::scene::Specular::Phong, twinlight::scene::Specular::Blinn] {
        scene.trace.specular = specular;
        let tables = tables_of(&scene);
        let film = on_cpu(&tables);
        for p in 0..film.pixels() {
            let d = primary(&tables.view, p, 0).as_dvec3();
            let point = d * (-5.0 / d.z);
            let l = (DVec3::new(1.0, 2.0, 3.0) - point).normalize();
            let lobe = match specular {
                twinlight::scene::Specular::Phong => DVec3::new(-l.x, -l.y, l.z).dot(-d),
                twinlight::scene::Specular::Blinn => (l - d).normalize().z,
            };
            let expected = l.z + lobe.max(0.0).powi(7);
            assert!((f64::from(film.color(p).x) - expected).abs() < 1e-5, "{specular:?} at {p}");
        }
    }
}

#[test]
fn a_shadow_ends_where_geometry_says() {
    // A sphere of radius 1 halfway between a lamp and a wall: its shadow is a disk of radius 2 / sqrt(1 - 1/25).
    let mut scene = empty();
    scene.film.size = [201, 151];
    scene.planes = vec![Plane { point: Vec3::new(0.0, 0.0, -10.0), normal: Vec3::Z, material: 0, tile: 1.0 }];
    scene.spheres = vec![Sphere { center: Vec3::new(0.0, 8.0, -5.0), radius: 1.0, material: 0 }];
    scene.lights = vec![Light::Point { position: Vec3::new(0.0, 8.0, 0.0), power: Vec3::ONE }];
    scene.camera.position = Vec3::new(0.0, 0.0, 20.0);
    scene.camera.look_at = Vec3::new(0.0, 8.0, -10.0);
    let tables = tables_of(&scene);
    let film = on_cpu(&tables);
    let edge = 10.0 * (1.0 / 5.0_f64).asin().tan();
    let mut dark = 0;
    for p in (0..film.pixels()).filter(|&p| film.id(p) == 1) {
        let d = primary(&tables.view, p, 0).as_dvec3();
        let eye = scene.camera.position.as_dvec3();
        let point = eye + d * ((-10.0 - eye.z) / d.z);
        let from_middle = (point - DVec3::new(0.0, 8.0, -10.0)).length();
        if (from_middle - edge).abs() > 1e-4 {
            assert_eq!(film.color(p).x == 0.0, from_middle < edge, "{from_middle} of {edge}");
        }
        dark += u32::from(film.color(p).x == 0.0);
    }
    assert!(dark > 50, "{dark}");
}

#[test]
fn a_diffuse_path_brings_half_of_the_tinted_light() {
    // Under an even sky and with nothing to meet, the mean of cos over a hemisphere is 1/2, whatever its axis.
    let mut scene = empty();
    scene.film.background = Vec3::new(1.0, 0.5, 0.25);
    scene.film.size = [9, 7];
    scene.trace.samples = 4096;
    scene.trace.depth = 2;
    scene.trace.cutoff = 0.0;
    let color = Vec3::new(0.9, 0.6, 0.3);
    scene.materials[0] =
        Material { behavior: Behavior::Diffuse, reflect: 0.8, local: 0.0, color, ..scene.materials[0].clone() };
    scene.spheres = vec![Sphere { center: Vec3::new(0.0, 0.0, -2.0), radius: 0.02, material: 0 }];
    scene.camera.fov = 0.017;
    let film = on_cpu(&tables_of(&scene));
    let p = film.pixels() / 2;
    assert_eq!(film.id(p), 0);
    // A path that starts into the sphere meets its inside and ends there, at depth 2: also in the background's light.
    let expected = color.normalize() * 0.8 * 0.5 * scene.film.background;
    let error = (film.color(p) - expected).abs() / expected;
    // The cosine's deviation is 0.289: 4096 samples make 0.9 %, and 3 of these are allowed.
    assert!(error.max_element() < 0.027, "{} for {expected}", film.color(p));
}

#[test]
fn depth_counts_rays() {
    // Between two mirrors each ray adds one wall's light: depth d shows d of them.
    for depth in [1, 2, 3, 6] {
        let mut scene = empty();
        scene.trace.depth = depth;
        scene.materials[0].reflect = 1.0;
        scene.materials[0].local = 0.5;
        scene.materials[0].exponent = 0.0;
        scene.film.size = [1, 1];
        let wall = |z: f32| Plane {
            point: Vec3::new(0.0, 0.0, z),
            normal: Vec3::new(0.0, 0.0, -z.signum()),
            material: 0,
            tile: 1.0,
        };
        scene.planes = vec![wall(-1.0), wall(1.0)];
        scene.lights = vec![Light::Point { position: Vec3::ZERO, power: Vec3::ONE }];
        scene.camera.fov = 0.02;
        scene.camera.look_at = Vec3::NEG_Z;
        // The lower left corner of the only pixel is a hundredth off the axis: cosine 1 - 5e-5 at most per ray.
        let color = on_cpu(&tables_of(&scene)).color(0).x;
        assert!((color - depth as f32).abs() < 0.02 * depth as f32, "{color} at depth {depth}");
    }
}
