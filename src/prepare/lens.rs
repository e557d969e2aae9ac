//! a pose and a frustum or box -> the lens that sees it (spec 1.2.1 and 1.2.3)

use glam::{DVec3, Vec3, Vec4};

use crate::tables::{Lens, TILE};

/// Pixels from the middle of the film that fixed point reaches to.
const REACH: f32 = 8191.0;
/// Where a lens is and which way it looks: the spec's R, U, D, of length one.
#[derive(Debug, Clone, Copy)]
pub struct Pose {
    /// In world space.
    pub eye: Vec3,
    /// R, U, D.
    pub axes: [Vec3; 3],
}

fn row(axis: DVec3, eye: Vec3, times: f64, plus: f64) -> Vec4 {
    let part = axis * times;
    part.as_vec3().extend((plus - part.dot(eye.as_dvec3())) as f32)
}

fn lens(size: [u32; 2], [x, y, z, w]: [Vec4; 4]) -> Lens {
    let [width, height] = size;
    Lens {
        x,
        y,
        z,
        w,
        width,
        height,
        first: 0,
        columns: width.div_ceil(TILE),
        cull: 0,
        zero: 0,
        bias: 0.0,
        slope: 0,
        guard_x: REACH * 2.0 / width as f32,
        guard_y: REACH * 2.0 / height as f32,
        small: 16,
        round: 0,
        span_x: width,
        span_y: height,
        left: 0,
        top: 0,
    }
}

/// A frustum: `half` is the tangent of half the field of view, across and up; `shift` moves the picture, in pixels.
#[must_use]
pub fn perspective(pose: &Pose, half: [f32; 2], [near, far]: [f32; 2], size: [u32; 2], shift: [f32; 2]) -> Lens {
    let [right, up, back] = pose.axes.map(Vec3::as_dvec3);
    let (near, far) = (f64::from(near), f64::from(far));
    let share = far / (far - near);
    let w = row(back, pose.eye, -1.0, 0.0);
    let x = row(right, pose.eye, 1.0 / f64::from(half[0]), 0.0) + w * (shift[0] * 2.0 / size[0] as f32);
    let y = row(up, pose.eye, 1.0 / f64::from(half[1]), 0.0) - w * (shift[1] * 2.0 / size[1] as f32);
    // The spec's projection, with z from 0 to w instead of from -w to w.
    let z = row(back, pose.eye, -share, -near * share);
    // Clip z is share * (w - near): a way along the axis shows in z / w by near * share / w^2, and one as long as the
    // film is wide there, 2 * half * w, by as much times 2 * half * w.
    Lens { bias: (near * share) as f32 * 2.0 * half[0], ..lens(size, [x, y, z, w]) }
}

/// A box: `half` is half its size, across and up.
#[must_use]
pub fn orthographic(pose: &Pose, half: [f32; 2], [near, far]: [f32; 2], size: [u32; 2]) -> Lens {
    let [right, up, back] = pose.axes.map(Vec3::as_dvec3);
    let deep = 1.0 / (f64::from(far) - f64::from(near));
    let x = row(right, pose.eye, 1.0 / f64::from(half[0]), 0.0);
    let y = row(up, pose.eye, 1.0 / f64::from(half[1]), 0.0);
    let z = row(back, pose.eye, -deep, -f64::from(near) * deep);
    Lens { bias: deep as f32 * 2.0 * half[0], ..lens(size, [x, y, z, Vec4::W]) }
}
