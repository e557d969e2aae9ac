//! The film: all that a renderer may write, and the only thing that knows how to become a file.

mod band;
pub mod compare;
pub mod exr;
pub mod ledger;
pub mod merge;
mod moving;
pub mod pass;
mod rows;
mod save;
mod saved;
mod stamp;
mod transfer;
mod watch;
mod whole;

pub use band::{Band, split};
pub use moving::Moving;
pub use rows::Growing;
pub use save::{Error, Format, folder_of, replace, sweep, write_whole};
pub use saved::{Saved, is_picture};
pub(crate) use stamp::in_ascii;
pub use stamp::stamp_of;
pub use transfer::{Transfer, decode_hex};
pub use watch::{Run, Share, Watch};

use glam::Vec3;

use crate::math::vector::luminance;

/// Linear sums of samples and the id of what is seen first, row by row from the top left.
#[derive(Debug, Clone, PartialEq)]
pub struct Film {
    width: u32,
    height: u32,
    /// Red, green, blue and the number of samples in the sum.
    sums: Vec<[f32; 4]>,
    /// Of the samples' luminances, summed; none where the samples are not told apart.
    squares: Vec<f32>,
    /// The primitive that the first ray met, or [`NONE`](crate::tables::NONE).
    ids: Vec<u32>,
}

/// The variance of samples, without bias, from the sum of their colors and that of their luminances' squares.
#[must_use]
pub fn variance([red, green, blue, samples]: [f32; 4], squares: f32) -> f64 {
    if samples < 2.0 {
        return 0.0;
    }
    let (sum, n) = (f64::from(luminance(Vec3::new(red, green, blue))), f64::from(samples));
    ((f64::from(squares) - sum * sum / n) / (n - 1.0)).max(0.0)
}

impl Film {
    /// A film without light.
    #[must_use]
    pub fn new(width: u32, height: u32) -> Self {
        let pixels = width as usize * height as usize;
        let (sums, ids) = (vec![[0.0; 4]; pixels], vec![crate::tables::NONE; pixels]);
        Self { width, height, sums, squares: Vec::new(), ids }
    }

    /// Bytes that a film of this size takes with its 8-bit picture.
    #[must_use]
    pub fn bytes(width: u32, height: u32) -> u64 {
        u64::from(width) * u64::from(height) * (16 + 4 + 4 + 3)
    }

    /// Pixels in a row.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    #[must_use]
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Pixels in all.
    #[must_use]
    pub fn pixels(&self) -> u32 {
        self.width * self.height
    }

    /// Lays a finished run of pixels onto the film.
    ///
    /// # Panics
    /// If the run reaches past the film's end.
    pub fn put(&mut self, first: u32, sums: &[[f32; 4]], ids: &[u32]) {
        let first = first as usize;
        self.sums[first..first + sums.len()].copy_from_slice(sums);
        self.ids[first..first + ids.len()].copy_from_slice(ids);
    }

    /// Lays the squares of the luminances of a finished run's samples onto the film.
    ///
    /// # Panics
    /// If the run reaches past the film's end.
    pub fn put_squares(&mut self, first: u32, squares: &[f32]) {
        self.squares.resize(self.sums.len(), 0.0);
        let first = first as usize;
        self.squares[first..first + squares.len()].copy_from_slice(squares);
    }

    /// Lays a finished rectangle onto the film, its first pixel at this column and row.
    ///
    /// # Panics
    /// If it reaches past an edge, or is not a rectangle.
    pub fn lay(&mut self, [column, row]: [u32; 2], width: u32, sums: &[[f32; 4]], ids: &[u32]) {
        let rows = sums.chunks_exact(width as usize).zip(ids.chunks_exact(width as usize));
        for ((sums, ids), row) in rows.zip(row..) {
            self.put(row * self.width + column, sums, ids);
        }
    }

    /// The mean of a pixel's samples, linear; black where there is none.
    ///
    /// # Panics
    /// If there is no such pixel.
    #[must_use]
    pub fn color(&self, pixel: u32) -> Vec3 {
        let [red, green, blue, samples] = self.sums[pixel as usize];
        if samples == 0.0 { Vec3::ZERO } else { Vec3::new(red, green, blue) / samples }
    }

    /// What is seen first at a pixel.
    ///
    /// # Panics
    /// If there is no such pixel.
    #[must_use]
    pub fn id(&self, pixel: u32) -> u32 {
        self.ids[pixel as usize]
    }

    /// How many samples a pixel has.
    ///
    /// # Panics
    /// If there is no such pixel.
    #[must_use]
    pub fn samples(&self, pixel: u32) -> f32 {
        self.sums[pixel as usize][3]
    }

    /// Of each pixel's samples' luminances, summed; none where the samples are not told apart.
    #[must_use]
    pub fn squares(&self) -> &[f32] {
        &self.squares
    }

    /// How far a pixel's samples lie apart: the variance of their luminances, without bias. Zero of a single sample;
    /// nothing where the samples are not told apart.
    ///
    /// # Panics
    /// If there is no such pixel.
    #[must_use]
    pub fn variance(&self, pixel: u32) -> Option<f32> {
        Some(variance(self.sums[pixel as usize], *self.squares.get(pixel as usize)?) as f32)
    }

    /// How many samples a pixel has in the mean, to one digit.
    #[must_use]
    pub fn mean_samples(&self) -> f64 {
        let all: f64 = self.sums.iter().map(|sum| f64::from(sum[3])).sum();
        (all / f64::from(self.pixels()) * 10.0).round() / 10.0
    }

    /// Red, green, blue and the number of samples in the sum, pixel by pixel.
    #[must_use]
    pub fn sums(&self) -> &[[f32; 4]] {
        &self.sums
    }

    /// What is seen first, pixel by pixel.
    #[must_use]
    pub fn ids(&self) -> &[u32] {
        &self.ids
    }

    /// Pixels whose color is not a finite number; they are black in a picture.
    #[must_use]
    pub fn broken(&self) -> u32 {
        (0..self.pixels()).filter(|&p| !self.color(p).is_finite()).count() as u32
    }

    /// The picture in 8 bits a channel.
    #[must_use]
    pub fn to_rgb8(&self, transfer: Transfer) -> image::RgbImage {
        image::RgbImage::from_fn(self.width, self.height, |x, y| {
            let color = self.color(y * self.width + x);
            let color = if color.is_finite() { color } else { Vec3::ZERO };
            image::Rgb(color.to_array().map(|c| transfer.encode(c)))
        })
    }
}

/// A picture of words with red in the lowest byte, row by row.
///
/// # Panics
/// If there are fewer words than pixels.
#[must_use]
pub fn picture_of([width, height]: [u32; 2], words: &[u32]) -> image::RgbImage {
    image::RgbImage::from_fn(width, height, |x, y| {
        let [red, green, blue, _] = words[(y * width + x) as usize].to_le_bytes();
        image::Rgb([red, green, blue])
    })
}
