//! The surface under the hair in; every lock of hair, beard, brow and the two horns out. All in
//! head space.

use crate::head;
use crate::lock::{Lock, Style, grow};
use crate::noise::Dice;
use crate::sdf::smooth;
use glam::{Vec3, vec3};
use std::f32::consts::TAU;

/// All the hair there is, over what it lies on.
pub fn hair(ground: &dyn Fn(Vec3) -> f32) -> Vec<Lock> {
    let mut dice = Dice(7);
    let mut out = Vec::new();
    let down = vec3(0.0, -1.0, 0.0);
    // Rings of locks from the nape up to the crown; each ring lies over the one below.
    let crown = vec3(0.0, 0.12, -0.045);
    for ring in 0..8 {
        let rise = -0.42 + ring as f32 * 0.262;
        let count = [16, 18, 18, 16, 14, 10, 7, 4][ring];
        for i in 0..count {
            let turn = (i as f32 + 0.5 * (ring % 2) as f32 + dice.roll(-0.2, 0.2)) / count as f32;
            let angle = turn * TAU;
            let tilt = rise + dice.roll(-0.06, 0.06);
            let (s, c) = angle.sin_cos();
            let dir = vec3(s * tilt.cos(), tilt.sin(), c * tilt.cos());
            let root = crown + dir * vec3(0.32, 0.375, 0.43);
            // Face and ears stay free.
            let front = c;
            let limit = 0.30 + 1.2 * smooth(0.2, 0.75, front);
            if front > 0.15 && tilt < limit {
                continue;
            }
            let hand = if s >= 0.0 { 1.0 } else { -1.0 };
            let out_dir = vec3(s, 0.0, c) * vec3(1.0, 0.0, 0.8);
            let flow =
                down * (0.5 - 0.6 * tilt) + out_dir * 0.9 + vec3(hand * 0.5, 0.0, -0.2) * smooth(0.3, 0.9, front);
            let style = Style {
                length: dice.roll(0.26, 0.36),
                wide: dice.roll(0.042, 0.056),
                high: dice.roll(0.036, 0.046),
                curl: hand * dice.roll(1.6, 3.4) * dice.sign(0.25),
                wave: dice.roll(0.5, 1.6),
                lift: dice.roll(0.035, 0.06),
                tip: dice.roll(0.03, 0.07),
                seed: dice.roll(0.0, TAU),
            };
            out.push(grow(ground, root, flow, down * 2.0, style));
        }
    }
    out.extend(fringe(ground));
    out.extend(beard(ground));
    out
}

/// Parted in the middle, swept over the brow to both temples.
fn fringe(ground: &dyn Fn(Vec3) -> f32) -> Vec<Lock> {
    let mut dice = Dice(1234);
    let mut out = Vec::new();
    for hand in [1.0f32, -1.0] {
        // Temples, before and behind the horn's root, and down to the beard.
        for (i, root) in [
            vec3(0.275, 0.06, 0.13),
            vec3(0.285, 0.13, 0.09),
            vec3(0.265, 0.21, 0.15),
            vec3(0.235, 0.31, 0.16),
            vec3(0.25, 0.31, 0.05),
        ]
        .into_iter()
        .enumerate()
        {
            let style = Style {
                length: dice.roll(0.22, 0.30),
                wide: dice.roll(0.034, 0.044),
                high: dice.roll(0.030, 0.038),
                curl: hand * dice.roll(1.2, 3.0) * if i % 2 == 0 { 1.0 } else { -1.0 },
                wave: dice.roll(0.8, 1.8),
                lift: dice.roll(0.02, 0.04),
                tip: dice.roll(0.03, 0.06),
                seed: dice.roll(0.0, TAU),
            };
            let root = vec3(root.x * hand, root.y, root.z);
            out.push(grow(ground, root, vec3(0.2 * hand, -1.0, 0.15), vec3(0.0, -1.5, -0.1), style));
        }
        for i in 0..8 {
            let t = i as f32 / 7.0;
            let tilt = 0.56 + 0.9 * t + dice.roll(-0.03, 0.03);
            let root = vec3(0.0, 0.12, -0.045)
                + vec3(hand * dice.roll(0.005, 0.03), 0.375 * tilt.sin(), 0.43 * tilt.cos());
            let style = Style {
                length: 0.34 + 0.06 * t + dice.roll(-0.04, 0.04),
                wide: dice.roll(0.040, 0.052),
                high: dice.roll(0.034, 0.044),
                curl: -hand * dice.roll(1.4, 2.8),
                wave: dice.roll(0.9, 1.9),
                lift: 0.035 + dice.roll(0.0, 0.03),
                tip: dice.roll(0.035, 0.06),
                seed: dice.roll(0.0, TAU),
            };
            let flow = vec3(hand, 0.25 - 0.2 * t, 0.25);
            out.push(grow(ground, root, flow, vec3(0.0, -1.6, -0.2), style));
        }
    }
    out
}

