//! faces -> small ones drawn onto the image, and the numbers of all others

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use super::speck::{Speck, each_pixel, speck};
use crate::tables::{Corner, Face, Lens};

/// One face; whether it is to be drawn later.
pub fn split(lens: &Lens, face: &Face, corners: &[Corner], nears: &[AtomicU32]) -> bool {
    match speck(lens, face, corners) {
        Speck::Nothing => false,
        Speck::Late | Speck::Torn => true,
        Speck::Small { first, last, plan } => {
            each_pixel(lens, first, last, &plan, |pixel, near| {
                nears[(lens.first + pixel) as usize].fetch_max(near, Relaxed);
            });
            false
        }
    }
}
