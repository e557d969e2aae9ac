//! Eight walks side by side: each must find what it finds alone, to the bit.

use rayon::prelude::*;
use twinlight::cpu::trace::aim::Ray;
use twinlight::cpu::trace::walk::Walk;
use twinlight::cpu::{Walker, Wides};
use twinlight::prepare::bvh::Halves;
use twinlight::prepare::{prepare, prepare_with};
use twinlight::tables::{FAR, NONE, Tables};

use super::bvh::{bust, deep, ray, scene_of, soup};
use super::instances::{crowded, ray_at_instance};
use super::trace_lace::laced;
use super::{Dice, root, small};

/// Up to eight rays that start near each other and go about the same way; one in eight leaves what the first does.
fn herd(dice: &mut Dice, first: Ray, tables: &Tables) -> Vec<Ray> {
    let size = (tables.settings.high - tables.settings.low).max_element();
    let [apart, askew] = [10_f32.powf(dice.within(-6.0, -1.0)), 10_f32.powf(dice.within(-6.0, -1.0))];
    let length = first.direction.length();
    let others = 1 + dice.below(7);
    let mut all = vec![first];
    all.extend((0..others).map(|_| Ray {
        origin: first.origin + dice.point(1.0) * size * apart,
        direction: first.direction + dice.point(1.0) * length * askew,
        leaves: if dice.below(8) == 0 { first.leaves } else { NONE },
    }));
    all
}

/// What lets rays be walked together: the signs of their directions and the longest axis.
fn way(ray: &Ray) -> [bool; 5] {
    let d = ray.direction;
    let size = d.abs();
    [d.x < 0.0, d.y < 0.0, d.z < 0.0, size.x > size.y && size.x > size.z, size.y > size.z]
}

#[derive(Debug, Default)]
struct Tally {
    herds: usize,
    alike: usize,
    hits: usize,
    differ: usize,
}

fn compare_herds(tables: &Tables, ray: impl Fn(&mut Dice) -> Ray + Sync, seed: u32, herds: usize) -> Tally {
    let wides = Wides::new(tables);
    let tally = |chunk: usize| {
        let mut dice = Dice(seed, 45 << 16 | chunk as u32);
        let mut walker = Walker::new(tables, &wides);
        let mut tally = Tally::default();
        for _ in 0..herds / 8 {
            let first = ray(&mut dice);
            let rays = herd(&mut dice, first, tables);
            let any = dice.below(2) == 0;
            let mut start = |ray: &Ray| {
                let whole = walker.walk(*ray, Walk::new(FAR), false);
                let known = Walk { hit: whole.hit, ..Walk::new(whole.t) };
                match dice.below(6) {
                    0 => Walk::new(whole.t),
                    1 => Walk::new(whole.t.next_up().min(FAR)),
                    2 if !any || whole.hit != NONE => known,
                    _ => Walk::new(FAR),
                }
            };
            let starts: Vec<Walk> = rays.iter().map(&mut start).collect();
            let mut found = starts.clone();
            walker.walk_all(&rays, &mut found, any);
            tally.herds += 1;
            tally.alike += usize::from(rays.len() > 1 && rays.iter().all(|ray| way(ray) == way(&rays[0])));
            for ((ray, start), found) in rays.iter().zip(&starts).zip(&found) {
                let alone = walker.walk(*ray, *start, any);
                let same = if any {
                    (alone.hit == NONE) == (found.hit == NONE)
                } else {
                    alone.hit == found.hit && alone.t.to_bits() == found.t.to_bits()
                };
                tally.differ += usize::from(!same || !found.over(tables, any) || found.flags != 0);
                tally.hits += usize::from(alone.hit != NONE);
            }
        }
        tally
    };
    let add = |a: Tally, b: Tally| Tally {
        herds: a.herds + b.herds,
        alike: a.alike + b.alike,
        hits: a.hits + b.hits,
        differ: a.differ + b.differ,
    };
    (0..8).into_par_iter().map(tally).reduce(Tally::default, add)
}

fn check(name: &str, tally: &Tally) {
    assert!(tally.alike * 2 > tally.herds && tally.hits > tally.herds, "{name}: {tally:?}: that is no test");
    assert_eq!(tally.differ, 0, "{name}: {tally:?}");
}

#[test]
fn a_herd_of_rays_finds_what_each_finds_alone() {
    let meshes = [("soup", soup(1, 400)), ("deep", deep()), ("bust", bust(1))];
    for (i, (name, corners)) in meshes.into_iter().enumerate() {
        let scene = scene_of(&corners);
        for tables in [prepare(&scene), prepare_with(&scene, &Halves)] {
            check(name, &compare_herds(&tables, |dice| ray(dice, &tables), i as u32, 40_000));
        }
    }
}

#[test]
fn a_herd_finds_planes_spheres_holes_and_backs() {
    let tables = prepare(&small(&root().join("scenes/room.toml"), [9, 7], 1));
    check("room", &compare_herds(&tables, |dice| ray(dice, &tables), 7, 20_000));
    for number in 0..6 {
        let tables = prepare(&laced(number));
        check("laced", &compare_herds(&tables, |dice| ray(dice, &tables), number, 10_000));
    }
}

#[test]
fn a_herd_finds_instances() {
    for number in 0..6 {
        let tables = prepare(&crowded(number));
        check("crowd", &compare_herds(&tables, |dice| ray_at_instance(dice, &tables), number, 10_000));
    }
}
