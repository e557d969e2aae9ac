//! A model with no scene file is seen whole.

use twinlight::cpu::first::first;
use twinlight::prepare::prepare;
use twinlight::scene::{Method, Scene, Show};

use super::{scene_on_cpu, small};

/// A floor, and a floor with a step on it.
const FLOORS: [&str; 2] = [
    "v -1 2 -1\nv 1 2 -1\nv 1 2 1\nv -1 2 1\nf 4 3 2 1\n",
    "v -9 0 -9\nv 9 0 -9\nv 9 0 9\nv -9 0 9\nv -1 1 -1\nv 1 1 -1\nv 1 1 1\nv -1 1 1\nf 4 3 2 1\nf 8 7 6 5\nf 4 3 7 8\n",
];

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
