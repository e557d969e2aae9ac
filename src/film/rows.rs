//! a picture, some rows after the others -> the bytes of a file, the same however the rows come

use std::io::{Cursor, Write};
use std::path::Path;

use image::{ImageFormat, RgbImage};

use super::save::Error;
use super::whole::Whole;
use super::{Format, stamp};

/// A picture of 8 bits a channel on its way to bytes.
pub(super) enum Rows<W: Write + 'static> {
    Png(Box<png::StreamWriter<'static, W>>),
    Tga(W),
    Ppm(W),
}

/// A TGA's header, which says nothing of what follows but its size.
const TGA_HEAD: usize = 18;

impl<W: Write + 'static> Rows<W> {
    /// Writes the head of a file; `stamp` is what the picture can be [known by](super::stamp_of) later.
    pub(super) fn new(format: Format, mut to: W, size: [u32; 2], stamp: &str) -> Result<Self, String> {
        let [width, height] = size;
        let failed = |error: std::io::Error| error.to_string();
        match format {
            Format::Png => {
                let mut encoder = png::Encoder::new(to, width, height);
                encoder.set_color(png::ColorType::Rgb);
                encoder.set_depth(png::BitDepth::Eight);
                let begun = stamp::into_png(&mut encoder, stamp).and_then(|()| encoder.write_header());
                let rows = begun.and_then(png::Writer::into_stream_writer);
                rows.map(|rows| Self::Png(Box::new(rows))).map_err(|error| error.to_string())
            }
            Format::Tga => {
                let side = |side: u32| u16::try_from(side).map_err(|_| "a TGA has at most 65535 pixels a side");
                let mut head = tga(&RgbImage::new(1, 1))?;
                head.truncate(TGA_HEAD);
                head[12..14].copy_from_slice(&side(width)?.to_le_bytes());
                head[14..16].copy_from_slice(&side(height)?.to_le_bytes());
                to.write_all(&stamp::into_tga(head, stamp)).map_err(failed)?;
                Ok(Self::Tga(to))
            }
            Format::Ppm => {
                let head = format!("P6\n{}{width} {height}\n255\n", stamp::for_ppm(stamp));
                to.write_all(head.as_bytes()).map_err(failed)?;
                Ok(Self::Ppm(to))
            }
            Format::Exr => Err("an OpenEXR file is made of a film, not of a picture of 8 bits".to_owned()),
        }
    }

    /// Writes the next rows.
    pub(super) fn push(&mut self, rows: &RgbImage) -> Result<(), String> {
        let done = match self {
            Self::Png(to) => to.write_all(rows),
            Self::Ppm(to) => to.write_all(rows),
            Self::Tga(to) => {
                // Packets end with their row, as the format asks for.
                for row in rows.chunks_exact(3 * rows.width() as usize) {
                    let row =
                        RgbImage::from_raw(rows.width(), 1, row.to_vec()).ok_or("a row has another length")?;
                    to.write_all(&tga(&row)?[TGA_HEAD..]).map_err(|error| error.to_string())?;
                }
                Ok(())
            }
        };
        done.map_err(|error| error.to_string())
    }

    /// Writes what is left, if all rows have come. What a file's last bytes meet is for the writer to remember: an
    /// encoder that is dropped tells nobody.
    pub(super) fn finish(self) -> Result<(), String> {
        match self {
            Self::Png(to) => to.finish().map_err(|error| error.to_string()),
            Self::Tga(mut to) | Self::Ppm(mut to) => to.flush().map_err(|error| error.to_string()),
        }
    }
}

fn tga(picture: &RgbImage) -> Result<Vec<u8>, String> {
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, ImageFormat::Tga).map_err(|error| error.to_string())?;
    Ok(bytes.into_inner())
}

/// A picture that becomes a file band by band, whole or not at all: without [`Growing::finish`] there is none.
pub struct Growing {
    rows: Rows<Whole>,
    whole: Whole,
}

impl std::fmt::Debug for Growing {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.whole.fmt(f)
    }
}

impl Growing {
    /// Begins a picture in the format of its name's ending; what stands there stays until it is whole.
    ///
    /// # Errors
    /// If the ending is unknown or has no rows, or the folder or disk refuses.
    pub fn begin(path: &Path, size: [u32; 2], stamp: &str) -> Result<Self, Error> {
        let format = Format::of(path)?;
        let whole = Whole::begin(path)?;
        let rows = Rows::new(format, whole.clone(), size, stamp);
        let rows = rows.map_err(|why| Error::Encode { path: path.to_owned(), why })?;
        Ok(Self { rows, whole })
    }

    /// Adds the next rows, of the picture's width.
    ///
    /// # Errors
    /// If the disk refuses, or there are more rows than were announced.
    pub fn push(&mut self, rows: &RgbImage) -> Result<(), Error> {
        let pushed = self.rows.push(rows);
        pushed.map_err(|why| self.whole.failure(why))
    }

    /// Gives the file its name; the BLAKE3 hash of its bytes.
    ///
    /// # Errors
    /// If rows are missing, or the disk refuses; what stood there before is then untouched.
    pub fn finish(self) -> Result<blake3::Hash, Error> {
        let Self { rows, whole } = self;
        rows.finish().map_err(|why| whole.failure(why))?;
        whole.finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(height: u32) -> RgbImage {
        RgbImage::from_fn(37, height, |x, y| image::Rgb([x as u8, (x * y) as u8, if x < 20 { 7 } else { y as u8 }]))
    }

    #[test]
    fn bands_do_not_show_in_the_file() {
        let folder = tempfile::tempdir().expect("a folder");
        for name in ["a.png", "a.tga", "a.ppm"] {
            let path = folder.path().join(name);
            let whole = Format::of(&path).expect("a format").encode(&picture(40), "stamp").expect("a file");
            for step in [1, 7, 39] {
                let mut bands = Growing::begin(&path, [37, 40], "stamp").expect("begun");
                for top in (0..40).step_by(step) {
                    let rows = (step as u32).min(40 - top);
                    let band = image::imageops::crop_imm(&picture(40), 0, top, 37, rows).to_image();
                    bands.push(&band).expect("pushed");
                }
                assert_eq!(bands.finish().expect("finished"), blake3::hash(&whole), "{name} by {step}");
                assert!(std::fs::read(&path).expect("there") == whole, "{name} by {step}");
            }
            let read = image::load_from_memory_with_format(
                &whole,
                if name == "a.ppm" {
                    image::ImageFormat::Pnm
                } else {
                    image::ImageFormat::from_path(name).expect("known")
                },
            );
            assert_eq!(read.expect("a picture").to_rgb8(), picture(40), "{name}");
            assert_eq!(super::super::stamp_of(&path).as_deref(), Some("stamp"), "{name}");
        }
    }

    #[test]
    fn what_is_not_whole_is_not_there() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.png");
        std::fs::write(&path, "old").expect("written");
        let mut bands = Growing::begin(&path, [37, 40], "").expect("begun");
        bands.push(&picture(39)).expect("pushed");
        assert!(matches!(bands.finish(), Err(Error::Encode { .. })));
        assert_eq!(std::fs::read(&path).expect("there"), b"old");
        assert_eq!(std::fs::read_dir(folder.path()).expect("the folder").count(), 1);
    }
}
