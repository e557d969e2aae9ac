//! Head-space points in, the distance to skull, face and ears out. The head is 1 high from chin
//! to crown, the eyes lie on y = 0 and the face looks along +z.

use crate::sdf::{ball, carve, chain, common, dab, egg, join, limb, smooth};
use glam::{Vec3, vec3};

pub const EYE: Vec3 = vec3(0.143, -0.004, 0.268);
pub const EYE_RADIUS: f32 = 0.084;
pub const IRIS: f32 = 0.36;
pub const PUPIL: f32 = 0.16;

/// Both halves at once; the tiny radius keeps the midline from creasing.
pub fn fold(p: Vec3) -> Vec3 {
    vec3((p.x * p.x + 1e-4).sqrt() - 0.003, p.y, p.z)
}

/// Skull, jaw and muscles, without the features: what hair grows on.
pub fn base(p: Vec3) -> f32 {
    let p = fold(p);
    let mut d = egg(p, vec3(0.0, 0.12, -0.045), vec3(0.315, 0.37, 0.425));
    d = join(d, egg(p, vec3(0.0, 0.16, 0.10), vec3(0.265, 0.26, 0.285)), 0.08);
    d = join(d, egg(p, vec3(0.0, -0.13, 0.13), vec3(0.225, 0.29, 0.235)), 0.10);
    d = join(d, limb(p, vec3(0.195, -0.24, 0.0), vec3(0.065, -0.42, 0.31), 0.075, 0.07), 0.09);
    d = join(d, ball(p, vec3(0.0, -0.425, 0.34), 0.072), 0.06);
    d
}

/// The whole head without hair and horns.
pub fn face(p: Vec3, whole: f32) -> f32 {
    if whole > 0.52 {
        return whole - 0.32;
    }
    let p = fold(p);
    let mut d = whole;
    // No feature of the face comes this far back.
    if p.z < -0.09 {
        return join(d.min(0.18), ear(p), 0.02);
    }
    // Cheekbones and their arch towards the ear, then the hollow below them.
    d = join(d, egg(p, vec3(0.195, -0.085, 0.245), vec3(0.08, 0.055, 0.08)), 0.11);
    d = join(d, limb(p, vec3(0.23, -0.07, 0.2), vec3(0.29, -0.03, 0.02), 0.035, 0.03), 0.06);
    d += 0.012 * dab(p, vec3(0.20, -0.22, 0.27), vec3(0.07, 0.09, 0.10));
    // Brow: a ridge that overhangs the eyes, heavy in the middle.
    let brow = chain(
        p,
        &[
            (vec3(0.03, 0.072, 0.388), 0.034),
            (vec3(0.115, 0.105, 0.368), 0.036),
            (vec3(0.20, 0.098, 0.315), 0.030),
            (vec3(0.262, 0.04, 0.235), 0.026),
        ],
    );
    d = join(d, brow, 0.055);
    d = carve(d, egg(p, vec3(0.148, 0.004, 0.385), vec3(0.098, 0.058, 0.085)), 0.06);
    d = carve(d, egg(p, vec3(0.075, 0.02, 0.41), vec3(0.032, 0.045, 0.06)), 0.05);
    d = join(d, eye(p), 0.018);
    d = nose(p, d);
    d = mouth(p, d);
    // Frown lines and the forehead's furrows.
    d += 0.010 * dab(p, vec3(0.022, 0.105, 0.43), vec3(0.010, 0.04, 0.06));
    for (y, a) in [(0.185, 0.007), (0.235, 0.006)] {
        let bend = y + 0.03 * (p.x * 9.0).cos() - 0.02;
        d += a * (-((p.y - bend) / 0.013).powi(2) - (p.x / 0.16).powi(2)).exp();
    }
    join(d, ear(p), 0.02)
}

/// How far from the line of sight a point of the eye lies: iris and pupil are discs of this.
pub fn gaze(p: Vec3) -> f32 {
    let look = (p - EYE).normalize() - vec3(0.025, 0.05, 1.0).normalize();
    look.truncate().length()
}

/// Eyeball and lids.
fn eye(p: Vec3) -> f32 {
    let out = p.distance(EYE);
    if out > 0.2 {
        return out - EYE_RADIUS;
    }
    let (globe, lid) = eye_parts(p);
    join(globe, lid, 0.007)
}

/// The eyeball, with incised iris and drilled pupil as Roman carvers made them, and the two lids.
pub fn eye_parts(p: Vec3) -> (f32, f32) {
    let q = p - EYE;
    let out = q.length();
    let mut globe = out - EYE_RADIUS;
    if q.z > 0.0 {
        let iris = gaze(p);
        globe += 0.0015 * (-((iris - IRIS) / 0.03).powi(2)).exp();
        globe += 0.005 * (1.0 - smooth(0.8, 1.15, iris / PUPIL));
    }
    // The slit is an almond, its outer corner a little higher.
    let x = q.x + 0.004;
    let y = q.y - 0.09 * x;
    let u = (x / 0.079).clamp(-1.0, 1.0);
    let arch = (1.0 - u * u).max(0.0);
    let upper = 0.024 * arch.powf(0.75) * (1.0 - 0.18 * u);
    let lower = -0.021 * arch.powf(0.8) * (1.0 + 0.15 * u);
    let slit = (y - upper).max(lower - y).max(x.abs() - 0.079);
    // The lids thin out behind, where the socket takes over.
    let lid = out - EYE_RADIUS - 0.0135 * smooth(-0.03, 0.045, q.z);
    (globe, common(lid, -slit, 0.014))
}

