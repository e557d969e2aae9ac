//! a lane's pixels of a tile, and a piece -> the nearer of both in each

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use super::plan::{Plan, covers, nearness};

/// A row of a tile's pixels. Where the sample is covered, the nearest is seen, and of equals the least id.
pub fn put(seen: &Plan, y: i32, id: u32, nears: &[AtomicU32], ids: &[AtomicU32]) {
    for (near, x) in nears.iter().zip(0..) {
        if !covers(seen, x, y) {
            continue;
        }
        let of = ids.get(x as usize);
        let before = (near.load(Relaxed), of.map_or(u32::MAX, |id| id.load(Relaxed)));
        let now = (nearness(&seen.nears, x, y), id);
        if now > before {
            near.store(now.0, Relaxed);
            if let Some(of) = of {
                of.store(id, Relaxed);
            }
        }
    }
}
