//! a ray at a surface -> the reflected and the refracted path (spec 2.1, steps 3 and 4)

use glam::{Vec2, Vec3};

use crate::cpu::trace::surface::Surface;
use crate::math::sphere::on_sphere;
use crate::math::vector::{mirror, unit};
use crate::tables::{DIFFUSE, GLASS};

/// A ray to come.
#[derive(Debug, Clone, Copy)]
pub struct Branch {
    /// Of length one.
    pub direction: Vec3,
    /// What its light counts for at the surface; zero if there is no such ray.
    pub weight: Vec3,
    /// 1 if it runs inside the object.
    pub inside: u32,
}

/// The two ways on from a surface.
#[derive(Debug, Clone, Copy)]
pub struct Branches {
    /// In the mirror direction (Eq. 2.6) or around it.
    pub reflected: Branch,
    /// Through the surface (Eq. 2.7).
    pub refracted: Branch,
}

/// `direction`: the ray's, of length one; `inside`: 1 if it ran inside an object; `random`: two numbers in [0, 1)
/// of the ray's own.
#[must_use]
pub fn scatter(direction: Vec3, inside: u32, surface: &Surface, random: Vec2) -> Branches {
    let material = surface.material;
    // A normal that is bent so far that the mirror direction lies below the surface counts for nothing.
    let mut n = surface.shading;
    let above = direction.dot(n) < 0.0 && mirror(-direction, n).dot(surface.normal) > 0.0;
    if !above {
        n = surface.normal;
    }
    let reflection = mirror(-direction, n);
    let mut reflected = Branch { direction: reflection, weight: Vec3::splat(material.reflect_weight), inside };
    let mut refracted = Branch { direction: reflection, weight: Vec3::ZERO, inside };

    if material.behavior == DIFFUSE {
        // Anywhere in the hemisphere around the mirror direction.
        let free = on_sphere(random.x, random.y);
        let cosine = free.dot(reflection);
        reflected.direction = if cosine < 0.0 { -free } else { free };
        reflected.weight = material.tint * (material.reflect_weight * cosine.abs());
    }

    if material.behavior == GLASS {
        // Eq. 2.7, with `i` the ray's own direction.
        let ratio = if inside == 1 { material.index } else { 1.0 / material.index };
        let cosine = direction.dot(n);
        let root = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
        let bent = unit(direction * ratio - n * (ratio * cosine + root.sqrt()));
        // What a bent normal would refract to this side of the surface does not get through either.
        let above = n != surface.normal && bent.dot(surface.normal) > 0.0;
        if root < 0.0 || above {
            // Beyond the critical angle everything is reflected.
            reflected.weight = Vec3::splat(material.reflect_weight + material.refract_weight);
        } else {
            refracted.direction = bent;
            refracted.weight = Vec3::splat(material.refract_weight);
            refracted.inside = 1 - inside;
        }
    }
    Branches { reflected, refracted }
}
