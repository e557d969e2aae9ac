//! A spot of the surface in, its colour, shine and grain out: bronze, worn bright where hands and
//! weather reach it and green where water stands; gilded horns; a plinth of veined marble.

use crate::head;
use crate::noise::clouds;
use crate::sdf::{dab, smooth};
use crate::shape::Parts;
use glam::{Vec3, vec3};

pub struct Spot {
    pub at: Vec3,
    pub normal: Vec3,
    pub parts: Parts,
}

pub struct Paint {
    pub normal: Vec3,
    pub colour: Vec3,
    /// Phong exponent, 1..255.
    pub shine: f32,
}

pub fn paint(spot: &Spot, far: &dyn Fn(Vec3, bool) -> f32) -> Paint {
    let (p, n) = (spot.at, spot.normal);
    // How far the surface stands off along the normal, against how far it would from a plane.
    let shut = |h: f32| ((h - far(p + n * h, h < 0.02)) / h).clamp(0.0, 1.0);
    let (crease, hollow, deep) = (shut(0.012), shut(0.04), shut(0.14));
    let open = (1.0 - 0.35 * crease) * (1.0 - 0.45 * hollow) * (1.0 - 0.45 * deep);
    let edge = ((far(p - n * 0.012, true) + 0.012) / 0.012).clamp(0.0, 1.0);

    let parts = &spot.parts;
    let metal = parts.skin.min(parts.hair).min(parts.cloak).min(parts.horn);
    if parts.plinth < metal {
        return marble(p, n, open);
    }
    let blotch = clouds(p * 5.0, 3);
    let drip = clouds(p * vec3(14.0, 2.5, 14.0), 3);
    let gilt = smooth(0.003, -0.001, parts.horn - parts.skin.min(parts.hair));
    let bare = smooth(0.0, 0.004, parts.hair - parts.skin);
    if bare > 0.5 && parts.face.distance(head::EYE) < head::EYE_RADIUS + 0.02 && parts.face.z > head::EYE.z + 0.03 {
        let (globe, lid) = head::eye_parts(parts.face);
        if globe < lid {
            return eye(head::gaze(parts.face), n, open);
        }
    }

    let dark = vec3(0.34, 0.21, 0.115);
    let warm = vec3(0.58, 0.37, 0.19);
    let bright = vec3(0.86, 0.62, 0.33);
    let green = vec3(0.30, 0.53, 0.45);
    let gold = vec3(0.86, 0.64, 0.26);

    // The cloak was cast from another pour, darker and cooler.
    let cloth = smooth(0.003, -0.003, parts.cloak - parts.skin.min(parts.hair));
    let lips = bare * dab(parts.face, vec3(0.0, -0.292, 0.42), vec3(0.095, 0.034, 0.08)).powf(0.6);
    let lids = bare * dab(parts.face, head::EYE + vec3(0.0, 0.03, 0.08), vec3(0.12, 0.07, 0.12));
    let worn = smooth(0.10, 0.55, edge + 0.25 * blotch);
    let up = n.y.max(0.0);
    let wet = crease * 1.2 + hollow * 1.1 + 0.35 * deep + 0.45 * drip + 0.25 * up + 0.2 * blotch;
    let verdigris = smooth(0.50, 1.05, wet)
        * (1.0 - 0.85 * worn)
        * (1.0 - 0.7 * gilt)
        * (1.0 - 0.8 * lips)
        * (1.0 - 0.75 * lids);
    let body = dark.lerp(warm, smooth(-0.5, 0.5, blotch + 0.6 - 1.6 * hollow));
    let body = body * Vec3::ONE.lerp(vec3(0.58, 0.64, 0.72), cloth);
    let metal = body.lerp(bright, worn * (0.8 - 0.3 * cloth)).lerp(gold, gilt * (0.9 - 0.5 * hollow));
    let metal = metal.lerp(vec3(0.58, 0.29, 0.19), 0.65 * lips);
    let pale = green * (1.0 + 0.35 * clouds(p * 40.0, 2));
    let colour = metal.lerp(pale, verdigris * 0.85) * (0.35 + 0.65 * open);
    let shine = 26.0 + 60.0 * worn + 50.0 * gilt - 14.0 * hollow;
    let shine = shine + (9.0 - shine) * verdigris;

    // Cast bronze is not quite smooth; verdigris is crusted.
    let grain = |q: Vec3| 0.0008 * clouds(q * 75.0, 2) + 0.0012 * verdigris * clouds(q * 170.0, 2);
    Paint { normal: roughen(&grain, p, n), colour, shine }
}

/// Eyes inlaid with ivory and dark stone, as in the bronzes of Riace.
fn eye(gaze: f32, n: Vec3, open: f32) -> Paint {
    let ivory = vec3(0.80, 0.75, 0.64);
    let iris = vec3(0.36, 0.20, 0.07).lerp(vec3(0.62, 0.40, 0.15), smooth(0.2, 0.36, gaze));
    let rim = vec3(0.10, 0.06, 0.035);
    let colour = ivory.lerp(rim, smooth(head::IRIS + 0.045, head::IRIS, gaze));
    let colour = colour.lerp(iris, smooth(head::IRIS, head::IRIS - 0.06, gaze));
    let colour = colour.lerp(vec3(0.02, 0.015, 0.01), smooth(head::PUPIL + 0.04, head::PUPIL, gaze));
    Paint { normal: n, colour: colour * (0.55 + 0.45 * open), shine: 180.0 }
}

/// Green-black marble with white veins, polished.
fn marble(p: Vec3, n: Vec3, open: f32) -> Paint {
    let warp = vec3(clouds(p * 6.0, 3), clouds(p * 6.0 + 31.0, 3), clouds(p * 6.0 + 57.0, 3));
    let vein = |f: f32, thin: f32| {
        let c = clouds(p * f + warp * 1.6, 3).abs();
        (1.0 - smooth(0.0, thin, c)).powi(2)
    };
    let veins = (vein(4.0, 0.07) + 0.45 * vein(9.0, 0.05)).min(1.0);
    let stone = vec3(0.115, 0.17, 0.145) * (1.0 + 0.5 * clouds(p * 12.0, 3));
    let colour = stone.lerp(vec3(0.74, 0.76, 0.70), veins * 0.8) * (0.3 + 0.7 * open);
    Paint { normal: n, colour, shine: 90.0 - 30.0 * veins }
}

/// Tilts a normal by the slope of a height field.
fn roughen(height: &dyn Fn(Vec3) -> f32, p: Vec3, n: Vec3) -> Vec3 {
    let e = 0.001;
    let h = height(p);
    let g = vec3(height(p + Vec3::X * e) - h, height(p + Vec3::Y * e) - h, height(p + Vec3::Z * e) - h) / e;
    (n - (g - n * g.dot(n))).normalize()
}
