//! Points in, signed distances out: the handful of solids and joins that everything is carved from.

use glam::{Vec2, Vec3};

/// Union with a fillet of about `k` (polynomial smooth minimum, after Quilez).
pub fn join(a: f32, b: f32, k: f32) -> f32 {
    let h = (k - (a - b).abs()).max(0.0) / k;
    a.min(b) - h * h * k * 0.25
}

/// `a` without `b`, the rim rounded by about `k`.
pub fn carve(a: f32, b: f32, k: f32) -> f32 {
    -join(-a, b, k)
}

/// What `a` and `b` share, the rim rounded by about `k`.
pub fn common(a: f32, b: f32, k: f32) -> f32 {
    -join(-a, -b, k)
}

pub fn ball(p: Vec3, c: Vec3, r: f32) -> f32 {
    p.distance(c) - r
}

/// First-order distance to an ellipsoid: exact on the surface, which is where it counts.
pub fn egg(p: Vec3, c: Vec3, r: Vec3) -> f32 {
    let q = (p - c) / r;
    let k0 = q.length();
    let k1 = (q / r).length().max(1e-6);
    k0 * (k0 - 1.0) / k1
}

/// A capsule whose radius goes from `ra` at `a` to `rb` at `b`.
pub fn limb(p: Vec3, a: Vec3, b: Vec3, ra: f32, rb: f32) -> f32 {
    let ab = b - a;
    let t = ((p - a).dot(ab) / ab.length_squared()).clamp(0.0, 1.0);
    p.distance(a + ab * t) - (ra + (rb - ra) * t)
}

/// A chain of limbs through points with radii in `w`.
pub fn chain(p: Vec3, points: &[(Vec3, f32)]) -> f32 {
    points.windows(2).map(|s| limb(p, s[0].0, s[1].0, s[0].1, s[1].1)).fold(f32::MAX, |a, d| join(a, d, 0.01))
}

/// A clay stroke: 1 at `c`, fading to nothing at about twice the radii.
pub fn dab(p: Vec3, c: Vec3, r: Vec3) -> f32 {
    (-((p - c) / r).length_squared()).exp()
}

/// A rounded box seen in the half-plane (distance from the axis, height).
pub fn ring(q: Vec2, c: Vec2, half: Vec2, round: f32) -> f32 {
    let d = (q - c).abs() - half + round;
    d.max(Vec2::ZERO).length() + d.x.max(d.y).min(0.0) - round
}

pub fn smooth(a: f32, b: f32, x: f32) -> f32 {
    let t = ((x - a) / (b - a)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

pub fn mix(a: f32, b: f32, t: f32) -> f32 {
    a + (b - a) * t
}
