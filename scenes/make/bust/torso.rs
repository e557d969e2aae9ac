//! World points in, the distance to neck, chest, drapery and plinth out.

use crate::noise::noise;
use crate::sdf::{ball, carve, common, dab, egg, join, limb, ring, smooth};
use glam::{Vec2, Vec3, vec2, vec3};

/// Where the plinth stands.
pub const FLOOR: f32 = -0.85;

/// Neck, shoulders and chest, not yet cut.
fn flesh(p: Vec3) -> f32 {
    let s = vec3((p.x * p.x + 1e-4).sqrt(), p.y, p.z);
    let mut d = limb(p, vec3(0.0, 0.32, 0.0), vec3(0.0, -0.12, -0.05), 0.185, 0.20);
    d = join(d, egg(s, vec3(0.0, -0.38, -0.04), vec3(0.49, 0.36, 0.235)), 0.10);
    d = join(d, limb(s, vec3(0.09, 0.14, -0.10), vec3(0.46, -0.13, -0.09), 0.11, 0.095), 0.12);
    d = join(d, ball(s, vec3(0.51, -0.26, -0.05), 0.165), 0.10);
    d = join(d, egg(s, vec3(0.205, -0.36, 0.10), vec3(0.215, 0.15, 0.115)), 0.07);
    d += 0.018 * dab(s, vec3(0.0, -0.36, 0.21), vec3(0.035, 0.16, 0.08));
    // Collar bones, the pits above them, and the notch between.
    let bone = limb(s, vec3(0.045, -0.095, 0.145), vec3(0.22, -0.075, 0.125), 0.026, 0.022);
    let bone = join(bone, limb(s, vec3(0.22, -0.075, 0.125), vec3(0.43, -0.085, 0.0), 0.022, 0.03), 0.03);
    d = join(d, bone, 0.045);
    d += 0.03 * dab(s, vec3(0.20, -0.02, 0.10), vec3(0.09, 0.035, 0.07));
    // The muscle from behind the ear to the notch.
    let strap = limb(s, vec3(0.175, 0.24, -0.04), vec3(0.035, -0.085, 0.15), 0.04, 0.024);
    d = join(d, strap, 0.035);
    d = carve(d, ball(s, vec3(0.0, -0.075, 0.19), 0.032), 0.05);
    join(d, limb(p, vec3(0.0, 0.13, 0.12), vec3(0.0, 0.0, 0.11), 0.05, 0.045), 0.06)
}

/// The classical cut: an apron that narrows towards the plinth.
fn cut(p: Vec3, d: f32) -> f32 {
    let rim = egg(p, vec3(0.0, 0.10, 0.0), vec3(0.66, 0.76, 0.60));
    let arms = p.x.abs() - 0.565 - 0.10 * (p.y + 0.2);
    common(d, common(rim, arms, 0.12), 0.02)
}

/// Neck and chest, and the cloak over them.
pub fn figure(p: Vec3) -> (f32, f32) {
    let d = flesh(p);
    if d > 0.3 { (d - 0.05, d - 0.12) } else { (cut(p, d), cloak(p, d)) }
}

/// Neck and chest alone.
pub fn body(p: Vec3) -> f32 {
    cut(p, flesh(p))
}

/// A cloak over the left shoulder, across the breast and round the back.
fn cloak(p: Vec3, d: f32) -> f32 {
    // The upper hem runs from the left shoulder down across the breast.
    let hem = p.y - 0.55 * p.x + 0.34 - 0.10 * smooth(-0.05, 0.1, p.z) * (p.x * 4.0).cos();
    if hem > 0.25 || d < -0.1 {
        return cut(p, (hem - 0.03).max(d));
    }
    let hem = hem + 0.02 * noise(p * 5.0);
    // Folds hang like a fan from the pin on that shoulder; between them finer ones begin lower down.
    let from_pin = vec2(p.x - 0.60, p.y - 0.13);
    let away = from_pin.length();
    let angle = from_pin.y.atan2(-from_pin.x) + 0.10 * noise(p * 3.1) + 0.05 * noise(p * 7.3);
    let ridge = |phase: f32| 1.0 - (1.0 - (phase * 0.5).sin().abs()).powi(2);
    let main = ridge(angle * 36.0 + 1.3 * noise(p * 2.0 + 5.0));
    let finer = ridge(angle * 72.0 + 2.0 * noise(p * 2.6 + 3.0)) * smooth(0.35, 0.8, away);
    let depth = (0.020 + 0.030 * smooth(0.1, 0.7, away)) * (0.75 + 0.5 * noise(p * 3.0 + 9.0));
    let roll = 0.020 * (-((hem + 0.045) / 0.035).powi(2)).exp();
    let thick = 0.020 + depth * (main + 0.35 * finer) + roll;
    let cloth = (d - thick) * 0.7;
    common(common(cloth, hem, 0.03), cut(p, d - 0.06), 0.04)
}

/// A turned foot: two tori and a hollow between, on a round slab.
pub fn plinth(p: Vec3) -> f32 {
    let q = vec2(Vec2::new(p.x, p.z + 0.02).length(), p.y);
    let slab = ring(q, vec2(0.0, FLOOR + 0.045), vec2(0.30, 0.045), 0.012);
    let step = ring(q, vec2(0.0, FLOOR + 0.09), vec2(0.265, 0.03), 0.012);
    let low = ring(q, vec2(0.215, FLOOR + 0.14), vec2(0.032, 0.032), 0.0319);
    let neck = ring(q, vec2(0.0, FLOOR + 0.21), vec2(0.16, 0.12), 0.01);
    let hollow = (q - vec2(0.235, FLOOR + 0.235)).length() - 0.085;
    let high = ring(q, vec2(0.16, FLOOR + 0.315), vec2(0.022, 0.022), 0.0219);
    let stem = ring(q, vec2(0.0, FLOOR + 0.36), vec2(0.15, 0.06), 0.01);
    let core = join(carve(neck, hollow, 0.008), stem, 0.01);
    let rings = low.min(high);
    join(join(slab.min(step), rings, 0.004), core, 0.008)
}
