//! a face that crosses planes -> what is left of it, a convex polygon in fixed point

use glam::Vec4;

use super::snap::height;
use crate::math::quotient::quotient;
use crate::tables::{Lens, MOST_CORNERS, PLANES};

/// Where an edge that crosses a plane meets it.
///
/// Always reckoned from the end inside to the end outside, so that both faces of the edge get the same bits.
#[must_use]
pub fn meet(lens: &Lens, inside: Vec4, outside: Vec4, plane: u32) -> Vec4 {
    let from_inside = height(lens, plane, inside);
    let t = quotient(from_inside, from_inside - height(lens, plane, outside));
    inside + (outside - inside) * t
}

/// Sutherland and Hodgman: plane after plane cuts off what lies beyond it.
#[must_use]
pub fn clip(lens: &Lens, corners: [Vec4; 3]) -> Vec<Vec4> {
    let mut corners = corners.to_vec();
    for plane in 0..PLANES {
        let mut cut = Vec::with_capacity(MOST_CORNERS as usize);
        for (i, &here) in corners.iter().enumerate() {
            let next = corners[(i + 1) % corners.len()];
            let here_in = height(lens, plane, here) >= 0.0;
            let next_in = height(lens, plane, next) >= 0.0;
            if here_in && cut.len() < MOST_CORNERS as usize {
                cut.push(here);
            }
            if here_in != next_in && cut.len() < MOST_CORNERS as usize {
                cut.push(if here_in { meet(lens, here, next, plane) } else { meet(lens, next, here, plane) });
            }
        }
        corners = cut;
    }
    corners
}
