//! pictures one after the other -> an animated PNG

use std::io::Write;
use std::sync::{Arc, Mutex, PoisonError};

use image::RgbImage;

use super::stamp;

/// An animated PNG in the making.
pub struct Moving {
    writer: png::Writer<Bytes>,
    bytes: Bytes,
}

/// The encoder keeps its writer for itself.
#[derive(Debug, Clone, Default)]
pub(super) struct Bytes(Arc<Mutex<Vec<u8>>>);

impl Bytes {
    /// What was written.
    pub(super) fn take(&self) -> Vec<u8> {
        std::mem::take(&mut *self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

impl Write for Bytes {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

impl Moving {
    /// So many pictures of this size, each shown for as long as `rate` pictures a second want it, again and again.
    ///
    /// # Errors
    /// What the encoder says.
    pub fn new(size: [u32; 2], pictures: u32, rate: f32, stamp: &str) -> Result<Self, String> {
        let bytes = Bytes::default();
        let mut encoder = png::Encoder::new(bytes.clone(), size[0], size[1]);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        // A fraction of two 16-bit numbers.
        let (count, parts) = if rate < 1.0 { (100.0 / rate, 100.0) } else { (250.0, rate * 250.0) };
        let told = encoder
            .set_animated(pictures, 0)
            .and_then(|()| encoder.set_frame_delay(count.round() as u16, parts.round() as u16))
            .and_then(|()| stamp::into_png(&mut encoder, stamp));
        told.map_err(|error| error.to_string())?;
        let writer = encoder.write_header().map_err(|error| error.to_string())?;
        Ok(Self { writer, bytes })
    }

    /// Adds the next picture.
    ///
    /// # Errors
    /// What the encoder says, of another size for one.
    pub fn push(&mut self, picture: &RgbImage) -> Result<(), String> {
        self.writer.write_image_data(picture).map_err(|error| error.to_string())
    }

    /// The file's bytes.
    ///
    /// # Errors
    /// If there are less pictures than were announced.
    pub fn finish(self) -> Result<Vec<u8>, String> {
        self.writer.finish().map_err(|error| error.to_string())?;
        Ok(self.bytes.take())
    }
}
