//! Faces on the same corners, in any order and either way round: a ray meets them at one distance to the bit, and the
//! first of them is seen.

use std::sync::Arc;

use twinlight::film::Film;
use twinlight::gpu::wgsl::Sources;
use twinlight::math::Vec3;
use twinlight::scene::model::{Corner, Material, Model, NONE, Triangle};
use twinlight::scene::{Mesh, Scene};
use twinlight::tables::{INSTANCE, NONE as NOTHING};

use super::bvh::{scene_of, soup};
use super::{Dice, on_cpu, on_gpu, tables_of};

const FACES: usize = 40;
const TURNS: [[usize; 3]; 6] = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]];

/// Faces of every size, and then each of them twice more, its corners in another order.
fn coats(number: u32) -> Vec<[Vec3; 3]> {
    let mut dice = Dice(number, 71);
    let soup = soup(number, FACES);
    let again: Vec<_> =
        (0..2 * FACES).map(|i| TURNS[dice.below(6)].map(|corner| soup[i % FACES][corner])).collect();
    [soup, again].concat()
}

/// In the world, alone as a mesh, or as a model in three places.
fn coated(number: u32, meshes: usize) -> Scene {
    let faces = coats(number);
    let mut scene = scene_of(if meshes == 0 { &faces } else { &[] });
    scene.resize([151, 117]).expect("a small film fits");
    scene.camera.position = Vec3::new(0.4, 0.6, 1.5);
    scene.camera.look_at = Vec3::ZERO;
    let corner = |i: usize| Corner { position: i as u32, uv: NONE, normal: (i / 3) as u32 };
    let model = Arc::new(Model {
        positions: faces.concat(),
        normals: faces.iter().map(|[a, b, c]| (b - a).cross(c - a).normalize_or(Vec3::X)).collect(),
        triangles: (0..faces.len())
            .map(|i| Triangle { corners: [0, 1, 2].map(|k| corner(3 * i + k)), material: 0, group: 0 })
            .collect(),
        materials: vec![Material::named("plain")],
        groups: vec![String::new()],
        ..Model::default()
    });
    let mut dice = Dice(number, 72);
    scene.meshes = (0..meshes)
        .map(|_| Mesh { rotate: dice.point(90.0), translate: dice.point(0.5), ..Mesh::of(model.clone()) })
        .collect();
    scene
}

/// How many pixels show a face, and how many of these one that comes after another on the same corners.
fn seen(film: &Film) -> [usize; 2] {
    let ids = (0..film.pixels()).map(|p| film.id(p)).filter(|&id| id != NOTHING);
    let after = |&id: &u32| id as usize % (3 * FACES) >= FACES;
    [ids.clone().count(), ids.filter(after).count()]
}

#[test]
fn of_faces_on_the_same_corners_the_first_is_seen() {
    let mut all = 0;
    for number in 0..12 {
        let meshes = [0, 1, 3][number as usize % 3];
        let tables = tables_of(&coated(number, meshes));
        assert_eq!(tables.leaves.iter().any(|leaf| leaf.kind == INSTANCE), meshes == 3, "{meshes} meshes");
        for (side, film) in
            [("CPU", on_cpu(&tables)), ("GPU", on_gpu(&Sources::default(), &tables).expect("a film"))]
        {
            let [shown, after] = seen(&film);
            all += shown;
            assert_eq!(after, 0, "of {shown} pixels of scene {number} on the {side}");
        }
    }
    assert!(all > 20_000, "only {all} pixels show a face");
}
