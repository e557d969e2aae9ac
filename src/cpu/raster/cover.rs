//! the lists of each tile -> the nearest of its pixels, and the least id of those

use std::sync::atomic::AtomicU32;

use glam::IVec2;

use super::pixels::put;
use super::plan::plan;
use crate::tables::{Lens, NONE, Piece, TILE};

/// One tile with both its lists; nobody else writes its pixels. `ids` is empty where they are not wanted.
pub fn cover(lens: &Lens, tile: u32, pieces: &[Piece], list: &[u32], nears: &[AtomicU32], ids: &[AtomicU32]) {
    let origin = IVec2::new((tile % lens.columns) as i32, (tile / lens.columns) as i32) * TILE as i32;
    let right = (lens.width as i32 - origin.x).min(TILE as i32);
    let bottom = (lens.height as i32 - origin.y).min(TILE as i32);
    for &entry in list {
        let piece = &pieces[entry as usize];
        let seen = plan(lens, [piece.a, piece.b, piece.c], origin);
        for y in 0..bottom {
            let row = (origin.y + y) as usize * lens.width as usize + origin.x as usize;
            let nears = &nears[lens.first as usize + row..][..right as usize];
            let ids = ids.get(row..row + right as usize).unwrap_or_default();
            put(&seen, y, NONE - piece.id, nears, ids);
        }
    }
}
