//! A model with no scene file is seen whole.

use std::f32::consts::{PI, TAU};

use twinlight::cpu::first::first;
use twinlight::math::Vec3;
use twinlight::prepare::prepare;
use twinlight::scene::{Method, Scene, Show};

use super::{scene_on_cpu, small};

/// A floor, and a floor with a step on it.
const FLOORS: [&str; 2] = [
    "v -1 2 -1\nv 1 2 -1\nv 1 2 1\nv -1 2 1\nf 4 3 2 1\n",
    "v -9 0 -9\nv 9 0 -9\nv 9 0 9\nv -9 0 9\nv -1 1 -1\nv 1 1 -1\nv 1 1 1\nv -1 1 1\nf 4 3 2 1\nf 8 7 6 5\nf 4 3 7 8\n",
];

/// A ball and a post beside it, of any size.
fn ball(size: f32) -> String {
    let around = (0..=12).flat_map(|j| (0..24).map(move |i| (i as f32 * TAU / 24.0, j as f32 * PI / 12.0)));
    let ball = around.map(|(i, j)| Vec3::new(j.sin() * i.cos(), j.cos(), -j.sin() * i.sin()));
    let post = [[1.2, -1.0, 0.0], [1.5, -1.0, 0.0], [1.2, 1.0, 0.3]].map(Vec3::from_array);
    let corners = ball.chain(post).map(|p| p * size).map(|p| format!("v {:e} {:e} {:e}\n", p.x, p.y, p.z));
    let squares = (0..24).flat_map(|i| (0..12).map(move |j| [j * 24 + i + 1, j * 24 + (i + 1) % 24 + 1]));
    let faces = squares.map(|[a, b]| format!("f {a} {} {} {b}\n", a + 24, b + 24));
    corners.chain(faces).chain(["f 313 314 315\n".to_owned()]).collect()
}

#[test]
fn a_model_of_any_size_is_seen_alike() {
    let folder = tempfile::tempdir().expect("a folder");
    let seen = |size: f32, method: Method| {
        let path = folder.path().join(format!("{size:e}.obj"));
        std::fs::write(&path, ball(size)).expect("a model");
        scene_on_cpu(&Scene { method, ..small(&path, [81, 61], 1) })
    };
    for method in [Method::Trace, Method::Raster] {
        let wanted = seen(1.0, method);
        for power in [-12, -9, -7, -4, 4, 7, 9, 11] {
            let found = seen(10_f32.powi(power), method);
            // Edges and the spots of maps of shadows differ by rounding.
            let differ = |&p: &u32| wanted.color(p).distance(found.color(p)) > 0.02;
            let differ = (0..wanted.pixels()).filter(differ).count();
            assert!(differ < 50, "{differ} of {} pixels at 1e{power}, {method:?}", wanted.pixels());
        }
    }
}

fn drawn(scene: &Scene) -> Vec<[u32; 3]> {
    let film = scene_on_cpu(scene);
    (0..film.pixels()).map(|p| film.color(p).to_array().map(f32::to_bits)).collect()
}

#[test]
fn the_ground_hides_nothing_of_a_floor() {
    let folder = tempfile::tempdir().expect("a folder");
    for (i, floor) in FLOORS.iter().enumerate() {
        let path = folder.path().join(format!("{i}.obj"));
        std::fs::write(&path, floor).expect("a model");
        let with = Scene { method: Method::Raster, ..small(&path, [81, 61], 1) };
        let mut without = with.clone();
        without.planes.clear();
        let depths = |scene: &Scene| first(&prepare(scene), 0..81, 0..61).into_iter().map(|seen| seen.depth);
        let near: Vec<(f32, f32)> =
            depths(&without).zip(depths(&with)).filter(|(model, _)| model.is_finite()).collect();
        assert!(near.len() > 300, "model {i} is seen in {} pixels", near.len());
        let hidden = near.iter().filter(|(model, all)| model != all).count();
        assert_eq!(hidden, 0, "of {} pixels of model {i}, traced", near.len());
        let colors = [&with, &without].map(|scene| {
            let mut scene = scene.clone();
            scene.raster.show = Show::Albedo;
            drawn(&scene)
        });
        let nothing = drawn(&Scene { meshes: Vec::new(), ..without.clone() });
        let hidden = colors[0].iter().zip(&colors[1]).zip(&nothing);
        let hidden = hidden.filter(|((all, model), none)| model != none && all != model).count();
        assert_eq!(hidden, 0, "pixels of model {i}, drawn");
    }
}
