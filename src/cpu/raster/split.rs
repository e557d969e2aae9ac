//! corners -> small faces drawn into the depths, and pieces of all others

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use super::clip::clip;
use super::facet::{Facet, Kind, facet};
use super::plan::{covers, depth_at, plan};
use super::snap::{snap, to_clip};
use crate::tables::{Corner, Face, Lens, Piece, Vertex};

/// Every pixel that a small facet covers, with its depth there.
pub fn each_pixel(lens: &Lens, f: &Facet, mut visit: impl FnMut(u32, u32)) {
    let [p, q, r] = f.corners;
    let origin = f.bounds.truncate().truncate();
    let seen = plan(lens, p, q, r, origin);
    for y in f.bounds.y..=f.bounds.w {
        for x in f.bounds.x..=f.bounds.z {
            let (x_here, y_here) = (x - origin.x, y - origin.y);
            if covers(&seen, x_here, y_here) {
                visit(y as u32 * lens.width + x as u32, depth_at(&seen, x_here, y_here));
            }
        }
    }
}

fn piece(f: &Facet, id: u32) -> Piece {
    let [a, b, c] = f.corners;
    Piece { a, id, b, pad_b: 0, c, pad_c: 0 }
}

/// One face: draws it, or says what its pieces are.
pub fn split(
    lens: &Lens,
    id: u32,
    face: &Face,
    vertices: &[Vertex],
    corners: &[Corner],
    depths: &[AtomicU32],
    mut put_off: impl FnMut(Piece),
) {
    let numbers = [face.a, face.b, face.c].map(|i| i as usize);
    let [a, b, c] = numbers.map(|i| corners[i]);
    if a.code | b.code | c.code == 0 {
        let f = facet(lens, face.paint, a.at, b.at, c.at);
        match f.kind {
            Kind::Small => each_pixel(lens, &f, |pixel, depth| {
                depths[(lens.first + pixel) as usize].fetch_min(depth, Relaxed);
            }),
            Kind::Large => put_off(piece(&f, id)),
            Kind::Nothing => {}
        }
    } else if a.code & b.code & c.code == 0 {
        let polygon = clip(lens, numbers.map(|i| to_clip(lens, vertices[i].position)));
        let polygon: Vec<_> = polygon.into_iter().map(|c| snap(lens, c)).collect();
        // What the planes leave of a face is a fan of pieces.
        for i in 2..polygon.len() {
            let f = facet(lens, face.paint, polygon[0], polygon[i - 1], polygon[i]);
            if f.kind != Kind::Nothing {
                put_off(piece(&f, id));
            }
        }
    }
}
