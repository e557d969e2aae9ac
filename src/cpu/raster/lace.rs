//! the lists of each tile -> the nearest of its pixels where a cut-out face is there, and the least id of those

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use glam::{IVec2, Vec2};

use super::plan::{covers, nearness, plan};
use super::snap::to_clip;
use super::weights::weights_inside;
use crate::cpu::shade::look::uv_by;
use crate::cpu::shade::texture::is_there;
use crate::tables::{CUT_OUT, Drawing, Lens, NONE, ONE_SIDED, Piece, REGION, TILE};

/// Whether the face is there at a pixel's center.
fn stays(drawing: &Drawing, lens: &Lens, id: u32, pixel: IVec2) -> bool {
    let face = drawing.faces[id as usize];
    let paint = &drawing.paints[(face.paint & !(ONE_SIDED | CUT_OUT)) as usize];
    let corners = [face.a, face.b, face.c].map(|i| &drawing.vertices[i as usize]);
    let at = [(lens.left % REGION) as i32 + pixel.x, (lens.top % REGION) as i32 + pixel.y];
    let at = Vec2::from_array(at.map(|side| side as f32)) + 0.5;
    let w = weights_inside(lens, corners.map(|vertex| to_clip(lens, vertex.position)), at);
    is_there(&drawing.texels, drawing.canvas.filtering, &paint.opacity_map, uv_by(w, corners))
}

/// One tile with both its lists; nobody else writes its pixels. `ids` is empty where they are not wanted.
pub fn lace(
    drawing: &Drawing,
    lens: &Lens,
    tile: u32,
    (pieces, list): (&[Piece], &[u32]),
    nears: &[AtomicU32],
    ids: &[AtomicU32],
) {
    let origin = IVec2::new((tile % lens.columns) as i32, (tile / lens.columns) as i32) * TILE as i32;
    let right = (lens.width as i32 - origin.x).min(TILE as i32);
    let bottom = (lens.height as i32 - origin.y).min(TILE as i32);
    for &entry in list {
        let piece = &pieces[entry as usize];
        let seen = plan(lens, [piece.a, piece.b, piece.c], origin);
        for (x, y) in (0..bottom).flat_map(|y| (0..right).map(move |x| (x, y))) {
            if !covers(&seen, x, y) {
                continue;
            }
            let pixel = origin + IVec2::new(x, y);
            let at = pixel.y as usize * lens.width as usize + pixel.x as usize;
            let (near, id) = (&nears[lens.first as usize + at], ids.get(at));
            let now = (nearness(&seen.nears, x, y), NONE - piece.id);
            let best = (near.load(Relaxed), id.map_or(NONE, |id| id.load(Relaxed)));
            if now > best && stays(drawing, lens, piece.id, pixel) {
                near.store(now.0, Relaxed);
                if let Some(id) = id {
                    id.store(now.1, Relaxed);
                }
            }
        }
    }
}
