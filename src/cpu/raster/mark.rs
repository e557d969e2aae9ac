//! small faces and the final depths -> the least id where the depth is theirs

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use super::facet::{Kind, facet};
use super::split::each_pixel;
use crate::tables::{Corner, Face, Lens};

/// One face, as [`split`](super::split::split) drew it.
pub fn mark(lens: &Lens, id: u32, face: &Face, corners: &[Corner], depths: &[AtomicU32], ids: &[AtomicU32]) {
    let [a, b, c] = [face.a, face.b, face.c].map(|i| corners[i as usize]);
    if a.code | b.code | c.code != 0 {
        return;
    }
    let f = facet(lens, face.paint, a.at, b.at, c.at);
    if f.kind == Kind::Small {
        each_pixel(lens, &f, |pixel, depth| {
            if depths[(lens.first + pixel) as usize].load(Relaxed) == depth {
                ids[pixel as usize].fetch_min(id, Relaxed);
            }
        });
    }
}
