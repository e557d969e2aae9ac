//! small faces and the final depths -> the least id where the depth is theirs

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use super::behind::unveiled;
use super::speck::{Speck, each_pixel, speck};
use crate::tables::{CUT_OUT, Corner, Face, Lens, NONE};

/// One face, as [`split`](super::split::split) drew it.
pub fn mark(
    lens: &Lens,
    id: u32,
    face: &Face,
    corners: &[Corner],
    veil: &[[u32; 4]],
    nears: &[AtomicU32],
    ids: &[AtomicU32],
) {
    if face.paint & CUT_OUT != 0 {
        return;
    }
    if let Speck::Small { first, last, plan } = unveiled(lens, speck(lens, face, corners), veil) {
        each_pixel(lens, first, last, &plan, |pixel, near| {
            if nears[(lens.first + pixel) as usize].load(Relaxed) == near {
                ids[pixel as usize].fetch_max(NONE - id, Relaxed);
            }
        });
    }
}
