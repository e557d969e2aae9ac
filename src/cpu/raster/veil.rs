//! the farthest of each cell -> what hides a face that begins in it: the farthest of 1, of 2 x 2 and of 3 x 3 cells

use crate::tables::Lens;

/// One cell.
#[must_use]
pub fn veil(lens: &Lens, cells: &[u32], cell: u32) -> [u32; 4] {
    let [count, across] = lens.cells();
    let [x, y] = [cell % across, cell / across];
    let farthest = |side: u32| {
        let rows = y..(y + side).min(count / across);
        let around = rows.flat_map(|y| (x..(x + side).min(across)).map(move |x| y * across + x));
        around.map(|cell| cells[cell as usize]).min().unwrap_or(0)
    };
    [farthest(1), farthest(2), farthest(3), 0]
}
