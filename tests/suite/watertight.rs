//! No ray slips between triangles, and none meets again what it has just left.

use rayon::prelude::*;
use twinlight::cpu::trace::aim::Ray;
use twinlight::cpu::trace::surface::{start_of, surface_at};
use twinlight::cpu::trace::walk::{Walk, walk};
use twinlight::math::{Vec3, vector::unit};
use twinlight::prepare::prepare;
use twinlight::tables::{FAR, NONE, Tables};

use super::Dice;
use super::bvh::scene_of;

/// A sphere of triangles that share their corners to the bit: each face of an octahedron in `n` x `n`.
fn ball(n: i32, at: Vec3, radius: f32) -> Vec<[Vec3; 3]> {
    let corner = |i: i32, j: i32, sign: Vec3| {
        let flat = Vec3::new(i as f32, j as f32, (n - i - j) as f32) * sign;
        at + unit(flat) * radius
    };
    let mut all = Vec::new();
    for side in 0..8 {
        let sign = Vec3::new(
            if side & 1 == 0 { 1.0 } else { -1.0 },
            if side & 2 == 0 { 1.0 } else { -1.0 },
            if side & 4 == 0 { 1.0 } else { -1.0 },
        );
        for (i, j) in (0..n).flat_map(|i| (0..n - i).map(move |j| (i, j))) {
            all.push([corner(i, j, sign), corner(i + 1, j, sign), corner(i, j + 1, sign)]);
            if i + j + 2 <= n {
                all.push([corner(i + 1, j + 1, sign), corner(i + 1, j, sign), corner(i, j + 1, sign)]);
            }
        }
    }
    all
}

fn nearest(tables: &Tables, ray: Ray) -> Walk {
    let mut stack = vec![[0; 2]; tables.deep as usize];
    walk(tables, &mut stack, ray, Walk::new(FAR), u32::MAX, false)
}

/// How many of 200,000 rays from within a ball towards its corners and edges meet nothing.
fn leaks(triangles: &[[Vec3; 3]], at: Vec3, radius: f32) -> usize {
    let tables = prepare(&scene_of(triangles));
    let each = (0..200_u32).into_par_iter().map(|chunk| {
        let mut dice = Dice(chunk, 11);
        let rays = (0..1000).filter(|i| {
            let leaf = tables.leaves[dice.below(tables.leaves.len())];
            let along = if i % 2 == 0 { 0.0 } else { dice.unit() };
            let target = leaf.a + (leaf.b - leaf.a) * along;
            let origin = at + dice.point(0.5) * radius;
            nearest(&tables, Ray { origin, direction: target - origin, leaves: NONE }).hit == NONE
        });
        rays.count()
    });
    each.sum()
}

#[test]
fn no_ray_leaves_a_closed_ball_through_a_corner_or_an_edge() {
    for (at, radius) in
        [(Vec3::ZERO, 1.0), (Vec3::new(300.0, -20.0, 7.0), 1.0), (Vec3::ZERO, 1e-7), (Vec3::ZERO, 1e7)]
    {
        assert_eq!(leaks(&ball(40, at, radius), at, radius), 0, "of 200,000 rays at {at}, radius {radius}");
    }
}

#[test]
fn a_ball_that_is_not_closed_is_seen() {
    let mut hole = ball(40, Vec3::ZERO, 1.0);
    hole.pop();
    assert!(leaks(&hole, Vec3::ZERO, 1.0) > 0, "a triangle is missing");
    let mut dice = Dice(1, 13);
    let mut cracks = ball(40, Vec3::ZERO, 1.0);
    cracks.iter_mut().flatten().for_each(|corner| *corner += dice.point(1e-5));
    assert!(leaks(&cracks, Vec3::ZERO, 1.0) > 0, "corners are not shared to the bit");
}

#[test]
fn no_ray_meets_what_it_has_just_left() {
    for power in -8..=8 {
        let scale = 10_f32.powi(power);
        let tables = prepare(&scene_of(&ball(20, Vec3::new(0.3, -0.2, 0.7) * scale, scale)));
        let mut dice = Dice(power as u32, 12);
        let (mut rays, mut again) = (0, 0);
        for _ in 0..20_000 {
            let origin = Vec3::new(0.3, -0.2, 0.7) * scale + dice.direction() * scale * dice.within(1.5, 4.0);
            let target = Vec3::new(0.3, -0.2, 0.7) * scale + dice.point(0.7) * scale;
            let ray = Ray { origin, direction: unit(target - origin), leaves: NONE };
            let found = nearest(&tables, ray);
            if found.hit == NONE {
                continue;
            }
            let surface = surface_at(&tables, ray, found.t, found.hit, &mut ());
            let free = dice.direction();
            let out = if free.dot(surface.normal) < 0.0 { -free } else { free };
            let next = nearest(&tables, Ray { origin: start_of(&surface, out), direction: out, leaves: found.hit });
            rays += 1;
            // Nothing lies outside of a ball.
            again += usize::from(next.hit != NONE);
        }
        assert!(rays > 10_000, "{rays} rays are no test");
        assert_eq!(again, 0, "of {rays} rays at scale 1e{power}");
    }
}

/// The six sides of a cube, two triangles each.
fn cube(half: f32) -> Vec<[Vec3; 3]> {
    let corner = |i: usize| Vec3::from_array([4, 2, 1].map(|bit| if i & bit == 0 { -half } else { half }));
    let sides = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let halves = sides.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
    halves.map(|corners| corners.map(corner)).collect()
}

#[test]
fn rays_from_the_edges_of_a_room_do_not_meet_its_walls() {
    for power in -8..=8 {
        let scale = 10_f32.powi(power);
        let tables = prepare(&scene_of(&cube(5.0 * scale)));
        let mut dice = Dice(power as u32, 14);
        let mut again = 0;
        let rays = 20_000;
        for i in 0..rays {
            // A point of an edge, seen from somewhere and asked for the light from somewhere.
            let inside = |dice: &mut Dice| dice.point(4.0) * scale;
            let mut target = dice.point(5.0) * scale;
            for axis in [i % 3, (i + 1) % 3] {
                target[axis] = 5.0 * scale * if dice.within(0.0, 1.0) < 0.5 { -1.0 } else { 1.0 };
            }
            let [eye, light] = [inside(&mut dice), inside(&mut dice)];
            let ray = Ray { origin: eye, direction: target - eye, leaves: NONE };
            let found = nearest(&tables, ray);
            assert!(found.hit != NONE, "a closed room");
            let surface = surface_at(&tables, ray, found.t, found.hit, &mut ());
            let origin = start_of(&surface, surface.normal);
            let shadow = Ray { origin, direction: light - origin, leaves: found.hit };
            let mut stack = vec![[0; 2]; tables.deep as usize];
            again += usize::from(walk(&tables, &mut stack, shadow, Walk::new(1.0), u32::MAX, true).hit != NONE);
        }
        // Those that came along the other wall; without the way back along the ray there are thousands.
        assert!(again <= 200, "{again} of {rays} rays at scale 1e{power}");
    }
}
