//! vertices -> corners in fixed point, or the planes that they lie beyond

use glam::IVec3;

use super::snap::{outcode, snap, to_clip};
use crate::tables::{Corner, Lens, Vertex};

/// One vertex as the lens sees it.
#[must_use]
pub fn project(lens: &Lens, vertex: &Vertex) -> Corner {
    let c = to_clip(lens, vertex.position);
    let code = outcode(lens, c);
    Corner { at: if code == 0 { snap(lens, c) } else { IVec3::ZERO }, code }
}
