//! Nothing in; a floor of worn stone tiles out: four by four quads that each show the whole picture,
//! so that coordinates stay within 0..1 and the picture repeats all the same.

use crate::noise::{clouds, hash};
use crate::sdf::smooth;
use crate::torso::FLOOR;
use glam::{Vec2, Vec3, vec2, vec3};
use image::ExtendedColorType;
use rayon::prelude::*;
use std::fmt::Write;
use std::path::Path;

const SIZE: usize = 1024;
/// Quads along a side, and the length of one.
const QUADS: usize = 4;
const SIDE: f32 = 2.0;
/// Stones along a picture's side.
const STONES: f32 = 4.0;

pub fn write(root: &Path) -> crate::Outcome {
    std::fs::write(root.join("meshes/ground.obj"), obj())?;
    std::fs::write(root.join("meshes/ground.mtl"), crate::mtl("ground", 20.0))?;
    let spot = |i: usize| vec2((i % SIZE) as f32 + 0.5, (SIZE - 1 - i / SIZE) as f32 + 0.5) / SIZE as f32;
    let all = 0..SIZE * SIZE;
    let colour: Vec<[u8; 3]> = all.clone().into_par_iter().map(|i| colour(spot(i)).to_array().map(byte)).collect();
    let normal: Vec<[u8; 3]> =
        all.into_par_iter().map(|i| normal(spot(i)).to_array().map(|x| byte(x * 0.5 + 0.5))).collect();
    crate::png(root, "ground_diffuse", colour.as_flattened(), SIZE, ExtendedColorType::Rgb8)?;
    crate::png(root, "ground_normal", normal.as_flattened(), SIZE, ExtendedColorType::Rgb8)
}

fn byte(x: f32) -> u8 {
    (x * 255.0).round().clamp(0.0, 255.0) as u8
}

fn obj() -> String {
    let mut s = String::from("# Made by scenes/make; do not edit.\nmtllib ground.mtl\no ground\n");
    let half = QUADS as f32 * SIDE / 2.0;
    for z in 0..=QUADS {
        for x in 0..=QUADS {
            let _ = writeln!(s, "v {} {FLOOR} {}", x as f32 * SIDE - half, half - z as f32 * SIDE);
        }
    }
    s.push_str("vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 1 0\nusemtl ground\n");
    let row = QUADS + 1;
    for z in 0..QUADS {
        for x in 0..QUADS {
            let a = z * row + x + 1;
            let (b, c, d) = (a + 1, a + row + 1, a + row);
            let _ = writeln!(s, "f {a}/1/1 {b}/2/1 {c}/3/1\nf {a}/1/1 {c}/3/1 {d}/4/1");
        }
    }
    s
}

/// Clouds that repeat with the picture: noise on a torus, seen as two circles in space.
fn tiling(uv: Vec2, fine: f32, octaves: u32) -> f32 {
    let turn = uv * std::f32::consts::TAU;
    let (a, b) = (Vec2::from_angle(turn.x) * fine, Vec2::from_angle(turn.y) * fine);
    0.7 * (clouds(vec3(a.x, a.y, b.x) + b.y * 0.71, octaves)
        + clouds(vec3(b.x + 40.0, b.y, a.x) - a.y * 0.63, octaves))
}

/// Which stone, where in it (-1..1), and how far from its edge.
fn stone(uv: Vec2) -> (u32, f32) {
    let wobble = vec2(tiling(uv, 2.0, 2), tiling(uv + 0.37, 2.0, 2)) * 0.03;
    let q = uv * STONES + wobble;
    // Every other row is shifted by half a stone.
    let row = q.y.floor();
    let x = q.x + 0.5 * row.rem_euclid(2.0);
    let column = x.floor().rem_euclid(STONES);
    let inside = vec2(x - x.floor(), q.y - row);
    let edge = inside.min(Vec2::ONE - inside);
    let corner = 0.06 - edge.min(Vec2::splat(0.06));
    (hash(column as u32 * 31 + row.rem_euclid(STONES) as u32 * 7 + 5), 0.06 - corner.length())
}

fn height(uv: Vec2) -> f32 {
    let (_, edge) = stone(uv);
    0.012 * smooth(0.008, 0.05, edge) + 0.0025 * tiling(uv, 7.0, 3)
}

fn normal(uv: Vec2) -> Vec3 {
    let e = 1.0 / SIZE as f32;
    let dx = height(uv + vec2(e, 0.0)) - height(uv - vec2(e, 0.0));
    let dy = height(uv + vec2(0.0, e)) - height(uv - vec2(0.0, e));
    vec3(-dx, -dy, 2.0 * e * SIDE).normalize()
}

fn colour(uv: Vec2) -> Vec3 {
    let (id, edge) = stone(uv);
    let tone = (id & 0xffff) as f32 / 65535.0;
    let warm = (id >> 16) as f32 / 65535.0;
    let base = vec3(0.46, 0.43, 0.39).lerp(vec3(0.40, 0.40, 0.40), warm) * (0.88 + 0.2 * tone);
    let worn = base * (1.0 + 0.22 * tiling(uv, 3.0, 4));
    vec3(0.17, 0.16, 0.145).lerp(worn, smooth(0.0, 0.035, edge))
}
