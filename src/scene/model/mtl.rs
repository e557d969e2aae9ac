//! MTL text -> [`Written`] materials: numbers taken, pictures named but not yet looked for.
//!
//! The format: Wavefront, Advanced Visualizer 3.0, MTL supplement, and `norm` as everyone writes it. No
//! line of it is an error: a material that cannot be read whole is still better than none.

use glam::Vec3;

use super::lines::{LineError, Lines, Words, number, quote, text};
use super::map::{Asked, Use};
use super::{Limits, Material, Warnings};

/// A material as its file describes it.
#[derive(Debug)]
pub struct Written {
    /// All but the maps.
    pub material: Material,
    /// Of `newmtl`.
    pub line: u64,
    /// The pictures that it asks for.
    pub maps: Vec<Asked>,
    pub(super) file: String,
    diffuse_said: bool,
    specular_said: bool,
    /// `d` says more than `Tr`, which half of the exporters write the wrong way around.
    opacity_said: bool,
}

/// Reads all materials of a file; `file` is its name in messages.
pub fn parse(source: &[u8], file: &str, limits: &Limits, warnings: &mut Warnings) -> Vec<Written> {
    let mut materials: Vec<Written> = Vec::new();
    let mut lines = Lines::new(source, limits.line_bytes.min(source.len()));
    loop {
        let line = match lines.next() {
            Ok(Some(line)) => line,
            Ok(None) => break,
            Err(error) => {
                let (line, why) = match error {
                    LineError::TooLong(line) => (line, "this line is too long".to_owned()),
                    LineError::Utf16 => (1, "this is UTF-16 text, wanted UTF-8 or ASCII".to_owned()),
                    LineError::Read(why) => (0, why.to_string()),
                };
                warnings.add(file, line, format!("{why}; the rest of the file is not used"));
                break;
            }
        };
        let mut words = Words::new(line.bytes);
        let Some(keyword) = words.next() else { continue };
        // Exporters do not agree about capitals.
        let as_written = quote(keyword);
        let keyword = keyword.to_ascii_lowercase();
        if keyword == b"newmtl" {
            if materials.len() >= limits.names {
                warnings.add(file, line.number, "too many materials; the rest of the file is not used");
                break;
            }
            materials.push(Written::new(&text(words.rest()), file, line.number));
        } else if let Some(material) = materials.last_mut() {
            material.statement(&keyword, &as_written, words, line.number, warnings);
        } else {
            warnings.add(file, line.number, format!("{as_written} before the first `newmtl` belongs to nothing"));
        }
    }
    for material in &mut materials {
        material.finish(warnings);
    }
    materials
}

impl Written {
    fn new(name: &str, file: &str, line: u64) -> Self {
        Self {
            material: Material::named(name),
            line,
            maps: Vec::new(),
            file: file.to_owned(),
            diffuse_said: false,
            specular_said: false,
            opacity_said: false,
        }
    }

    fn statement(&mut self, keyword: &[u8], name: &str, mut words: Words<'_>, line: u64, warnings: &mut Warnings) {
        let mut say = |sentence: String| warnings.add(&self.file, line, sentence);
        let (first, rest) = (words.clone().next(), words.rest());
        match keyword {
            b"ka" | b"kd" | b"ks" | b"ke" => match color(words) {
                Ok(color) => {
                    if color.max_element() > 1.0 && keyword != b"ke" {
                        say(format!(
                            "{name} is more than 1, where 1 gives back all light: 255 is to be written as 1"
                        ));
                    }
                    match keyword {
                        b"ka" => self.material.ambient = color,
                        b"ke" => self.material.emission = color,
                        b"kd" => (self.material.diffuse, self.diffuse_said) = (color, true),
                        _ => (self.material.specular, self.specular_said) = (color, true),
                    }
                }
                Err(why) => say(format!("{name}: {why}; the color is not changed")),
            },
            b"ns" | b"ni" | b"d" | b"tr" | b"illum" => {
                // `d -halo 0.5` fades toward the silhouette; the number is the same.
                let word = if first == Some(b"-halo") { words.nth(1) } else { first };
                match word.and_then(number).filter(|value| value.is_finite() && *value >= 0.0) {
                    Some(value) => self.scalar(keyword, value),
                    None => {
                        say(format!("{name} wants a number of at least 0, not {}; it is not changed", quote(rest)));
                    }
                }
            }
            b"tf" | b"sharpness" | b"map_ka" | b"map_ke" | b"refl" | b"map_refl" | b"disp" | b"map_disp"
            | b"decal" | b"map_aat" => {
                say(format!("{name} is not used"));
            }
            _ => match Use::of(keyword) {
                Some(used) => match Asked::read(used, rest, line, &mut say) {
                    Some(asked) => self.ask(asked),
                    None => say(format!("{name} names no file")),
                },
                None => say(format!("the statement {name} is not known, and is passed over")),
            },
        }
    }

