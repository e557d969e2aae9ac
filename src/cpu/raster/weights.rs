//! a pixel of a face -> what each corner counts for there, in perspective (Eq. 1.1 - 1.5)

use glam::{Vec2, Vec3, Vec4};

use crate::tables::Lens;

/// alpha, beta, gamma of Eq. 1.5 at a place of what the lens spans, in pixels; they sum to one.
///
/// Seen from the pixel's line of sight, each is the area that the other two corners span: the same as
/// Z * alpha' / `Z_A`, and true behind the eye as well.
#[must_use]
pub fn weights(lens: &Lens, corners: [Vec4; 3], at: Vec2) -> Vec3 {
    let x = at.x * 2.0 / lens.span_x as f32 - 1.0;
    let y = 1.0 - at.y * 2.0 / lens.span_y as f32;
    let [p, q, r] = corners.map(|c| Vec2::new(c.x - x * c.w, c.y - y * c.w));
    let areas = Vec3::new(q.x * r.y - q.y * r.x, r.x * p.y - r.y * p.x, p.x * q.y - p.y * q.x);
    let sum = (areas.x + areas.y) + areas.z;
    if sum == 0.0 {
        return Vec3::X;
    }
    Vec3::new(areas.x / sum, areas.y / sum, areas.z / sum)
}

/// The same, held inside the face: a covered pixel's center may lie a trifle outside before it is snapped.
#[must_use]
pub fn weights_inside(lens: &Lens, corners: [Vec4; 3], at: Vec2) -> Vec3 {
    let inside = weights(lens, corners, at).max(Vec3::ZERO);
    let sum = (inside.x + inside.y) + inside.z;
    Vec3::new(inside.x / sum, inside.y / sum, inside.z / sum)
}
