//! a piece -> the tiles of its bin that it may touch

use glam::{IVec2, IVec3, IVec4, UVec4};

use super::plan::{edge, on_film, span};
use crate::tables::{BIN, Lens, Piece, TILE};

/// A piece's edges as seen from its bin.
#[derive(Debug, Clone, Copy)]
pub struct Reach {
    /// What each edge grows by from column to column.
    pub a: IVec3,
    /// What each edge grows by from row to row.
    pub b: IVec3,
    /// Each edge at the bin's first pixel.
    pub e: IVec3,
    /// First and last column and row of the tiles under the bounding box, counted from the bin's first.
    pub tiles: UVec4,
}

/// The edges and tiles of a piece.
#[must_use]
pub fn reach(lens: &Lens, piece: &Piece) -> Reach {
    let first = IVec2::new(piece.column as i32, piece.row as i32);
    let origin = first * TILE as i32;
    let edges = [(piece.a, piece.b), (piece.b, piece.c), (piece.c, piece.a)].map(|(p, q)| edge(p, q, origin));
    let under = on_film(lens, span(piece.a, piece.b, piece.c)) / TILE as i32;
    let tiles = under - IVec4::new(first.x, first.y, first.x, first.y);
    Reach {
        a: IVec3::from_array(edges.map(|e| e.x)),
        b: IVec3::from_array(edges.map(|e| e.y)),
        e: IVec3::from_array(edges.map(|e| e.z)),
        tiles: tiles.clamp(IVec4::ZERO, IVec4::splat(BIN as i32 - 1)).as_uvec4(),
    }
}

/// What of a square of pixels is covered.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// All of them.
    Covered,
    /// Perhaps some.
    Touched,
    /// None.
    Missed,
}

impl Reach {
    /// What of a square of pixels is covered, each edge asked at the pixel where it is largest and where it is least.
    /// `side` is the square's, and tiles are counted from the bin's first.
    #[must_use]
    pub fn how(&self, column: u32, row: u32, side: u32) -> Way {
        let e = self.e + self.a * (column * TILE) as i32 + self.b * (row * TILE) as i32;
        let across = side as i32 - 1;
        let most = e + (self.a.max(IVec3::ZERO) + self.b.max(IVec3::ZERO)) * across;
        let least = e + (self.a.min(IVec3::ZERO) + self.b.min(IVec3::ZERO)) * across;
        if (most.x | most.y | most.z) < 0 {
            Way::Missed
        } else if (least.x | least.y | least.z) >= 0 {
            Way::Covered
        } else {
            Way::Touched
        }
    }
}

/// The numbers of all lists that the piece belongs to: each tile has one of pieces that cover all of it, and one of those
/// that touch it.
pub fn each_list(lens: &Lens, piece: &Piece, mut visit: impl FnMut(usize)) {
    let reach = reach(lens, piece);
    for row in reach.tiles.y..=reach.tiles.w {
        for column in reach.tiles.x..=reach.tiles.z {
            let way = reach.how(column, row, TILE);
            if way != Way::Missed {
                let tile = (piece.row + row) * lens.columns + piece.column + column;
                visit(2 * tile as usize + usize::from(way == Way::Touched));
            }
        }
    }
}