    /// One map for each use: the last that is written.
    fn ask(&mut self, asked: Asked) {
        self.maps.retain(|earlier| earlier.used.slot() != asked.used.slot());
        self.maps.push(asked);
    }

    fn scalar(&mut self, keyword: &[u8], value: f32) {
        match keyword {
            b"ns" => self.material.exponent = value,
            b"ni" => self.material.refraction_index = value,
            b"illum" => self.material.illumination = Some(value as u32),
            b"d" => (self.material.opacity, self.opacity_said) = (value.min(1.0), true),
            _ if self.opacity_said => {}
            _ => self.material.opacity = 1.0 - value.min(1.0),
        }
    }

    fn finish(&mut self, warnings: &mut Warnings) {
        let has = |used: Use| self.maps.iter().any(|asked| asked.used == used);
        // A map alone means the picture as it is; so does the black `Kd` that some exporters write
        // beside it, which would hide it.
        if has(Use::Diffuse) && (!self.diffuse_said || self.material.diffuse == Vec3::ZERO) {
            if self.diffuse_said {
                let text = "`Kd 0 0 0` would make `map_Kd` black; it is taken as `Kd 1 1 1`";
                warnings.add(&self.file, self.line, text);
            }
            self.material.diffuse = Vec3::ONE;
        }
        if has(Use::Specular) && !self.specular_said {
            self.material.specular = Vec3::ONE;
        }
        let name = quote(self.material.name.as_bytes());
        if let Some(model @ 0..=1) = self.material.illumination {
            if self.material.specular != Vec3::ZERO && self.specular_said {
                let text =
                    format!("`illum {model}` of material {name} is without highlights: its `Ks` is not used");
                warnings.add(&self.file, self.line, text);
            }
            self.material.specular = Vec3::ZERO;
            if model == 0 {
                let text =
                    format!("material {name} is to be in its plain color (`illum 0`), and is lit like others");
                warnings.add(&self.file, self.line, text);
            }
        }
        // Silence would pass for light.
        if self.material.emission != Vec3::ZERO {
            let text = format!("material {name} shines by itself (`Ke`), and is drawn as if it did not");
            warnings.add(&self.file, self.line, text);
        }
        // And for glass.
        if self.material.opacity < 1.0 {
            let much = if self.material.opacity == 0.0 { "wholly" } else { "partly" };
            let text = format!("material {name} is {much} transparent (`d` or `Tr`), and is drawn opaque");
            warnings.add(&self.file, self.line, text);
        }
    }
}

/// `r`, which stands for `r r r`, or `r g b`.
fn color(words: Words<'_>) -> Result<Vec3, String> {
    let mut words = words.peekable();
    if let Some(kind) = words.next_if(|word| *word == b"spectral" || *word == b"xyz") {
        return Err(format!("{} colors are not known, wanted `r g b`", quote(kind)));
    }
    let mut numbers = Vec::new();
    for word in words.take(3) {
        match number(word).filter(|value| value.is_finite() && *value >= 0.0) {
            Some(value) => numbers.push(value),
            None => return Err(format!("wanted numbers of at least 0, not {}", quote(word))),
        }
    }
    match *numbers.as_slice() {
        [r] => Ok(Vec3::splat(r)),
        [r, g, b] => Ok(Vec3::new(r, g, b)),
        _ => Err(format!("wanted one number or three, not {}", numbers.len())),
    }
}
