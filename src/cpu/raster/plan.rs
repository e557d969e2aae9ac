//! three corners in fixed point -> integer planes: coverage and depth at any pixel, exactly

use glam::{IVec2, IVec3, IVec4};

use crate::math::quotient::quotient;
use crate::tables::{DEEP, Lens, NO_DEPTH, STEEPEST};

/// The plane of nearness of a triangle, as seen from a pixel near it, its origin.
///
/// Counted modulo 2^32. What is nearer is more; all numbers of nearness are below zero, taken for signed ones.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Nears {
    /// What nearness grows by from column to column.
    pub x: i32,
    /// What nearness grows by from row to row.
    pub y: i32,
    /// Nearness at the origin.
    pub at: i32,
    /// That of the deepest corner; no sample is below it.
    pub least: i32,
    /// That of the nearest corner.
    pub most: i32,
}

/// A triangle whose area is above zero, as seen from a pixel near it, its origin.
///
/// A pixel (x, y) from there is covered where `a * x + b * y + e >= 0` for all three edges.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Plan {
    /// What each edge grows by from column to column.
    pub a: IVec3,
    /// What each edge grows by from row to row.
    pub b: IVec3,
    /// Each edge at the origin.
    pub e: IVec3,
    /// How near it is.
    pub nears: Nears,
}

/// Twice the signed area in 1/65536 pixel, in base 4096: `x * 2^24 + y * 2^12 + z` with y and z in 0 ... 4095.
///
/// Sides are below 2^23, so the halves' products are below 2^25 and nothing overflows.
#[must_use]
pub fn area(p: IVec3, q: IVec3, r: IVec3) -> IVec3 {
    let [ux, uy, vx, vy] = [q.x - p.x, q.y - p.y, r.x - p.x, r.y - p.y];
    let h = |s: i32| s >> 12;
    let l = |s: i32| s & 4095;
    let mut high = h(ux) * h(vy) - h(uy) * h(vx);
    let mut middle = (h(ux) * l(vy) + l(ux) * h(vy)) - (h(uy) * l(vx) + l(uy) * h(vx));
    let mut low = l(ux) * l(vy) - l(uy) * l(vx);
    middle += low >> 12;
    low &= 4095;
    high += middle >> 12;
    middle &= 4095;
    IVec3::new(high, middle, low)
}

/// -1, 0 or 1.
#[must_use]
pub fn area_sign(area: IVec3) -> i32 {
    if area.x != 0 {
        return area.x.signum();
    }
    i32::from((area.y | area.z) != 0)
}

/// `a * x + b * y + e`, held within +-2^30: a bin's width from there it has the same sign, and nothing overflows.
///
/// In base 256: |a|, |b| <= 2^22, |x|, |y| < 2^15.
fn edge_at(a: i32, b: i32, e: i32, x: i32, y: i32) -> i32 {
    let low = (a & 255) * x + (b & 255) * y + e;
    let high = (a >> 8) * x + (b >> 8) * y + (low >> 8);
    if high >= 1 << 22 {
        1 << 30
    } else if high < -(1 << 22) {
        -(1 << 30)
    } else {
        high * 256 + (low & 255)
    }
}

/// A sample on an edge (a, b) belongs to the triangle whose left or top edge it is.
#[must_use]
pub fn owned(a: i32, b: i32) -> bool {
    a > 0 || (a == 0 && b > 0)
}

/// The edge from p to q, as seen from the pixel `origin`: (a, b, e).
///
/// The floor of the constant keeps every sign, since the rest of the sum is a multiple of 256.
#[must_use]
pub fn edge(p: IVec3, q: IVec3, origin: IVec2) -> IVec3 {
    let a = p.y - q.y;
    let b = q.x - p.x;
    let [x, y] = [p.x - 128, p.y - 128];
    let constant = (if owned(a, b) { 0 } else { -1 } - (a * (x & 255) + b * (y & 255))) >> 8;
    IVec3::new(a, b, edge_at(a, b, constant, origin.x - (x >> 8), origin.y - (y >> 8)))
}