/// A strong straight nose, wings and nostrils.
fn nose(p: Vec3, d: f32) -> f32 {
    let bridge = chain(
        p,
        &[
            (vec3(0.0, 0.075, 0.372), 0.036),
            (vec3(0.0, 0.0, 0.392), 0.030),
            (vec3(0.0, -0.075, 0.437), 0.034),
            (vec3(0.0, -0.145, 0.472), 0.042),
        ],
    );
    let mut d = join(d, bridge, 0.05);
    // Flesh between the bridge and the cheek.
    d = join(d, limb(p, vec3(0.03, -0.06, 0.385), vec3(0.045, -0.15, 0.40), 0.02, 0.028), 0.05);
    let tip = egg(p, vec3(0.0, -0.152, 0.477), vec3(0.043, 0.036, 0.043));
    d = join(d, tip, 0.025);
    let wing = egg(p, vec3(0.056, -0.165, 0.425), vec3(0.030, 0.034, 0.042));
    d = join(d, wing, 0.016);
    d = join(d, limb(p, vec3(0.0, -0.178, 0.475), vec3(0.0, -0.2, 0.415), 0.015, 0.02), 0.02);
    carve(d, egg(p, vec3(0.033, -0.195, 0.44), vec3(0.016, 0.018, 0.026)), 0.012)
}

/// Muzzle, lips, chin, and the folds from nose to mouth.
fn mouth(p: Vec3, d: f32) -> f32 {
    let mut d = join(d, egg(p, vec3(0.0, -0.275, 0.315), vec3(0.125, 0.10, 0.105)), 0.07);
    let fold = chain(
        p,
        &[
            (vec3(0.085, -0.155, 0.41), 0.004),
            (vec3(0.118, -0.205, 0.395), 0.006),
            (vec3(0.14, -0.27, 0.37), 0.004),
        ],
    );
    d = carve(d, fold, 0.02);
    let upper = chain(
        p,
        &[
            (vec3(0.0, -0.268, 0.418), 0.019),
            (vec3(0.03, -0.262, 0.416), 0.019),
            (vec3(0.075, -0.276, 0.395), 0.013),
            (vec3(0.112, -0.289, 0.365), 0.005),
        ],
    );
    let lower = chain(
        p,
        &[
            (vec3(0.0, -0.316, 0.410), 0.024),
            (vec3(0.05, -0.310, 0.402), 0.020),
            (vec3(0.108, -0.291, 0.366), 0.005),
        ],
    );
    d = join(d, upper, 0.02);
    let part = chain(
        p,
        &[
            (vec3(0.0, -0.290, 0.440), 0.002),
            (vec3(0.045, -0.287, 0.428), 0.002),
            (vec3(0.118, -0.292, 0.375), 0.002),
        ],
    );
    d = join(d, lower, 0.016);
    d = carve(d, part, 0.016);
    d + 0.012 * dab(p, vec3(0.0, -0.362, 0.41), vec3(0.07, 0.018, 0.05))
}

/// A faun's ear: a pointed leaf, hollowed in front.
fn ear(p: Vec3) -> f32 {
    let far = p.distance(vec3(0.43, 0.0, -0.065)) - 0.2;
    if far > 0.18 {
        return far;
    }
    let root = vec3(0.30, -0.05, -0.03);
    let tip = vec3(0.56, 0.06, -0.10);
    let axis = tip - root;
    let length = axis.length();
    let along = axis / length;
    let q = p - root;
    let t = q.dot(along) / length;
    let face = vec3(0.25, 0.15, 1.0);
    let face = (face - along * face.dot(along)).normalize();
    let side = along.cross(face);
    let (x, z) = (q.dot(side), q.dot(face));
    let s = t.clamp(0.0, 1.0);
    let wide = 0.105 * (s * 1.15 + 0.12).min(1.0).sqrt() * (1.0 - s * s).max(0.0).powf(0.7) + 0.004;
    // A cupped sheet: the rim stands forward of the middle.
    let cup = z - 0.6 * x * x / 0.1;
    let body = ((x / wide).powi(2) + (cup / 0.028).powi(2)).sqrt() - 1.0;
    let d = body * wide.min(0.028) * 0.8;
    let ends = (t - 1.0).max(-t - 0.1) * length;
    let leaf = common(d, ends, 0.01) * 0.8;
    let hollow = egg(vec3(x, t * length, cup), vec3(0.0, 0.10, 0.034), vec3(0.055, 0.105, 0.026));
    carve(leaf, hollow, 0.015)
}
