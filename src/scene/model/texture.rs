//! What materials ask for -> decoded pictures, each file once, and the maps that point to them.

use std::collections::HashMap;
use std::io::Cursor;
use std::panic::{UnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use image::{ImageFormat, ImageReader, ImageResult};

use super::budget::{Budget, Limits};
use super::bump::{self, Kind};
use super::find::{Finder, read};
use super::lines::quote;
use super::map::{Asked, Use};
use super::mtl::Written;
use super::{Content, Map, Material, Texture, Warnings};

/// The pictures of a model, as far as they were asked for.
pub(super) struct Pictures<'a> {
    finder: Finder<'a>,
    limits: &'a Limits,
    budget: &'a mut Budget,
    /// Folder and name as written -> what came of it.
    asked: HashMap<(PathBuf, String), Result<Loaded, String>>,
    /// Path without links -> place in `decoded`.
    files: HashMap<PathBuf, Result<usize, String>>,
    decoded: Vec<Picture>,
    /// What is already in `textures`.
    made: HashMap<Made, u32>,
    textures: Vec<Texture>,
    checkerboard: Option<u32>,
}

/// Place in `decoded`, content, and for heights the bits of `-bm` and `-clamp`.
type Made = (usize, Content, Option<(u32, bool)>);

#[derive(Clone)]
struct Loaded {
    picture: usize,
    note: Option<String>,
}

/// A decoded file.
pub struct Picture {
    /// Relative to the scene's folder.
    pub file: String,
    /// Texels a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Top row first.
    pub texels: Arc<[[u8; 4]]>,
    /// Whether its alpha says how opaque it is.
    pub has_alpha: bool,
    /// What is doubtful about it.
    pub note: Option<String>,
}

impl<'a> Pictures<'a> {
    pub(super) fn new(finder: Finder<'a>, limits: &'a Limits, budget: &'a mut Budget) -> Self {
        Self {
            finder,
            limits,
            budget,
            asked: HashMap::new(),
            files: HashMap::new(),
            decoded: Vec::new(),
            made: HashMap::new(),
            textures: Vec::new(),
            checkerboard: None,
        }
    }

    pub(super) fn into_textures(self) -> Vec<Texture> {
        self.textures
    }

    /// The material with its maps.
    pub(super) fn dress(&mut self, written: &Written, warnings: &mut Warnings) -> Material {
        let mut material = written.material.clone();
        for asked in &written.maps {
            let map = self.map(asked, &written.file, warnings);
            match asked.used {
                Use::Diffuse => material.diffuse_map = map,
                Use::Specular => material.specular_map = map,
                Use::Exponent => material.exponent_map = map,
                Use::Opacity => material.opacity_map = map,
                Use::Normal | Use::Bump => material.normal_map = map,
            }
        }
        material
    }

    fn map(&mut self, asked: &Asked, file: &str, warnings: &mut Warnings) -> Option<Map> {
        let base = Path::new(file).parent().unwrap_or(Path::new(""));
        let mut say = |what: &str| {
            warnings.add(file, asked.line, format!("the picture {}: {what}", quote(asked.name.as_bytes())));
        };
        let mut strength = 1.0;
        let texture = match self.load(base, &asked.name) {
            Ok(loaded) => {
                loaded.note.iter().for_each(|note| say(note));
                if asked.used == Use::Normal {
                    strength = asked.strength;
                }
                self.texture(loaded.picture, asked, &mut say, &mut strength)
            }
            // A surface whose picture is missing must look like it; the finer maps are only left out.
            Err(why) if asked.used == Use::Diffuse => {
                say(&format!("{why}; a checkerboard is drawn instead"));
                Some(self.checkerboard())
            }
            Err(why) => {
                say(&format!("{why}; it is left out"));
                None
            }
        };
        Some(Map { texture: texture?, scale: asked.scale, offset: asked.offset, clamp: asked.clamp, strength })
    }

    /// The texture for a use of a picture; `strength` is what its map has still to apply.
    fn texture(
        &mut self,
        number: usize,
        asked: &Asked,
        say: &mut impl FnMut(&str),
        strength: &mut f32,
    ) -> Option<u32> {
        let picture = self.decoded.get(number)?;
        let content = asked.used.content();
        let mut heights = None;
        if asked.used == Use::Bump {
            match bump::kind(&picture.texels) {
                Kind::Normals => *strength = asked.strength,
                Kind::Heights => heights = Some((asked.strength.to_bits(), asked.clamp)),
                Kind::Neither => {
                    say("it is neither gray (heights) nor bluish (normals); its brightness is taken as heights");
                    heights = Some((asked.strength.to_bits(), asked.clamp));
                }
            }
        }
        let key = (number, content, heights);
        if let Some(&texture) = self.made.get(&key) {
            return Some(texture);
        }
        let texels = match heights {
            None => picture.texels.clone(),
            Some(_) if self.budget.take(4 * picture.texels.len() as u64).is_err() => {
                say("there is no memory left for its normals; it is left out");
                return None;
            }
            Some((_, clamp)) => bump::to_normals(&picture.texels, picture.width, asked.strength, clamp).into(),
        };
        let has_alpha = heights.is_none() && picture.has_alpha;
        let (file, width, height) = (picture.file.clone(), picture.width, picture.height);
        let texture = self.add(Texture { file, content, width, height, texels, has_alpha });
        self.made.insert(key, texture);
        Some(texture)
    }

    fn add(&mut self, texture: Texture) -> u32 {
        self.textures.push(texture);
        self.textures.len() as u32 - 1
    }

