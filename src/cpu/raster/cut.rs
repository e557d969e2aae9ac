//! faces that are large or cross a plane -> pieces of them, bin by bin

use super::clip::clip;
use super::facet::{Facet, facet};
use super::reach::{Way, reach};
use super::snap::{snap, to_clip};
use crate::tables::{BIN, Face, Lens, Piece, TILE, Vertex};

/// The pieces of one face.
#[must_use]
pub fn cut(lens: &Lens, id: u32, face: &Face, vertices: &[Vertex]) -> Vec<Piece> {
    let corners = [face.a, face.b, face.c].map(|i| to_clip(lens, vertices[i as usize].position));
    let polygon: Vec<_> = clip(lens, corners).into_iter().map(|c| snap(lens, c)).collect();
    // What the planes leave of a face is a fan of triangles.
    let fan = (2..polygon.len()).map(|i| facet(lens, face.paint, polygon[0], polygon[i - 1], polygon[i]));
    fan.filter(|f| f.seen).flat_map(|f| sort(lens, &f, id)).collect()
}

/// One piece for each bin that the triangle may touch.
fn sort(lens: &Lens, f: &Facet, id: u32) -> Vec<Piece> {
    let under = f.bounds.as_uvec4() / (TILE * BIN);
    let bins = (under.y..=under.w).flat_map(|row| (under.x..=under.z).map(move |column| (column, row)));
    let [a, b, c] = f.corners;
    let pieces = bins.map(|(column, row)| Piece { a, id, b, column: column * BIN, c, row: row * BIN });
    pieces.filter(|piece| reach(lens, piece).how(0, 0, BIN * TILE) != Way::Missed).collect()
}