/// A slope in depths a pixel, from its numerator and twice the area.
fn slope(numerator: f32, area: f32) -> i32 {
    (quotient(numerator * 256.0, area) + 0.5).floor().clamp(-1_073_741_824.0, 1_073_741_824.0) as i32
}

/// The nearness of p, q, r, whose area, doubled, is `size`, as seen from the pixel `origin`.
#[must_use]
pub fn nears_of(lens: &Lens, [p, q, r]: [IVec3; 3], size: f32, origin: IVec2) -> Nears {
    let (u, v) = ((q - p).as_vec3(), (r - p).as_vec3());
    let zx = slope(u.z * v.y - v.z * u.y, size);
    let zy = slope(v.z * u.x - u.z * v.x, size);
    let [x, y] = [p.x - 128, p.y - 128];
    let share = |z: i32, part: i32| (z >> 8) * part + (((z & 255) * part) >> 8);
    let back = share(zx, x & 255).wrapping_add(share(zy, y & 255));
    let z = p.z.wrapping_sub(back);
    let z = z.wrapping_add(zx.wrapping_mul(origin.x - (x >> 8))).wrapping_add(zy.wrapping_mul(origin.y - (y >> 8)));
    let steep = (zx.unsigned_abs() + zy.unsigned_abs()).min(STEEPEST);
    // At most as much as there is of depth, so that nearness stays below zero.
    let bias = ((steep >> 8) * lens.slope).min(DEEP - 1);
    let none = (NO_DEPTH - bias) as i32;
    Nears {
        x: -zx,
        y: -zy,
        at: none.wrapping_sub(z),
        least: none - p.z.max(q.z).max(r.z),
        most: none - p.z.min(q.z).min(r.z),
    }
}

/// p, q, r with an area above zero, as seen from the pixel `origin`.
#[must_use]
pub fn plan(lens: &Lens, [p, q, r]: [IVec3; 3], origin: IVec2) -> Plan {
    let edges = [edge(p, q, origin), edge(q, r, origin), edge(r, p, origin)];
    let parts = area(p, q, r);
    let size = (parts.x as f32 * 16_777_216.0 + parts.y as f32 * 4096.0) + parts.z as f32;
    Plan {
        a: IVec3::from_array(edges.map(|e| e.x)),
        b: IVec3::from_array(edges.map(|e| e.y)),
        e: IVec3::from_array(edges.map(|e| e.z)),
        nears: nears_of(lens, [p, q, r], size, origin),
    }
}

/// [`NO_DEPTH`] less the depth of a pixel: the larger, the nearer, and zero is nothing.
#[must_use]
pub fn nearness(n: &Nears, x: i32, y: i32) -> u32 {
    let at = n.at.wrapping_add(n.x.wrapping_mul(x)).wrapping_add(n.y.wrapping_mul(y));
    at.clamp(n.least, n.most) as u32
}

/// Whether a pixel is covered.
#[must_use]
pub fn covers(plan: &Plan, x: i32, y: i32) -> bool {
    let e = plan.e + plan.a * x + plan.b * y;
    (e.x | e.y | e.z) >= 0
}

/// The pixels whose centers the bounding box holds: first and last column and row, however far off the film.
#[must_use]
pub fn span(p: IVec3, q: IVec3, r: IVec3) -> IVec4 {
    let low = p.min(q).min(r);
    let high = p.max(q).max(r);
    IVec4::new((low.x + 127) >> 8, (low.y + 127) >> 8, (high.x - 128) >> 8, (high.y - 128) >> 8)
}

/// The same, on the film.
#[must_use]
pub fn on_film(lens: &Lens, span: IVec4) -> IVec4 {
    let [right, bottom] = [lens.width as i32 - 1, lens.height as i32 - 1];
    IVec4::new(span.x.max(0), span.y.max(0), span.z.min(right), span.w.min(bottom))
}