    /// Eight by eight squares of magenta and gray.
    fn checkerboard(&mut self) -> u32 {
        if let Some(texture) = self.checkerboard {
            return texture;
        }
        let square = |at: u32| if (at + at / 8).is_multiple_of(2) { [255, 0, 255, 255] } else { [64, 64, 64, 255] };
        let texels = (0..64).map(square).collect();
        let texture =
            Texture { file: String::new(), content: Content::Color, width: 8, height: 8, texels, has_alpha: false };
        let texture = self.add(texture);
        self.checkerboard = Some(texture);
        texture
    }

    fn load(&mut self, base: &Path, name: &str) -> Result<Loaded, String> {
        let key = (base.to_path_buf(), name.to_owned());
        if let Some(known) = self.asked.get(&key) {
            return known.clone();
        }
        if self.asked.len() >= self.limits.textures {
            return Err(format!("the model has more than {} pictures", self.limits.textures));
        }
        let loaded = self.load_new(base, name);
        self.asked.insert(key, loaded.clone());
        loaded
    }

    fn load_new(&mut self, base: &Path, name: &str) -> Result<Loaded, String> {
        let found = self.finder.find(base, name).map_err(|why| why.to_string())?;
        let file = found.relative.display().to_string();
        let path = found.opened.path.clone();
        let number = if let Some(known) = self.files.get(&path) {
            known.clone()
        } else {
            let decoded = read(found.opened, self.limits.picture_bytes)
                .and_then(|bytes| decode(&bytes, &file, self.limits, self.budget))
                .map(|picture| {
                    self.decoded.push(picture);
                    self.decoded.len() - 1
                });
            self.files.insert(path, decoded.clone());
            decoded
        };
        let picture = number?;
        let doubt = self.decoded.get(picture).and_then(|picture| picture.note.clone());
        Ok(Loaded { picture, note: found.note.or(doubt) })
    }
}

/// Decodes a picture: PNG and JPEG by their first bytes, TGA, which has none, by the name's ending.
///
/// # Errors
/// Half a sentence that says what is wrong.
pub fn decode(bytes: &[u8], file: &str, limits: &Limits, budget: &mut Budget) -> Result<Picture, String> {
    let is_tga = Path::new(file).extension().is_some_and(|ending| ending.eq_ignore_ascii_case("tga"));
    // How many texels a byte can stand for at most: a header that promises more lies, and is found out
    // before memory is taken for it.
    let (format, texels_a_byte) = if bytes.starts_with(b"\x89PNG\r\n\x1a\n") {
        // Deflate makes at most 1032 bytes of one, of at least one bit a texel.
        (ImageFormat::Png, 1032 * 8)
    } else if bytes.starts_with(b"\xFF\xD8\xFF") {
        // A block of 8 x 8 texels takes at least one bit.
        (ImageFormat::Jpeg, 8 * 64)
    } else if is_tga {
        // A run of 128 texels takes two bytes.
        (ImageFormat::Tga, 64)
    } else {
        return Err("it is neither a PNG nor a JPEG nor a TGA file".to_owned());
    };
    let reader = || {
        let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
        let mut most = image::Limits::default();
        most.max_image_width = Some(limits.texture_side);
        most.max_image_height = Some(limits.texture_side);
        // Of 16 bits a color, the decoder needs twice what we keep.
        most.max_alloc = Some(2 * limits.texture_bytes);
        reader.limits(most);
        reader
    };
    let (width, height) = guard(|| reader().into_dimensions())?;
    let texels = u64::from(width) * u64::from(height);
    let side = limits.texture_side;
    if width.max(height) > side || texels * 4 > limits.texture_bytes {
        return Err(format!(
            "it has {width} x {height} texels; at most {side} a side and {} in all are taken",
            limits.texture_bytes / 4
        ));
    }
    if texels == 0 || texels > texels_a_byte * bytes.len() as u64 {
        return Err(format!(
            "it cannot hold the {width} x {height} texels that it promises in {} bytes",
            bytes.len()
        ));
    }
    budget.take(4 * texels).map_err(|_| "there is no memory left for it".to_owned())?;
    let decoded = guard(|| reader().decode())?;
    // A TGA file of 32 bits a texel says in byte 17 how many of them are alpha.
    let bits_of_alpha = if is_tga { bytes.get(17).map_or(0, |byte| byte & 15) } else { 8 };
    let kept = decoded.color().has_alpha() && bits_of_alpha > 0;
    let raw = decoded.into_rgba8().into_raw();
    // A gray picture that is opaque everywhere is a mask whose program knows no other format.
    let has_alpha = kept && raw.as_chunks().0.iter().any(|&[r, g, b, a]| a < 255 || r != g || g != b);
    let note = is_cut_short(bytes, format).then(|| "it is cut short; what is there is used".to_owned());
    Ok(Picture { file: file.to_owned(), width, height, texels: Arc::from(raw.as_chunks().0), has_alpha, note })
}

/// The decoders are others' code fed with anybody's bytes: should one panic after all, a picture is lost
/// and not the rendering.
fn guard<T>(decoder: impl FnOnce() -> ImageResult<T> + UnwindSafe) -> Result<T, String> {
    match catch_unwind(decoder) {
        Ok(Ok(value)) => Ok(value),
        Ok(Err(error)) => Err(format!("it cannot be decoded ({error})")),
        Err(_) => Err("it cannot be decoded (the decoder failed)".to_owned()),
    }
}

/// Whether a JPEG has no end after its last scan; the decoder fills up with gray and says nothing.
fn is_cut_short(bytes: &[u8], format: ImageFormat) -> bool {
    let last = |marker: [u8; 2]| bytes.windows(2).rposition(|pair| pair == marker);
    format == ImageFormat::Jpeg && last([0xFF, 0xD9]) < last([0xFF, 0xDA])
}
