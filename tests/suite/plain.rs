//! A triangle test with nothing in lanes: the spec's inside test (2.3) as Woop, Benthin and Wald have it ("Watertight
//! Ray/Triangle Intersection", JCGT 2(1), 2013), with the same products and sums in the same order as both twins.

use twinlight::cpu::trace::seat::Seat;
use twinlight::math::Vec3;
use twinlight::tables::{FAR, Leaf, SPHERE};

/// As processors have it: `b`, if one of them is no number.
fn lesser(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// See [`lesser`].
fn larger(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

fn least([x, y, z]: [f32; 3]) -> f32 {
    lesser(x, lesser(y, z))
}

fn most([x, y, z]: [f32; 3]) -> f32 {
    larger(x, larger(y, z))
}

/// The distance to where the ray of a seat meets a leaf that is no plane; `number` as that of a hit.
pub(super) fn meet(seat: &Seat, leaf: &Leaf, number: u32) -> f32 {
    if leaf.kind == SPHERE {
        return seat.meet_sphere(leaf, number);
    }
    if seat.ray.leaves == number {
        return FAR;
    }
    let aim = &seat.aim;
    let from = [leaf.a, leaf.b, leaf.c].map(|corner| corner - seat.ray.origin);
    let turned = |v: Vec3| {
        let d = seat.ray.direction.abs();
        match (d.x > d.y && d.x > d.z, d.y > d.z) {
            (true, _) => [v.y, v.z, v.x],
            (_, true) => [v.z, v.x, v.y],
            _ => [v.x, v.y, v.z],
        }
    };
    let corners @ [a, b, c] = from.map(turned);
    let [[ax, ay], [bx, by], [cx, cy]] = corners.map(|[x, y, z]| [x - aim.shear.x * z, y - aim.shear.y * z]);
    let parts @ [u, v, w] = [cx * by - cy * bx, ax * cy - ay * cx, bx * ay - by * ax];
    let area = u + (v + w);
    if (least(parts) < 0.0 && most(parts) > 0.0) || area == 0.0 {
        return FAR;
    }
    let scaled = u * a[2] + (v * b[2] + w * c[2]);
    let sides = |corner: Vec3, side: f32| corner * aim.inverse + aim.own * side;
    let back = aim.inverse.cmplt(Vec3::ZERO);
    let low = from[0].min(from[1].min(from[2]));
    let high = from[0].max(from[1].max(from[2]));
    let enter = most(sides(Vec3::select(back, high, low), -1.0).to_array());
    let leave = least(sides(Vec3::select(back, low, high), 1.0).to_array());
    let t = larger(enter, lesser(leave, scaled * aim.shear.z / area));
    if t > 0.0 && (enter <= leave || enter.is_nan() || leave.is_nan()) { t } else { FAR }
}
