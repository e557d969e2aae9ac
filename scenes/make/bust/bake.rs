//! A model and the fine shape in, its three maps out: for every texel the nearest point of the fine
//! shape, its normal in the texel's own triangle frame, its colour and its shine.

use crate::mesh::slope;
use crate::model::Model;
use crate::patina::{Spot, paint};
use crate::shape::Bust;
use crate::unwrap::pixels;
use glam::{Mat3, Vec2, Vec3};
use rayon::prelude::*;

/// Rows from the top, three bytes (shine: one) a texel.
pub struct Maps {
    pub size: usize,
    pub normal: Vec<[u8; 3]>,
    pub colour: Vec<[u8; 3]>,
    pub shine: Vec<u8>,
}

#[derive(Clone, Copy)]
struct Texel {
    normal: [u8; 3],
    colour: [u8; 3],
    shine: u8,
}

const EMPTY: u32 = u32::MAX;

pub fn bake(model: &Model, bust: &Bust, size: usize, gutter: usize) -> Maps {
    let mut owner = vec![EMPTY; size * size];
    for (f, t) in model.uv_faces.iter().enumerate() {
        for (x, y) in pixels(t.map(|k| model.uv[k as usize] * size as f32)) {
            let slot = &mut owner[(size - 1 - y as usize) * size + x as usize];
            if *slot == EMPTY {
                *slot = f as u32;
            }
        }
    }
    let blank = Texel { normal: [128, 128, 255], colour: [90, 74, 56], shine: 20 };
    let mut texels: Vec<Texel> = owner
        .par_iter()
        .enumerate()
        .map(|(i, &f)| {
            let uv = Vec2::new((i % size) as f32 + 0.5, (size - 1 - i / size) as f32 + 0.5) / size as f32;
            if f == EMPTY { blank } else { texel(model, bust, f as usize, uv) }
        })
        .collect();
    spread(&mut texels, &mut owner, size, gutter);
    Maps {
        size,
        normal: texels.iter().map(|t| t.normal).collect(),
        colour: texels.iter().map(|t| t.colour).collect(),
        shine: texels.iter().map(|t| t.shine).collect(),
    }
}

fn texel(model: &Model, bust: &Bust, f: usize, uv: Vec2) -> Texel {
    let [a, b, c] = model.faces[f].map(|k| model.at[k as usize]);
    let [na, nb, nc] = model.faces[f].map(|k| model.normals[k as usize]);
    let [ta, tb, tc] = model.uv_faces[f].map(|k| model.uv[k as usize]);
    let (d1, d2, dp) = (tb - ta, tc - ta, uv - ta);
    let area = d1.perp_dot(d2);
    let (s, t) = (dp.perp_dot(d2) / area, d1.perp_dot(dp) / area);
    let (e1, e2) = (b - a, c - a);
    // The renderer's frame: T = dP/du and B = dP/dv of the triangle, N interpolated.
    let tangent = ((e1 * d2.y - e2 * d1.y) / area).normalize();
    let bitangent = ((e2 * d1.x - e1 * d2.x) / area).normalize();
    let normal = (na * (1.0 - s - t) + nb * s + nc * t).normalize();
    let p = a + e1 * s + e2 * t;

    let fine = |q: Vec3| bust.distance(q, true);
    // Two steps down one gradient are enough: the model lies within a few thousandths.
    let g = slope(&fine, p, 1e-3);
    let mut q = p;
    for _ in 0..2 {
        q -= g * (fine(q) / g.length_squared().max(0.2)).clamp(-0.006, 0.006);
    }
    let g = slope(&fine, q, 9e-4);
    let strength = g.length().max(0.2);
    let true_normal = (g / strength).normalize_or(normal);
    let spot = Spot { at: q, normal: true_normal, parts: bust.parts(q, true) };
    let far = |v: Vec3, fine: bool| bust.distance(v, fine) / strength;
    let paint = paint(&spot, &far);

    // Solve T x + B y + N z = n; the frame need not be square.
    let frame = Mat3::from_cols(tangent, bitangent, normal);
    let face = e1.cross(e2).normalize();
    let lean = paint.normal.dot(face).min(paint.normal.dot(normal));
    let kept = if lean < 0.15 { (paint.normal + normal * (0.15 - lean)).normalize() } else { paint.normal };
    let local = (frame.inverse() * kept).normalize_or(Vec3::Z);
    Texel {
        // The third part may be rough: it hardly turns the normal, and it packs better.
        normal: [
            coarse(local.x * 127.5 + 127.5, 1.0),
            coarse(local.y * 127.5 + 127.5, 1.0),
            coarse(local.z * 127.5 + 127.5, 3.0),
        ],
        colour: paint.colour.to_array().map(|x| coarse(x * 255.0, 5.0)),
        shine: coarse(paint.shine.max(6.0), 12.0),
    }
}

/// Rounds to a multiple of `step`: nobody sees it on mottled bronze, and the files are half as big.
fn coarse(x: f32, step: f32) -> u8 {
    ((x / step).round() * step).clamp(0.0, 255.0) as u8
}

/// Carries border texels outwards ring by ring, so that no lookup near a seam meets a blank.
fn spread(texels: &mut [Texel], owner: &mut [u32], size: usize, rings: usize) {
    for _ in 0..rings {
        let old = owner.to_vec();
        for i in 0..size * size {
            if old[i] != EMPTY {
                continue;
            }
            let (x, y) = (i % size, i / size);
            let near = [
                (x > 0, i.wrapping_sub(1)),
                (x + 1 < size, i + 1),
                (y > 0, i.wrapping_sub(size)),
                (y + 1 < size, i + size),
            ];
            if let Some(&(_, k)) = near.iter().find(|&&(inside, k)| inside && old[k] != EMPTY) {
                texels[i] = texels[k];
                owner[i] = owner[k];
            }
        }
    }
}
