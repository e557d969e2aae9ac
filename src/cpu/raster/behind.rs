//! a speck -> nothing, if all that it could show is hidden
//!
//! As a hierarchical Z-buffer does it (Greene, Kass, Miller, 1993), with one level of it.

use super::speck::Speck;
use crate::tables::{CELL, Lens};

/// `veil`: of [`veil`](super::veil::veil), cell by cell; nothing is hidden where there is none.
#[must_use]
pub fn unveiled(lens: &Lens, speck: Speck, veil: &[[u32; 4]]) -> Speck {
    let Speck::Small { first, last, plan } = speck else { return speck };
    let side = CELL as i32;
    let cell = first / side;
    let further = last / side - cell;
    let Some(row) = veil.get(cell.y as usize * lens.cells()[1] as usize + cell.x as usize) else { return speck };
    let hidden = (plan.nears.most as u32) < row[further.max_element().min(3) as usize];
    if hidden { Speck::Nothing } else { speck }
}
