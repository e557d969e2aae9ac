//! the list of each tile -> the least (depth, id) of its pixels

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use glam::IVec2;

use super::plan::{covers, depth_at, plan};
use crate::tables::{Lens, NONE, Piece, TILE};

/// One tile; nobody else writes its pixels. `ids` is empty where they are not wanted.
pub fn cover(lens: &Lens, tile: u32, pieces: &[Piece], list: &[u32], depths: &[AtomicU32], ids: &[AtomicU32]) {
    let origin = IVec2::new((tile % lens.columns) as i32, (tile / lens.columns) as i32) * TILE as i32;
    let right = (lens.width as i32 - origin.x).min(TILE as i32);
    let bottom = (lens.height as i32 - origin.y).min(TILE as i32);
    for &entry in list {
        let piece = &pieces[entry as usize];
        let seen = plan(lens, piece.a, piece.b, piece.c, origin);
        for y in 0..bottom {
            for x in 0..right {
                if !covers(&seen, x, y) {
                    continue;
                }
                let at = (origin.y + y) as usize * lens.width as usize + (origin.x + x) as usize;
                let depth = &depths[lens.first as usize + at];
                let before = (depth.load(Relaxed), ids.get(at).map_or(NONE, |id| id.load(Relaxed)));
                let now = (depth_at(&seen, x, y), piece.id);
                if now < before {
                    depth.store(now.0, Relaxed);
                    if let Some(id) = ids.get(at) {
                        id.store(now.1, Relaxed);
                    }
                }
            }
        }
    }
}
