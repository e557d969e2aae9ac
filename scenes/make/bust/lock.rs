//! A root, a direction and a surface in; a carved lock of hair (or a horn) and its distance out.

use crate::sdf::mix;
use glam::{Quat, Vec3};

/// One station along a lock: its place, cross-section frame and half-axes.
#[derive(Clone, Copy)]
struct Knot {
    at: Vec3,
    side: Vec3,
    up: Vec3,
    wide: f32,
    high: f32,
    /// Length of the lock so far.
    run: f32,
}

/// A flattened tube along a curve, with grooves along it (hair) or across it (horn).
pub struct Lock {
    knots: Vec<Knot>,
    centre: Vec3,
    reach: f32,
    seed: f32,
    horn: bool,
}

/// How a lock grows from its root.
#[derive(Clone, Copy)]
pub struct Style {
    pub length: f32,
    pub wide: f32,
    pub high: f32,
    /// Total turning in radians; most of it comes near the tip.
    pub curl: f32,
    /// Amplitude of the S-shaped waving in radians.
    pub wave: f32,
    /// Height of the middle above the surface.
    pub lift: f32,
    /// Height of the tip above the surface.
    pub tip: f32,
    pub seed: f32,
}

pub const STEPS: usize = 12;

/// Grows a lock over the surface of `base`, bending towards `pull` as it goes.
pub fn grow(base: &dyn Fn(Vec3) -> f32, root: Vec3, dir: Vec3, pull: Vec3, s: Style) -> Lock {
    let mut at = root;
    let mut dir = dir.normalize();
    let mut knots = Vec::with_capacity(STEPS + 1);
    let step = s.length / STEPS as f32;
    for i in 0..=STEPS {
        let t = i as f32 / STEPS as f32;
        let up = gradient(base, at, 0.02);
        let height = s.lift * (t * 2.6).sin().max(0.0) + s.tip * t * t;
        at += up * (height - base(at)) * if i == 0 { 1.0 } else { 0.8 };
        let wanted = dir + pull * step * 2.0;
        dir = (wanted - up * wanted.dot(up)).normalize();
        let turn = s.curl * 3.0 * t * t + s.wave * (t * 7.0 + s.seed).sin();
        dir = Quat::from_axis_angle(up, turn / STEPS as f32) * dir;
        let body = (t * 9.0 + 0.35).min(1.0) * (1.0 - t.powi(3) * 0.78);
        knots.push(Knot {
            at,
            side: up.cross(dir).normalize(),
            up,
            wide: s.wide * body,
            high: s.high * body,
            run: t * s.length,
        });
        at += dir * step;
    }
    Lock::new(knots, s.seed, false)
}

impl Lock {
    fn new(knots: Vec<Knot>, seed: f32, horn: bool) -> Lock {
        let n = knots.len() as f32;
        let centre = knots.iter().fold(Vec3::ZERO, |s, k| s + k.at) / n;
        let reach = knots.iter().map(|k| k.at.distance(centre) + k.wide.max(k.high)).fold(0.0, f32::max);
        Lock { knots, centre, reach, seed, horn }
    }

    /// A horn through points with radii; its frame is carried along without twist.
    pub fn horn(points: &[(Vec3, f32)], seed: f32) -> Lock {
        let mut knots = Vec::new();
        let mut up = Vec3::Y;
        let mut run = 0.0;
        for (i, &(at, r)) in points.iter().enumerate() {
            let a = points[i.saturating_sub(1)].0;
            let b = points[(i + 1).min(points.len() - 1)].0;
            let dir = (b - a).normalize();
            up = (up - dir * up.dot(dir)).normalize();
            run += if i > 0 { at.distance(a) } else { 0.0 };
            knots.push(Knot { at, side: up.cross(dir), up, wide: r, high: r, run });
        }
        Lock::new(knots, seed, true)
    }

    /// A distance that is never more than the true one; cheap.
    pub fn bound(&self, p: Vec3) -> f32 {
        p.distance(self.centre) - self.reach
    }

    /// Distance to the lock; `fine` adds the strands that only the maps can hold.
    /// Nothing beyond `limit` is looked at.
    pub fn distance(&self, p: Vec3, fine: bool, limit: f32) -> f32 {
        let mut best = limit;
        for pair in self.knots.windows(2) {
            let (a, b) = (&pair[0], &pair[1]);
            let ab = b.at - a.at;
            let t = ((p - a.at).dot(ab) / ab.length_squared()).clamp(0.0, 1.0);
            let q = p - (a.at + ab * t);
            let wide = mix(a.wide, b.wide, t);
            let high = mix(a.high, b.high, t);
            let small = wide.min(high);
            if (q.length() / wide.max(high) - 1.0) * small > best {
                continue;
            }
            let side = a.side.lerp(b.side, t).normalize();
            let up = a.up.lerp(b.up, t).normalize();
            let (x, y) = (q.dot(side), q.dot(up));
            let along2 = (q.length_squared() - x * x - y * y).max(0.0);
            let round = (x * x / (wide * wide) + y * y / (high * high) + along2 / (small * small)).sqrt();
            let mut d = (round - 1.0) * small;
            let run = mix(a.run, b.run, t);
            d += if self.horn {
                rings(run, y.atan2(x), wide, self.seed, fine)
            } else {
                strands(x / wide, run, small, self.seed, fine)
            };
            best = best.min(d);
        }
        best
    }
}

/// Grooves along a lock: two or three deep ones, and fine hairs between them.
fn strands(x: f32, run: f32, small: f32, seed: f32, fine: bool) -> f32 {
    let drift = 0.5 * (run * 9.0 + seed).sin();
    let deep = (1.0 - (x * 4.6 + seed + drift).cos().abs()).powi(2);
    let hair = if fine { (1.0 - (x * 13.0 + seed * 3.0 + drift * 2.0).cos().abs()).powi(2) } else { 0.0 };
    small * (if fine { 0.26 } else { 0.13 } * deep + 0.10 * hair)
}

/// Growth rings round a horn, crowded and faint towards the tip.
fn rings(run: f32, angle: f32, wide: f32, seed: f32, fine: bool) -> f32 {
    let sway = 0.35 * (angle * 2.0 + seed).sin() + 0.2 * (angle * 5.0 + seed * 2.0).sin();
    let phase = run * 62.0 + sway;
    let ridge = (phase * 0.5).sin().abs().powf(0.7);
    let hair = if fine { 0.012 * (phase * 3.0 + (angle * 5.0).sin()).sin() } else { 0.0 };
    wide * (0.17 * (1.0 - ridge) + hair)
}

/// Central-difference normal of a distance function.
pub fn gradient(f: &dyn Fn(Vec3) -> f32, p: Vec3, e: f32) -> Vec3 {
    Vec3::new(
        f(p + Vec3::X * e) - f(p - Vec3::X * e),
        f(p + Vec3::Y * e) - f(p - Vec3::Y * e),
        f(p + Vec3::Z * e) - f(p - Vec3::Z * e),
    )
    .normalize_or(Vec3::Y)
}
