//! what a picture is known by <-> a note in its file, where programs that show it do not look

use std::fs::File;
use std::io::{BufReader, Read as _};
use std::path::Path;

/// What precedes it where the format has no name for notes.
pub(super) const NAME: &str = "twinlight";
/// The longest stamp; a TGA's note has at most 255 bytes.
const MOST: usize = 200;

/// The longest name of who made a picture: with a digest and a pass it is a stamp that every format has room for.
const MOST_NAME: usize = 100;

/// A name from outside as every format can hold it: in printable ASCII, since PNG and EXR know no more than Latin-1, and
/// of [`MOST_NAME`] bytes at most. Different names stay different.
#[must_use]
pub(crate) fn in_ascii(name: &str) -> String {
    let name = name.trim().escape_default().to_string();
    if name.len() <= MOST_NAME {
        return name;
    }
    let hash = blake3::hash(name.as_bytes()).to_hex();
    format!("{} {}", &name[..MOST_NAME - 17], &hash[..16])
}

/// A PNG's text chunk.
pub(super) fn into_png<W: std::io::Write>(
    encoder: &mut png::Encoder<'_, W>,
    stamp: &str,
) -> Result<(), png::EncodingError> {
    if stamp.is_empty() {
        return Ok(());
    }
    encoder.add_text_chunk(NAME.to_owned(), stamp.to_owned())
}

/// A TGA's image id, which stands between its 18 bytes of header and its pixels.
pub(super) fn into_tga(mut file: Vec<u8>, stamp: &str) -> Vec<u8> {
    let note = format!("{NAME} {stamp}");
    if stamp.is_empty() || stamp.len() > MOST || file.len() < 18 || file[0] != 0 {
        return file;
    }
    file[0] = note.len() as u8;
    file.splice(18..18, note.into_bytes());
    file
}

/// A PPM's comment.
pub(super) fn for_ppm(stamp: &str) -> String {
    if stamp.is_empty() { String::new() } else { format!("# {NAME} {stamp}\n") }
}

/// The stamp of a picture that Twinlight has written; nothing for any other file, or if there is none.
#[must_use]
pub fn stamp_of(path: &Path) -> Option<String> {
    // A pipe would wait for ever.
    if !path.metadata().is_ok_and(|about| about.is_file()) {
        return None;
    }
    let mut head = Vec::new();
    File::open(path).ok()?.take(512).read_to_end(&mut head).ok()?;
    if head.starts_with(b"\x89PNG") {
        let reader = png::Decoder::new(BufReader::new(File::open(path).ok()?)).read_info().ok()?;
        let texts = &reader.info().uncompressed_latin1_text;
        return texts.iter().find(|text| text.keyword == NAME).map(|text| text.text.clone());
    }
    if head.starts_with(b"\x76\x2f\x31\x01") {
        // An EXR's header is short where we wrote it.
        let mut head = Vec::new();
        File::open(path).ok()?.take(1 << 16).read_to_end(&mut head).ok()?;
        return super::exr::stamp_in(&head);
    }
    let note = if head.starts_with(b"P6\n# ") {
        head[5..].split(|b| *b == b'\n').next()?
    } else {
        head.get(18..18 + usize::from(*head.first()?))?
    };
    let note = std::str::from_utf8(note).ok()?;
    note.strip_prefix(NAME)?.strip_prefix(' ').map(str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::{Film, Format, exr, replace};

    #[test]
    fn a_picture_is_known_by_any_adapters_name() {
        let folder = tempfile::tempdir().expect("a folder");
        let long = "Graphics 770 ".repeat(40);
        let names = ["Arc\u{2122} B580", "\u{6469}\u{5c14} S80", "two\nlines\0", "caf\u{e9}", "RTX 4090", &long]
            .map(in_ascii);
        for name in &names {
            let stamp = format!("{} {name} +samples", blake3::hash(b"a picture").to_hex());
            for ending in ["png", "tga", "ppm", "exr"] {
                let path = folder.path().join(format!("a.{ending}"));
                let bytes = match Format::of(&path).expect("a format") {
                    Format::Exr => exr::encode(&Film::new(3, 2), &[], &stamp),
                    format => format.encode(&image::RgbImage::new(3, 2), &stamp),
                };
                replace(&path, &bytes.expect("a picture")).expect("a disk");
                assert_eq!(stamp_of(&path).as_ref(), Some(&stamp), "{ending}");
            }
        }
        assert_eq!((&*names[0], &*names[4]), ("Arc\\u{2122} B580", "RTX 4090"));
        assert_ne!(names[5], in_ascii(&(long.clone() + "x")), "they differ beyond what is kept of them");
    }

    #[test]
    fn what_an_exr_cannot_hold_is_an_error() {
        assert!(exr::encode(&Film::new(3, 2), &[], "Arc\u{2122}").is_err());
    }
}
