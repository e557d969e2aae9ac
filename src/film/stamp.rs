//! what a picture is known by <-> a note in its file, where programs that show it do not look

use std::fs::File;
use std::io::{BufReader, Read as _};
use std::path::Path;

/// What precedes it where the format has no name for notes.
pub(super) const NAME: &str = "twinlight";
/// The longest stamp; a TGA's note has at most 255 bytes.
const MOST: usize = 200;

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
