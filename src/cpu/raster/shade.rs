//! ids -> each visible pixel's color, once

use std::sync::atomic::AtomicU32;

use glam::{Vec2, Vec3, Vec4};

use super::shadow::reaches;
use super::snap::to_clip;
use super::texture::sample_map;
use super::weights::{weights, weights_inside};
use crate::cpu::shade::phong::phong;
use crate::cpu::witness::{Fragment, Picture, Term, Witness};
use crate::math::vector::unit;
use crate::tables::{
    Drawing, Lens, Map, NONE, ONE_SIDED, POINT, REGION, SHOW_ALBEDO, SHOW_AMBIENT, SHOW_DEPTH, SHOW_DIFFUSE,
    SHOW_ID, SHOW_NORMAL, SHOW_SHADOW, SHOW_SPECULAR, SHOW_UV, Vertex,
};

fn sum_by(w: Vec3, a: Vec3, b: Vec3, c: Vec3) -> Vec3 {
    (a * w.x + b * w.y) + c * w.z
}

fn uv_by(w: Vec3, [a, b, c]: [&Vertex; 3]) -> Vec2 {
    (Vec2::new(a.u, a.v) * w.x + Vec2::new(b.u, b.v) * w.y) + Vec2::new(c.u, c.v) * w.z
}

/// The normal of a map in world space: T and B are what an edge's u and v stand for (spec, "Get the normal for a
/// fragment"), N is interpolated.
fn bumped(n: Vec3, [a, b, c]: [&Vertex; 3], tangent: Vec3, witness: &mut impl Witness) -> Vec3 {
    let (e, f) = (b.position - a.position, c.position - a.position);
    let (du, dv) = ([b.u - a.u, c.u - a.u], [b.v - a.v, c.v - a.v]);
    let turn = du[0] * dv[1] - du[1] * dv[0];
    if turn == 0.0 {
        return n;
    }
    let side = if turn < 0.0 { -1.0 } else { 1.0 };
    let along_u = sum_by(Vec3::new(dv[1] * side, -(dv[0] * side), 0.0), e, f, Vec3::ZERO);
    let along_v = sum_by(Vec3::new(-(du[1] * side), du[0] * side, 0.0), e, f, Vec3::ZERO);
    if along_u.dot(along_u) == 0.0 || along_v.dot(along_v) == 0.0 {
        return n;
    }
    let (t, b) = (unit(along_u), unit(along_v));
    witness.tangents([t, b]);
    unit(sum_by(tangent, t, b, n))
}

/// Another color for every number.
fn color_of(id: u32) -> Vec3 {
    let [_, blue, green, red] = id.wrapping_mul(2_654_435_769).to_le_bytes();
    Vec3::from_array([red, green, blue].map(|c| f32::from(c) / 255.0 * 0.75 + 0.25))
}

fn color_at(
    drawing: &Drawing,
    lens: &Lens,
    shadows: &[AtomicU32],
    pixel: u32,
    id: u32,
    witness: &mut impl Witness,
) -> Vec3 {
    let canvas = &drawing.canvas;
    let [x, y] = [lens.left % REGION + pixel % lens.width, lens.top % REGION + pixel / lens.width];
    let at = Vec2::new(x as f32, y as f32) + 0.5;
    let face = drawing.faces[id as usize];
    let paint = &drawing.paints[(face.paint & !ONE_SIDED) as usize];
    let corners = [face.a, face.b, face.c].map(|i| &drawing.vertices[i as usize]);
    let [a, b, c] = corners;
    let clip: [Vec4; 3] = corners.map(|vertex| to_clip(lens, vertex.position));
    let w = weights_inside(lens, clip, at);
    let p = sum_by(w, a.position, b.position, c.position);
    let uvs = [
        uv_by(w, corners),
        uv_by(weights(lens, clip, at + Vec2::X), corners),
        uv_by(weights(lens, clip, at + Vec2::Y), corners),
    ];
    let mut read = |of, map: &Map, decode| {
        let value = sample_map(&drawing.texels, canvas.filtering, map, uvs, decode);
        witness.texel(of, value);
        value
    };

    let mut albedo = paint.color;
    if paint.diffuse_map.first != NONE {
        albedo *= read(Picture::Diffuse, &paint.diffuse_map, true);
    }
    let mut weight = paint.specular;
    if paint.specular_map.first != NONE {
        weight *= read(Picture::Specular, &paint.specular_map, false);
    }
    let mut exponent = paint.exponent;
    if paint.exponent_map.first != NONE {
        exponent *= read(Picture::Exponent, &paint.exponent_map, false).x;
    }
    let smooth = unit(sum_by(w, a.normal, b.normal, c.normal));
    let mut n = smooth;
    if paint.normal_map.first != NONE {
        let map = read(Picture::Normal, &paint.normal_map, false) * 2.0 - 1.0;
        n = bumped(n, corners, Vec3::new(map.x * paint.bump, map.y * paint.bump, map.z), witness);
    }
    let v = unit(canvas.eye - p);
    // A face that is seen from its back shows its back.
    if (b.position - a.position).cross(c.position - a.position).dot(v) < 0.0 {
        n = -n;
    }
    witness.fragment(&Fragment {
        clip,
        weights: w,
        point: p,
        uv: uvs[0],
        albedo,
        specular: weight,
        exponent,
        smooth,
        normal: n,
        view: v,
    });

    let (mut diffuse, mut specular, mut open) = (Vec3::ZERO, Vec3::ZERO, 0.0);
    for lamp in &drawing.lamps {
        let l = if lamp.kind == POINT { unit(lamp.place - p) } else { lamp.place };
        let share = reaches(&drawing.lenses, shadows, canvas.blur, lamp, p, witness);
        open += share / canvas.lamps as f32;
        let mut term = Term { toward: l, share, ..Term::default() };
        if n.dot(l) > 0.0 {
            term.power = lamp.power * (canvas.shade + (1.0 - canvas.shade) * share);
            term.phong = phong(n, l, v, exponent, canvas.specular);
            term.diffuse = term.power * term.phong[0];
            term.specular = weight * term.power * term.phong[1];
            diffuse += term.diffuse;
            specular += term.specular;
        }
        witness.lamp(&term);
    }
    match canvas.show {
        SHOW_DEPTH => {
            let away = (clip[0].w * w.x + clip[1].w * w.y) + clip[2].w * w.z;
            Vec3::splat(canvas.reach / (canvas.reach + away))
        }
        SHOW_SHADOW => Vec3::splat(open),
        SHOW_NORMAL => n * 0.5 + 0.5,
        SHOW_UV => Vec3::new(uvs[0].x - uvs[0].x.floor(), uvs[0].y - uvs[0].y.floor(), 0.0),
        SHOW_ALBEDO => albedo,
        SHOW_AMBIENT => canvas.ambient,
        SHOW_DIFFUSE => diffuse * albedo,
        SHOW_SPECULAR => specular * albedo,
        SHOW_ID => color_of(id),
        _ => (diffuse + specular) * albedo + canvas.ambient,
    }
}

/// Adds a sample to one pixel.
pub fn shade(
    drawing: &Drawing,
    lens: &Lens,
    shadows: &[AtomicU32],
    pixel: u32,
    id: u32,
    sum: &mut [f32; 4],
    witness: &mut impl Witness,
) {
    let color =
        if id == NONE { drawing.canvas.background } else { color_at(drawing, lens, shadows, pixel, id, witness) };
    witness.color(color);
    for (sum, part) in sum.iter_mut().zip([color.x, color.y, color.z, 1.0]) {
        *sum += part;
    }
}
