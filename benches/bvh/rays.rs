//! the rays of the bench: from the eye in tiles of 4 x 4 pixels, one bounce from each hit, one way to the light

use bytemuck::{Pod, Zeroable};
use rayon::prelude::*;
use twinlight::cpu::trace::aim::Ray;
use twinlight::cpu::trace::walk::{Walk, walk};
use twinlight::math::random::{pcg4d, unit_float};
use twinlight::math::sphere::on_sphere;
use twinlight::math::{Vec3, vector::unit};
use twinlight::tables::{FAR, NONE, Tables};

use crate::meshes::Seat;

/// A ray as `rays.wgsl` and `embree.c` read it.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct Asked {
    pub(crate) origin: Vec3,
    pub(crate) far: f32,
    pub(crate) direction: Vec3,
    /// 1: any hit will do.
    pub(crate) any: u32,
}

impl Asked {
    pub(crate) fn ray(&self) -> Ray {
        Ray { origin: self.origin, direction: self.direction, leaves: NONE }
    }
}

pub(crate) const SETS: [&str; 3] = ["primary", "diffuse", "shadow"];
const SIDE: u32 = 1024;

pub(crate) fn sets(tables: &Tables, seat: Seat) -> [Vec<Asked>; 3] {
    let back = unit(seat.eye - seat.at);
    let right = unit(Vec3::Y.cross(back));
    let up = back.cross(right);
    let primary: Vec<Asked> = (0..SIDE * SIDE)
        .map(|i| {
            let (tile, place) = (i / 16, i % 16);
            let x = tile % (SIDE / 4) * 4 + place % 4;
            let y = tile / (SIDE / 4) * 4 + place / 4;
            let at = |i: u32| (i as f32 + 0.5) / SIDE as f32 - 0.5;
            let direction = unit(right * at(x) - up * at(y) - back);
            Asked { origin: seat.eye, far: FAR, direction, any: 0 }
        })
        .collect();
    let reach = (tables.settings.high - tables.settings.low).max_element() * 1e-4;
    let hits = primary.par_iter().zip(0..SIDE * SIDE).filter_map(|(asked, i)| {
        let mut stack = vec![[0; 2]; tables.deep as usize];
        let found = walk(tables, &mut stack, asked.ray(), Walk::new(FAR), u32::MAX, false);
        let leaf = tables.leaves.get(found.hit as usize)?;
        let n = unit((leaf.b - leaf.a).cross(leaf.c - leaf.a));
        let n = if n.dot(asked.direction) > 0.0 { -n } else { n };
        // Well off the surface: the peers do not know what a ray leaves.
        let point = asked.origin + asked.direction * found.t + n * reach;
        let bits = pcg4d([i, 0, 0, 7]);
        let bounce = unit(n + on_sphere(unit_float(bits[0]), unit_float(bits[1])) * 0.999);
        let diffuse = Asked { origin: point, far: FAR, direction: bounce, any: 0 };
        Some((diffuse, Asked { origin: point, far: 1.0, direction: seat.light - point, any: 1 }))
    });
    let (diffuse, shadow) = hits.collect();
    [primary, diffuse, shadow]
}
