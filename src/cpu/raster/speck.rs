//! a face -> a triangle so small that 32 bits hold its edges, or what else becomes of it

use glam::{IVec2, IVec3};

use super::facet::one_sided;
use super::plan::{Plan, covers, nearness, nears_of, on_film, owned, span};
use crate::tables::{Corner, Face, Lens};

/// What becomes of a face.
#[derive(Debug, Clone, Copy)]
pub enum Speck {
    /// Nothing of it is seen.
    Nothing,
    /// It is drawn at once.
    Small {
        /// The first pixel of its bounding box on the film; the plan is seen from there.
        first: IVec2,
        /// The last pixel of its bounding box on the film.
        last: IVec2,
        /// Its edges and its nearness.
        plan: Plan,
    },
    /// It is large.
    Late,
    /// It crosses a plane.
    Torn,
}

/// The edge from p to q, as seen from (0, 0) in 1/256 pixel: the same numbers as
/// [`edge`](super::plan::edge), while they are small.
fn small_edge(p: IVec2, q: IVec2) -> IVec3 {
    let a = p.y - q.y;
    let b = q.x - p.x;
    IVec3::new(a, b, (if owned(a, b) { 0 } else { -1 } - (a * p.x + b * p.y)) >> 8)
}

/// A face as the lens sees it.
#[must_use]
pub fn speck(lens: &Lens, face: &Face, corners: &[Corner]) -> Speck {
    let [ca, cb, cc] = [face.a, face.b, face.c].map(|i| corners[i as usize]);
    if ca.code | cb.code | cc.code != 0 {
        return if ca.code & cb.code & cc.code == 0 { Speck::Torn } else { Speck::Nothing };
    }
    let p = ca.at;
    let whole = span(p, cb.at, cc.at);
    let bounds = on_film(lens, whole);
    if bounds.x > bounds.z || bounds.y > bounds.w {
        return Speck::Nothing;
    }
    if (whole.z - whole.x).max(whole.w - whole.y) >= lens.small as i32 {
        return Speck::Late;
    }
    let (u, v) = (cb.at - p, cc.at - p);
    let turn = u.x * v.y - u.y * v.x;
    if turn == 0 || (turn > 0 && one_sided(lens, face.paint)) {
        return Speck::Nothing;
    }
    let (q, r) = if turn < 0 { (cc.at, cb.at) } else { (cb.at, cc.at) };
    let first = bounds.truncate().truncate();
    let center = first * 256 + 128;
    let at = |corner: IVec3| corner.truncate() - center;
    let edges = [small_edge(at(p), at(q)), small_edge(at(q), at(r)), small_edge(at(r), at(p))];
    let plan = Plan {
        a: IVec3::from_array(edges.map(|e| e.x)),
        b: IVec3::from_array(edges.map(|e| e.y)),
        e: IVec3::from_array(edges.map(|e| e.z)),
        nears: nears_of(lens, [p, q, r], turn.abs() as f32, first),
    };
    Speck::Small { first, last: IVec2::new(bounds.z, bounds.w), plan }
}

/// Every pixel that a small face covers, with its nearness there.
pub fn each_pixel(lens: &Lens, first: IVec2, last: IVec2, plan: &Plan, mut visit: impl FnMut(u32, u32)) {
    for y in 0..=last.y - first.y {
        for x in 0..=last.x - first.x {
            if covers(plan, x, y) {
                let at = first + IVec2::new(x, y);
                visit(at.y as u32 * lens.width + at.x as u32, nearness(&plan.nears, x, y));
            }
        }
    }
}
