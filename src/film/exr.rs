//! a film and its passes -> one EXR file, linear and in full precision

use std::io::Cursor;

use exr::prelude::{
    AnyChannel, AnyChannels, AttributeValue, Encoding, FlatSamples, Image, Layer as Picture, LayerAttributes, Text,
    WritableImage as _,
};
use glam::Vec3;

use super::pass::{Layer, Values};
use super::{Film, stamp};

/// The file's bytes. Colors are R, G and B; a pass is a layer, as depth.Z or normal.X.
///
/// # Errors
/// What the encoder says.
pub fn encode(film: &Film, layers: &[Layer], known_by: &str) -> Result<Vec<u8>, String> {
    let mut channels = Vec::new();
    let mut add = |name: &str, samples: FlatSamples| channels.push(AnyChannel::new(name, samples));
    let part = |v: &[Vec3], i: usize| FlatSamples::F32(v.iter().map(|v| v[i]).collect());
    let colors: Vec<Vec3> = (0..film.pixels()).map(|pixel| film.color(pixel)).collect();
    for (i, name) in ["R", "G", "B"].iter().enumerate() {
        add(name, part(&colors, i));
    }
    for layer in layers {
        for (i, channel) in layer.pass.channels().iter().enumerate() {
            let samples = match &layer.values {
                Values::One(values) => FlatSamples::F32(values.clone()),
                Values::Three(values) => part(values, i),
                Values::Number(numbers) => FlatSamples::U32(numbers.clone()),
            };
            add(&format!("{}.{channel}", layer.pass.name()), samples);
        }
    }
    let size = (film.width() as usize, film.height() as usize);
    let channels = AnyChannels::sort(channels.into_iter().collect());
    let mut attributes = LayerAttributes::default();
    if !known_by.is_empty() {
        let text = Text::new_or_none(known_by).ok_or("an EXR's texts are of Latin-1 characters alone")?;
        attributes.other.insert(Text::from(stamp::NAME), AttributeValue::Text(text));
    }
    let picture = Picture::new(size, attributes, Encoding::SMALL_LOSSLESS, channels);
    let mut bytes = Cursor::new(Vec::new());
    Image::from_layer(picture).write().non_parallel().to_buffered(&mut bytes).map_err(|e| e.to_string())?;
    Ok(bytes.into_inner())
}

/// What a file is known by, from its first bytes.
#[must_use]
pub fn stamp_in(head: &[u8]) -> Option<String> {
    let about = exr::meta::MetaData::read_from_buffered(head, false).ok()?;
    let attributes = &about.headers.first()?.own_attributes.other;
    match attributes.get(&Text::from(stamp::NAME))? {
        AttributeValue::Text(text) => Some(text.to_string()),
        _ => None,
    }
}
