//! pixels -> what the first ray of each meets: depth, normal, color, and the share of the lights that reaches it
//!
//! One ray a pixel and one for each light: so little work that the CPU does it for both backends.

use std::ops::Range;

use glam::Vec3;
use rayon::prelude::*;

use super::trace::aim::Ray;
use super::trace::primary::{primary, seed};
use super::trace::surface::surface_at;
use super::trace::tree::lit;
use super::trace::walk::{Walk, walk};
use crate::tables::{FAR, NONE, Tables};

/// What a pixel's first ray meets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct First {
    /// Along the view; infinite where nothing is.
    pub depth: f32,
    /// Of length one and towards the eye; zero where nothing is.
    pub normal: Vec3,
    /// The surface's own, by the weight of its local light.
    pub albedo: Vec3,
    /// From 0 to 1.
    pub shadow: f32,
}

/// The first ray of each pixel of a rectangle.
#[must_use]
pub fn first(tables: &Tables, columns: Range<u32>, rows: Range<u32>) -> Vec<First> {
    let each = rows.into_par_iter().flat_map_iter(|row| {
        let mut stack = vec![[0; 2]; tables.deep as usize];
        let pixels = columns.clone().map(move |column| row * tables.view.width + column);
        pixels.map(|pixel| at(tables, pixel, &mut stack)).collect::<Vec<_>>()
    });
    each.collect()
}

fn at(tables: &Tables, pixel: u32, stack: &mut [[u32; 2]]) -> First {
    let direction = primary(&tables.view, pixel, 0);
    let ray = Ray { origin: tables.view.eye, direction, leaves: NONE };
    let found = walk(tables, stack, ray, Walk::new(FAR), u32::MAX, false);
    if found.hit == NONE {
        return First { depth: f32::INFINITY, normal: Vec3::ZERO, albedo: Vec3::ZERO, shadow: 0.0 };
    }
    let surface = surface_at(tables, ray, found.t, found.hit, &mut ());
    let path = crate::tables::Path { t: found.t, hit: found.hit, ..seed(&tables.view, 0, direction) };
    let open = tables.lights.iter().filter(|light| {
        let asked = lit(tables, &path, &surface, light);
        asked.reach > 0.0 && walk(tables, stack, asked.shadow, Walk::new(asked.reach), u32::MAX, true).hit == NONE
    });
    let shadow = open.count() as f32 / tables.lights.len().max(1) as f32;
    let depth = (surface.point - tables.view.eye).dot(-tables.view.back);
    First { depth, normal: surface.shading, albedo: surface.material.color * surface.material.local_weight, shadow }
}
