//! a picture -> a file, whole or not at all

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::time::Duration;

use image::RgbImage;

use super::moving::Bytes;
use super::rows::Rows;
use super::whole::Whole;

/// Why a picture has not been written.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The name's ending is none that we write.
    #[error("{}: a picture's name ends in .png, .exr, .tga or .ppm", .0.display())]
    Ending(PathBuf),
    /// The picture does not fit the format.
    #[error("{}: {why}", path.display())]
    Encode {
        /// The file that was to be written.
        path: PathBuf,
        /// What the encoder says.
        why: String,
    },
    /// The folder or disk refused.
    #[error("{}: cannot write: {} (a picture that stood here before is untouched)", path.display(), why(path, source))]
    Write {
        /// The file that was to be written.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
}

fn why(path: &Path, source: &std::io::Error) -> String {
    let folder = folder_of(path);
    if folder.is_dir() { source.to_string() } else { format!("there is no folder {}", folder.display()) }
}

/// A picture format that we write.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// PNG, 8 bits a channel.
    Png,
    /// Truevision TGA, run-length encoded.
    Tga,
    /// Binary PPM (P6).
    Ppm,
    /// EXR, linear and in full precision: of films alone, by [`exr::encode`](super::exr::encode).
    Exr,
}

impl Format {
    /// The format that a file's ending asks for.
    ///
    /// # Errors
    /// [`Error::Ending`] if it is none of ours.
    pub fn of(path: &Path) -> Result<Self, Error> {
        let ending = path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
        match ending.as_deref() {
            Some("png") => Ok(Self::Png),
            Some("tga") => Ok(Self::Tga),
            Some("ppm") => Ok(Self::Ppm),
            Some("exr") => Ok(Self::Exr),
            _ => Err(Error::Ending(path.to_owned())),
        }
    }

    /// The file's bytes; `stamp` is what the picture can be [known by](super::stamp_of) later.
    ///
    /// # Errors
    /// What the encoder says, if the picture does not fit the format.
    pub fn encode(self, picture: &RgbImage, stamp: &str) -> Result<Vec<u8>, String> {
        let bytes = Bytes::default();
        let mut rows = Rows::new(self, bytes.clone(), picture.dimensions().into(), stamp)?;
        rows.push(picture)?;
        rows.finish()?;
        Ok(bytes.take())
    }
}

/// Writes a picture in the format of its name's ending, whole or not at all.
///
/// # Errors
/// If the ending is unknown, or the folder or disk refuses; what stood there before is then untouched.
pub fn write_whole(path: &Path, picture: &RgbImage) -> Result<(), Error> {
    let encoded = Format::of(path)?.encode(picture, "");
    let bytes = encoded.map_err(|why| Error::Encode { path: path.to_owned(), why })?;
    replace(path, &bytes)
}

/// Writes a file, whole or not at all.
///
/// # Errors
/// If the folder or disk refuses; what stood there before is then untouched.
pub fn replace(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    let mut file = Whole::begin(path)?;
    // What is refused here, the end tells.
    let _ = file.write_all(bytes);
    file.finish().map(|_| ())
}

/// The folder that a file is in.
#[must_use]
pub fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

pub(super) const PREFIX: &str = ".twinlight-";
pub(super) const SUFFIX: &str = ".part";
/// A file is written within seconds; one that is this old has lost its process.
const OLD: Duration = Duration::from_hours(1);

/// Removes from a folder what processes have left there that were killed while they wrote.
pub fn sweep(folder: &Path) {
    for entry in folder.read_dir().into_iter().flatten().flatten() {
        let name = entry.file_name();
        let ours = name.to_str().is_some_and(|name| name.starts_with(PREFIX) && name.ends_with(SUFFIX));
        let old = || entry.metadata().ok()?.modified().ok()?.elapsed().ok();
        if ours && old().is_some_and(|age| age > OLD) {
            let _ = std::fs::remove_file(entry.path());
        }
    }
}
