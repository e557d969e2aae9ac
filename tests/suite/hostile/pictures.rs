//! Pictures that mean harm, as a model's material calls them.

use super::corpus::Corpus;

/// A PNG's head that promises so many pixels.
fn png(width: u32, height: u32, data: &[u8]) -> Vec<u8> {
    let mut bytes = b"\x89PNG\r\n\x1a\n".to_vec();
    let mut chunk = |kind: &[u8; 4], data: &[u8]| {
        bytes.extend((data.len() as u32).to_be_bytes());
        bytes.extend(kind);
        bytes.extend(data);
        let mut crc = !0_u32;
        for byte in kind.iter().chain(data) {
            crc ^= u32::from(*byte);
            (0..8).for_each(|_| crc = (crc >> 1) ^ (0xedb8_8320 & 0_u32.wrapping_sub(crc & 1)));
        }
        bytes.extend((!crc).to_be_bytes());
    };
    let head = [&width.to_be_bytes()[..], &height.to_be_bytes(), &[8, 6, 0, 0, 0]].concat();
    chunk(b"IHDR", &head);
    chunk(b"IDAT", data);
    chunk(b"IEND", &[]);
    bytes
}

/// A TGA's head that promises so many pixels.
fn tga(kind: u8, width: u16, height: u16, data: &[u8]) -> Vec<u8> {
    let mut bytes = vec![0, 0, kind, 0, 0, 0, 0, 0, 0, 0, 0, 0];
    bytes.extend(width.to_le_bytes());
    bytes.extend(height.to_le_bytes());
    bytes.extend([32, 0]);
    bytes.extend(data);
    bytes
}

pub(super) fn pictures(corpus: &mut Corpus) {
    let small = image::RgbImage::from_fn(9, 7, |x, y| image::Rgb([x as u8 * 20, y as u8 * 30, 9]));
    let encoded = |format| {
        let mut bytes = std::io::Cursor::new(Vec::new());
        small.write_to(&mut bytes, format).expect("encoded");
        bytes.into_inner()
    };
    for (ending, format) in
        [("png", image::ImageFormat::Png), ("jpg", image::ImageFormat::Jpeg), ("tga", image::ImageFormat::Tga)]
    {
        let good = encoded(format);
        let file = format!("p.{ending}");
        corpus.picture(&format!("an empty {ending}"), &file, b"");
        for part in [1, 8, 17, 18, 30, good.len() / 2, good.len() - 1] {
            corpus.picture(&format!("{part} bytes of a {ending}"), &file, &good[..part.min(good.len())]);
        }
        for at in [2, 12, 17, 25, good.len() / 2] {
            let mut bent = good.clone();
            let at = at.min(bent.len() - 1);
            bent[at] ^= 0xff;
            corpus.picture(&format!("byte {at} of a {ending}"), &file, &bent);
        }
        corpus.picture(&format!("words in a {ending}"), &file, b"no picture");
        corpus.picture(&format!("a {ending} of zeros"), &file, &vec![0; 1 << 20]);
    }
    for (width, height) in
        [(60_000, 60_000), (0, 0), (u32::MAX, u32::MAX), (16_385, 1), (1, 1 << 30), (16_384, 16_384)]
    {
        corpus.picture(
            &format!("a PNG of {width}x{height}"),
            "p.png",
            &png(width, height, b"\x78\x9c\x03\x00\x00\x00\x00\x01"),
        );
    }
    for kind in [1, 2, 3, 9, 10, 11, 255] {
        corpus.picture(
            &format!("a TGA of 65535x65535, kind {kind}"),
            "p.tga",
            &tga(kind, u16::MAX, u16::MAX, &[0xff; 64]),
        );
    }
    let mut wide = encoded(image::ImageFormat::Jpeg);
    if let Some(at) = wide.windows(2).position(|two| two == [0xff, 0xc0]) {
        wide[at + 5..at + 9].fill(0xff);
    }
    corpus.picture("a JPEG of 65535x65535", "p.jpg", &wide);
    corpus.picture("an EXR", "p.exr", b"\x76\x2f\x31\x01\x02\x00\x00\x00");
    corpus.picture("a GIF that says it is a PNG", "p.png", b"GIF89a\x01\x00\x01\x00\x00\x00\x00;");
}
