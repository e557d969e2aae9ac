//! three corners in fixed point -> a triangle whose area is above zero, unless there is nothing to see of it

use glam::{IVec3, IVec4};

use super::plan::{area, area_sign, on_film, span};
use crate::tables::{Lens, ONE_SIDED};

/// A triangle on the film, turned so that its area is above zero.
#[derive(Debug, Clone, Copy)]
pub struct Facet {
    /// Its corners in fixed point.
    pub corners: [IVec3; 3],
    /// Whether it is there, on the film and on its visible side.
    pub seen: bool,
    /// First and last column and row of its bounding box on the film.
    pub bounds: IVec4,
}

/// Whether a face with this paint is not there when its area on the film is above zero: y runs down the film, so that
/// what is counterclockwise in the world has an area below zero here.
#[must_use]
pub fn one_sided(lens: &Lens, paint: u32) -> bool {
    lens.cull == 1 && paint & ONE_SIDED != 0
}

/// `paint` is the face's, with [`ONE_SIDED`].
#[must_use]
pub fn facet(lens: &Lens, paint: u32, p: IVec3, q: IVec3, r: IVec3) -> Facet {
    let turn = area_sign(area(p, q, r));
    let bounds = on_film(lens, span(p, q, r));
    let there = turn < 0 || (turn > 0 && !one_sided(lens, paint));
    let seen = there && bounds.x <= bounds.z && bounds.y <= bounds.w;
    Facet { corners: if turn < 0 { [p, r, q] } else { [p, q, r] }, seen, bounds }
}
