//! faces -> small ones drawn onto the image, and the numbers of all others

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use super::behind::unveiled;
use super::speck::{Speck, each_pixel, speck};
use crate::tables::{CUT_OUT, Corner, Face, Lens};

/// One face; whether it is to be drawn later. `lace`: cut-out faces, none of which is drawn at once, else all others.
pub fn split(
    lens: &Lens,
    face: &Face,
    corners: &[Corner],
    lace: bool,
    veil: &[[u32; 4]],
    nears: &[AtomicU32],
) -> bool {
    if (face.paint & CUT_OUT != 0) != lace {
        return false;
    }
    let speck = speck(lens, face, corners);
    match if lace { speck } else { unveiled(lens, speck, veil) } {
        Speck::Nothing => false,
        Speck::Late | Speck::Torn => true,
        Speck::Small { .. } if lace => true,
        Speck::Small { first, last, plan } => {
            each_pixel(lens, first, last, &plan, |pixel, near| {
                nears[(lens.first + pixel) as usize].fetch_max(near, Relaxed);
            });
            false
        }
    }
}
