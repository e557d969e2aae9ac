//! The film: all that a renderer may write, and the only thing that knows how to become a file.

pub mod compare;
pub mod exr;
pub mod ledger;
pub mod merge;
mod moving;
pub mod pass;
mod save;
mod stamp;
mod transfer;
mod watch;

pub use moving::Moving;
pub use save::{Error, Format, folder_of, replace, sweep, write_whole};
pub use stamp::stamp_of;
pub use transfer::{Transfer, decode_hex};
pub use watch::{Run, Watch};

use glam::Vec3;

/// Linear sums of samples and the id of what is seen first, row by row from the top left.
#[derive(Debug, Clone, PartialEq)]
pub struct Film {
    width: u32,
    height: u32,
    /// Red, green, blue and the number of samples in the sum.
    sums: Vec<[f32; 4]>,
    /// The primitive that the first ray met, or [`NONE`](crate::tables::NONE).
    ids: Vec<u32>,
}

impl Film {
    /// A film without light.
    #[must_use]
    pub fn new(width: u32, height: u32) -> Self {
        let pixels = width as usize * height as usize;
        Self { width, height, sums: vec![[0.0; 4]; pixels], ids: vec![crate::tables::NONE; pixels] }
    }

    /// Bytes that a film of this size takes with its 8-bit picture.
    #[must_use]
    pub fn bytes(width: u32, height: u32) -> u64 {
        u64::from(width) * u64::from(height) * (16 + 4 + 3)
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
