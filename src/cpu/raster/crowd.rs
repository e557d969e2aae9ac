//! small faces -> how many of them each tile has, beside those of its lists

use super::speck::{Speck, speck};
use crate::tables::{Corner, Face, Lens, TILE};

/// Adds the faces to two numbers a tile; a small face that touches it counts as a piece that does.
pub fn crowd(lens: &Lens, faces: &[Face], corners: &[Corner], counts: &mut [u32]) {
    for face in faces {
        if let Speck::Small { first, last, .. } = speck(lens, face, corners) {
            let [first, last] = [first, last].map(|pixel| pixel.as_uvec2() / TILE);
            for row in first.y..=last.y {
                for column in first.x..=last.x {
                    counts[2 * (row * lens.columns + column) as usize + 1] += 1;
                }
            }
        }
    }
}
