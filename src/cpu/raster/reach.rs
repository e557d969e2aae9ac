//! a piece -> the tiles that it may touch

use glam::IVec2;

use super::plan::{misses, on_film, plan, span};
use crate::tables::{Lens, Piece, TILE};

/// The numbers of all tiles that the piece may cover a pixel of.
pub fn each_tile(lens: &Lens, piece: &Piece, mut visit: impl FnMut(usize)) {
    let under = on_film(lens, span(piece.a, piece.b, piece.c)) / TILE as i32;
    for row in under.y..=under.w {
        for column in under.x..=under.z {
            let origin = IVec2::new(column, row) * TILE as i32;
            if !misses(&plan(lens, piece.a, piece.b, piece.c, origin)) {
                visit(row as usize * lens.columns as usize + column as usize);
            }
        }
    }
}
