//! a point and a light -> the share of the light that reaches it

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use glam::Vec3;

use super::snap::to_clip;
use crate::cpu::witness::{Sight, Texel, Witness};
use crate::tables::{DEEP, Lamp, Lens, NESTED, NO_DEPTH, NONE, POINT};

/// Which of its lenses a lamp sees a point through: for a point light, the axis that the way there is longest along; of a
/// nested one's two the first, if that sees it.
fn lens_of(lenses: &[Lens], lamp: &Lamp, p: Vec3) -> u32 {
    if lamp.kind == NESTED {
        let c = to_clip(&lenses[lamp.lens as usize], p);
        return lamp.lens + u32::from(!(c.x.abs() <= c.w && c.y.abs() <= c.w));
    }
    if lamp.kind != POINT {
        return lamp.lens;
    }
    let way = p - lamp.place;
    let size = way.abs();
    if size.x >= size.y && size.x >= size.z {
        return lamp.lens + u32::from(way.x < 0.0);
    }
    if size.y >= size.z {
        return lamp.lens + 2 + u32::from(way.y < 0.0);
    }
    lamp.lens + 4 + u32::from(way.z < 0.0)
}

/// What f32 rounds off two depths near one; more where they are the rest of larger numbers.
const ROUNDED: f32 = 2.384_185_8e-7;

/// Depths are compared as they were drawn, in integers. What the slope makes of a texel is in the drawn ones; the bias is
/// taken from the point's: a share of what the lens sees across there, which grows with the distance, while depths show
/// less of a way by its square.
#[must_use]
pub fn reaches(
    lenses: &[Lens],
    shadows: &[AtomicU32],
    blur: u32,
    lamp: &Lamp,
    p: Vec3,
    witness: &mut impl Witness,
) -> f32 {
    if lamp.lens == NONE {
        return 1.0;
    }
    let number = lens_of(lenses, lamp, p);
    let lens = &lenses[number as usize];
    let c = to_clip(lens, p);
    // What lies beyond the far plane lies behind all that is drawn.
    if !(c.x.abs() <= c.w && c.y.abs() <= c.w && c.z >= 0.0) {
        witness.shadow(&Sight { lens: number, clip: c, texel: None });
        return 1.0;
    }
    let (width, height) = (lens.width as i32, lens.height as i32);
    let column = ((c.x / c.w * 0.5 + 0.5) * width as f32).floor() as i32;
    let row = ((0.5 - c.y / c.w * 0.5) * height as f32).floor() as i32;
    let [x, y, z] = (lens.z.truncate() * p).abs().to_array();
    let rounded = ROUNDED + ROUNDED * ((((x + y) + z) + lens.z.w.abs()) / c.w);
    let bias = (lens.bias / c.w).max(rounded);
    let depth = ((c.z / c.w - bias).clamp(0.0, 1.0) * DEEP as f32) as u32;
    let blur = blur as i32;
    let mut open = 0;
    for j in -blur..=blur {
        for i in -blur..=blur {
            let at = (row + j).clamp(0, height - 1) * width + (column + i).clamp(0, width - 1);
            if depth <= NO_DEPTH - shadows[lens.first as usize + at as usize].load(Relaxed) {
                open += 1;
            }
        }
    }
    let asked = (2 * blur + 1) * (2 * blur + 1);
    let texel = Texel { column, row, depth, open: open as u32, asked: asked as u32 };
    witness.shadow(&Sight { lens: number, clip: c, texel: Some(texel) });
    open as f32 / asked as f32
}
