//! runs that show a face -> each pixel's color, once

use std::sync::atomic::AtomicU32;

use glam::{Vec2, Vec3, Vec4};

use super::shadow::reaches;
use super::snap::to_clip;
use super::weights::{weights, weights_inside};
use crate::cpu::shade::look::{bumped, look_of, sum_by, uv_by};
use crate::cpu::shade::phong::phong;
use crate::cpu::shade::texture::within;
use crate::cpu::witness::{Fragment, Term, Witness};
use crate::math::vector::unit;
use crate::tables::{
    CUT_OUT, Drawing, Lens, NONE, ONE_SIDED, POINT, REGION, SHOW_ALBEDO, SHOW_AMBIENT, SHOW_DEPTH, SHOW_DIFFUSE,
    SHOW_ID, SHOW_NORMAL, SHOW_SHADOW, SHOW_SPECULAR, SHOW_UV, SHOW_WIRE,
};

/// Another color for every number.
fn color_of(id: u32) -> Vec3 {
    let [_, blue, green, red] = id.wrapping_mul(2_654_435_769).to_le_bytes();
    Vec3::from_array([red, green, blue].map(|c| f32::from(c) / 255.0 * 0.75 + 0.25))
}

/// How steeply a weight grows from a pixel to its neighbors, and so how many pixels from it the weight is zero.
fn away(w: f32, across: f32, below: f32) -> f32 {
    let (x, y) = (across - w, below - w);
    w / (x * x + y * y).sqrt().max(1e-10)
}

/// 0 on a face's edges, 1 from a pixel and a quarter away from them; from its weights in a pixel, right of it and below.
fn off_edges(w: Vec3, across: Vec3, below: Vec3) -> f32 {
    let nearest = [0, 1, 2].map(|i| away(w[i], across[i], below[i])).into_iter().fold(f32::INFINITY, f32::min);
    (nearest - 0.25).clamp(0.0, 1.0)
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
    let paint = &drawing.paints[(face.paint & !(ONE_SIDED | CUT_OUT)) as usize];
    let corners = [face.a, face.b, face.c].map(|i| &drawing.vertices[i as usize]);
    let [a, b, c] = corners;
    let clip: [Vec4; 3] = corners.map(|vertex| to_clip(lens, vertex.position));
    let w = weights_inside(lens, clip, at);
    let p = sum_by(w, a.position, b.position, c.position);
    let (across, below) = (weights(lens, clip, at + Vec2::X), weights(lens, clip, at + Vec2::Y));
    let uvs = [w, across, below].map(|w| uv_by(w, corners));
    let look = look_of(&drawing.texels, canvas.filtering, paint, uvs, witness);
    let albedo = paint.color * look.color;
    let smooth = unit(sum_by(w, a.normal, b.normal, c.normal));
    let mut n = smooth;
    if paint.normal_map.first != NONE {
        n = bumped(n, corners, look.tangent, witness);
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
        specular: look.specular,
        exponent: look.exponent,
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
            term.phong = phong(n, l, v, look.exponent, canvas.specular);
            term.diffuse = term.power * term.phong[0];
            term.specular = look.specular * term.power * term.phong[1];
            diffuse += term.diffuse;
            specular += term.specular;
        }
        witness.lamp(&term);
    }
    match canvas.show {
        SHOW_DEPTH => {
            let away = (clip[0].w * w.x + clip[1].w * w.y) + clip[2].w * w.z;
            let gray = canvas.depth_times / away + canvas.depth_plus;
            Vec3::splat(gray.max(canvas.depth_least).min(canvas.depth_most))
        }
        SHOW_SHADOW => Vec3::splat(open),
        SHOW_NORMAL => n * 0.5 + 0.5,
        SHOW_UV => Vec3::new(within(uvs[0].x, false), within(uvs[0].y, false), 0.0),
        SHOW_ALBEDO => albedo,
        SHOW_AMBIENT => canvas.ambient,
        SHOW_DIFFUSE => diffuse * albedo,
        SHOW_SPECULAR => specular * albedo,
        SHOW_WIRE => Vec3::splat((0.15 + 0.6 * n.dot(v).max(0.0)) * off_edges(w, across, below)),
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
