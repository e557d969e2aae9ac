//! a saved picture -> the same with as many pixels as the one that it is held against

use std::path::{Path, PathBuf};

use image::imageops::FilterType;
use image::{ImageReader, Limits, RgbImage};

/// Pixels across or down that a picture may have.
const MOST: u32 = 16_384;
/// Bytes that reading one may take.
const MOST_BYTES: u64 = 1 << 30;

/// A picture that was saved.
#[derive(Debug, Clone)]
pub struct Saved {
    path: PathBuf,
    picture: RgbImage,
}

/// Whether a file's name is one of a picture, and not of a scene.
#[must_use]
pub fn is_picture(path: &Path) -> bool {
    let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    ["png", "jpg", "jpeg", "tga", "ppm"].contains(&ending.as_str())
}

impl Saved {
    /// Reads a picture: .png, .jpg, .tga or .ppm.
    ///
    /// # Errors
    /// A sentence that names the file.
    pub fn open(path: &Path) -> Result<Self, String> {
        let wrong = |why: String| format!("{}: {why}", path.display());
        let mut reader = ImageReader::open(path).map_err(|error| wrong(error.to_string()))?;
        let mut limits = Limits::default();
        (limits.max_image_width, limits.max_image_height) = (Some(MOST), Some(MOST));
        limits.max_alloc = Some(MOST_BYTES);
        reader.limits(limits);
        let picture = reader.decode().map_err(|error| wrong(error.to_string()))?.into_rgb8();
        Ok(Self { path: path.to_owned(), picture })
    }

    /// Where it lies.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Pixels across and down.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        [self.picture.width(), self.picture.height()]
    }

    /// So many pixels of it, as a screen has them: its own if it has as many, else means or copies of them.
    #[must_use]
    pub fn words(&self, size: [u32; 2]) -> Vec<u32> {
        let [width, height] = size;
        let fits = self.size() == size;
        let scaled = (!fits).then(|| image::imageops::resize(&self.picture, width, height, FilterType::Triangle));
        let picture = scaled.as_ref().unwrap_or(&self.picture);
        picture.pixels().map(|p| u32::from_le_bytes([p[0], p[1], p[2], 255])).collect()
    }
}
