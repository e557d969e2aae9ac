//! Against the recursive tracer in f64, which shares nothing with the twins: ray by ray and picture by picture.

use twinlight::cpu::trace::aim::Ray;
use twinlight::cpu::trace::walk::{Walk, walk};
use twinlight::scene::Behavior;
use twinlight::tables::{FAR, NONE};

use super::oracle::{Recursive, pixel, vector};
use super::{Dice, on_cpu, random_scene, root, small, tables_of};

#[test]
fn every_ray_meets_what_brute_force_meets() {
    let (mut rays, mut hits, mut differ) = (0, 0, 0);
    for number in 0..200 {
        let scene = random_scene(number);
        let tables = tables_of(&scene);
        let oracle = Recursive::new(&scene, 0.0);
        let mut dice = Dice(number, 1 << 20);
        for _ in 0..500 {
            let ray = Ray { origin: dice.point(9.0), direction: dice.direction(), leaves: NONE };
            let mut stack = vec![[0; 2]; tables.deep as usize];
            let found = walk(&tables, &mut stack, ray, Walk::new(FAR), u32::MAX, false);
            let id = |hit: u32| tables.leaves.get(hit as usize).map_or(NONE, |leaf| leaf.id);
            let direction = vector(ray.direction).normalize();
            let nearest = oracle.nearest(vector(ray.origin), direction);
            let same = match nearest {
                None => found.hit == NONE,
                Some((hit, t)) => id(found.hit) == hit as u32 && (f64::from(found.t) - t).abs() < 1e-4 * t.max(1.0),
            };
            rays += 1;
            hits += u32::from(found.hit != NONE);
            differ += u32::from(!same);
        }
    }
    assert!(hits * 4 > rays, "{hits} of {rays} rays hit: that is no test");
    // Only rays that graze an edge or a sphere may be told apart by f32.
    assert!(differ <= rays / 10_000, "{differ} of {rays} rays differ");
}

#[test]
fn pictures_are_those_of_the_recursive_tracer() {
    let mut checked = 0;
    let shipped = ["room", "pyramid"].map(|name| small(&root().join(format!("scenes/{name}.toml")), [61, 43], 4));
    let random = (0..40).map(random_scene).filter(|s| s.materials.iter().all(|m| m.behavior != Behavior::Diffuse));
    for mut scene in shipped.into_iter().chain(random) {
        scene.trace.cutoff = 0.0;
        let film = on_cpu(&tables_of(&scene));
        let oracle = Recursive::new(&scene, 1e-6);
        let mut over = 0;
        for p in 0..film.pixels() {
            let (x, y) = (p % film.width(), p / film.width());
            let difference = (film.color(p).as_dvec3() - pixel(&oracle, &scene, x, y)).abs().max_element();
            over += u32::from(difference > 0.5 / 255.0);
        }
        // What is seen through many mirrors magnifies the last bit: a few pixels on edges of edges.
        assert!(over * 200 <= film.pixels(), "{over} of {} pixels differ in {:?}", film.pixels(), scene.film.size);
        checked += 1;
    }
    assert!(checked >= 5, "only {checked} pictures");
}
