//! sums of samples -> the bytes that a display is sent, red first

use rayon::prelude::*;

use crate::film::Transfer;
use crate::math::whole::whole;
use crate::tables::{Print, SRGB};

/// The words of a picture, `print.pitch` from row to row; red in the lowest byte, and nothing is transparent.
#[must_use]
pub fn develop(print: &Print, sums: &[[f32; 4]]) -> Vec<u32> {
    let transfer = if print.transfer == SRGB { Transfer::Srgb } else { Transfer::None };
    let mut words = vec![0; (print.pitch * print.down) as usize];
    words.par_chunks_mut(print.pitch as usize).zip(0..print.down).for_each(|(row, y)| {
        for (word, x) in row.iter_mut().zip(0..print.across) {
            let at = whole(y * print.height, print.down) * print.width + whole(x * print.width, print.across);
            let [red, green, blue, samples] = sums[at as usize];
            let color = if samples > 0.0 { [red, green, blue].map(|part| part / samples) } else { [0.0; 3] };
            // What is not a finite number is black.
            let color = if color.iter().all(|part| part.is_finite()) { color } else { [0.0; 3] };
            let [red, green, blue] = color.map(|part| transfer.encode(part));
            *word = u32::from_le_bytes([red, green, blue, 255]);
        }
    });
    words
}