fn beard(ground: &dyn Fn(Vec3) -> f32) -> Vec<Lock> {
    let lip = |p: Vec3| head::face(p, head::base(p));
    let mut dice = Dice(91);
    let mut out = Vec::new();
    let down = vec3(0.0, -1.0, 0.0);
    for hand in [1.0f32, -1.0] {
        // From the temple along the jaw to the chin, three layers deep.
        for layer in 0..3 {
            let count = [8, 7, 5][layer];
            for i in 0..count {
                let t = (i as f32 + dice.roll(0.2, 0.8)) / count as f32;
                let jaw = vec3(0.245 - 0.19 * t * t, -0.10 - 0.29 * t.powf(0.8), 0.04 + 0.33 * t);
                let root = jaw + vec3(-0.01, 0.045, 0.02) * layer as f32 * (1.0 - 0.3 * t);
                let root = vec3(root.x * hand, root.y, root.z);
                let flow = down + vec3(hand * 0.25, 0.0, 0.55 * t);
                let style = Style {
                    length: dice.roll(0.22, 0.30) + 0.10 * t,
                    wide: dice.roll(0.034, 0.046),
                    high: dice.roll(0.030, 0.040),
                    curl: hand * dice.roll(1.8, 3.6) * dice.sign(0.3),
                    wave: dice.roll(0.8, 1.8),
                    lift: 0.02 + 0.015 * layer as f32,
                    tip: dice.roll(0.06, 0.10),
                    seed: dice.roll(0.0, TAU),
                };
                out.push(grow(ground, root, flow, down * 1.0 + vec3(0.0, 0.0, 0.4), style));
            }
        }
        // Moustache: two sweeping locks a side, lying on the lip itself.
        for (x, y, wide, curl) in [(0.012, -0.243, 0.026, -1.2), (0.03, -0.228, 0.022, -1.7)] {
            let style = Style {
                length: 0.24,
                wide,
                high: 0.020,
                curl: hand * curl,
                wave: hand * 0.3,
                lift: 0.018,
                tip: 0.045,
                seed: x * 90.0,
            };
            let root = vec3(x * hand, y, 0.43);
            out.push(grow(&lip, root, vec3(hand, -0.30, 0.0), down * 2.4, style));
        }
        // Eyebrows: short tufts combed outwards.
        for i in 0..7 {
            let t = i as f32 / 6.0;
            let root = vec3(hand * (0.045 + 0.15 * t), 0.09 + 0.03 * t - 0.035 * t * t, 0.41 - 0.10 * t);
            let style = Style {
                length: 0.08,
                wide: 0.015,
                high: 0.009,
                curl: -hand * 0.5,
                wave: 0.0,
                lift: 0.006,
                tip: 0.0,
                seed: 5.0 * t,
            };
            out.push(grow(&lip, root, vec3(hand, 0.7 - 0.8 * t, 0.0), down * 0.3, style));
        }
    }
    // The chin's own locks hang in front.
    for i in 0..7 {
        let x = (i as f32 - 3.0) / 3.0;
        let style = Style {
            length: 0.34 - 0.06 * x.abs() + dice.roll(-0.03, 0.03),
            wide: dice.roll(0.036, 0.044),
            high: 0.036,
            curl: x.signum() * dice.roll(1.2, 2.8),
            wave: dice.roll(0.8, 1.6),
            lift: 0.03,
            tip: 0.09,
            seed: dice.roll(0.0, TAU),
        };
        let root = vec3(0.11 * x, -0.365 + 0.02 * x * x, 0.40 - 0.05 * x * x);
        out.push(grow(ground, root, vec3(0.5 * x, -1.0, 0.5), down + vec3(0.0, 0.0, 0.6), style));
    }
    out
}

/// Ram's horns: a spiral out of the brow, back over the ear and forward again.
pub fn horns() -> Vec<Lock> {
    [1.0f32, -1.0]
        .map(|hand| {
            let points: Vec<(Vec3, f32)> = (0..44)
                .map(|i| {
                    let t = i as f32 / 43.0;
                    let angle = 0.75 + t * 5.9;
                    let radius = 0.275 * (1.0 - 0.58 * t);
                    let (s, c) = angle.sin_cos();
                    let hub = vec3(0.385, 0.11 - 0.03 * t, 0.0 + 0.05 * t);
                    let p = hub + vec3(0.20 * t * t, s * radius, c * radius);
                    let p = vec3((p.x - 0.19 * (1.0 - smooth(0.0, 0.30, t))) * hand, p.y, p.z);
                    (p, 0.098 * (1.0 - t).powf(0.7) + 0.006)
                })
                .collect();
            Lock::horn(&points, hand)
        })
        .into()
}
