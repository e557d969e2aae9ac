//! two pictures -> where they differ, and what the table of tolerances says of it

use crate::film::Film;
use crate::film::compare::{Comparison, Standard, compare};
use crate::tables::NONE;

/// What a difference is multiplied by, so that it is seen.
const GAIN: u8 = 16;

/// Where two pictures differ, and how much.
#[derive(Debug)]
pub struct Difference {
    /// The differences, made bright; as a screen has it.
    pub words: Vec<u32>,
    /// Pixels that differ.
    pub pixels: usize,
    /// The largest difference of a color, of 255.
    pub largest: u8,
    /// By the table.
    pub passes: bool,
}

/// The difference of two pictures of one size; nothing if they are of two.
#[must_use]
pub fn difference(size: [u32; 2], a: &[u32], b: &[u32], standard: Standard) -> Option<Difference> {
    let count = size[0] as usize * size[1] as usize;
    if a.len() != count || b.len() != count {
        return None;
    }
    let [one, other] = [a, b].map(|words| film(size, words));
    let verdict: Comparison = compare(&one, &other, standard).ok()?;
    let apart = |a: &u32, b: &u32| {
        let (a, b) = (a.to_le_bytes(), b.to_le_bytes());
        [0, 1, 2].map(|i| a[i].abs_diff(b[i]))
    };
    let each: Vec<[u8; 3]> = a.iter().zip(b).map(|(a, b)| apart(a, b)).collect();
    let bright = |[r, g, b]: [u8; 3]| {
        let [r, g, b] = [r, g, b].map(|part| part.saturating_mul(GAIN));
        u32::from_le_bytes([r, g, b, 255])
    };
    Some(Difference {
        pixels: each.iter().filter(|parts| **parts != [0; 3]).count(),
        largest: each.iter().flatten().copied().max().unwrap_or(0),
        words: each.into_iter().map(bright).collect(),
        passes: verdict.passes(),
    })
}

/// A picture as a film whose light is what a display is sent.
fn film([width, height]: [u32; 2], words: &[u32]) -> Film {
    let sums: Vec<[f32; 4]> = words
        .iter()
        .map(|word| {
            let [red, green, blue, _] = word.to_le_bytes().map(|byte| f32::from(byte) / 255.0);
            [red, green, blue, 1.0]
        })
        .collect();
    let mut film = Film::new(width, height);
    film.put(0, &sums, &vec![NONE; sums.len()]);
    film
}
