//! three corners in fixed point -> a facet that is drawn at once, piece by piece, or not at all

use glam::{IVec3, IVec4};

use super::plan::{area, area_sign, on_film, span};
use crate::tables::{Lens, ONE_SIDED};

/// How a facet is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Not at all.
    Nothing,
    /// By one invocation.
    Small,
    /// Tile by tile.
    Large,
}

/// A triangle on the film, turned so that its area is above zero.
#[derive(Debug, Clone, Copy)]
pub struct Facet {
    /// Its corners, as in [`Corner::at`](crate::tables::Corner::at).
    pub corners: [IVec3; 3],
    /// How it is drawn.
    pub kind: Kind,
    /// First and last column and row of its bounding box on the film.
    pub bounds: IVec4,
}

/// `paint` is the face's, with [`ONE_SIDED`].
#[must_use]
pub fn facet(lens: &Lens, paint: u32, p: IVec3, q: IVec3, r: IVec3) -> Facet {
    // y runs down the film, so that what is counterclockwise in the world has an area below zero here.
    let turn = area_sign(area(p, q, r));
    let hidden = lens.cull == 1 && paint & ONE_SIDED != 0 && turn > 0;
    let whole = span(p, q, r);
    let bounds = on_film(lens, whole);
    let side = (whole.z - whole.x).max(whole.w - whole.y) + 1;
    let kind = if turn == 0 || hidden || bounds.x > bounds.z || bounds.y > bounds.w {
        Kind::Nothing
    } else if side <= lens.small as i32 {
        Kind::Small
    } else {
        Kind::Large
    };
    Facet { corners: if turn < 0 { [p, r, q] } else { [p, q, r] }, kind, bounds }
}
