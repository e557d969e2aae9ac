//! The rest of a `map_...` line -> what is asked of which file.

use glam::Vec2;

use super::Content;
use super::lines::{number, quote, text, unquoted};

/// What a picture is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Use {
    /// `map_Kd`
    Diffuse,
    /// `map_Ks`
    Specular,
    /// `map_Ns`
    Exponent,
    /// `map_d`
    Opacity,
    /// `norm`
    Normal,
    /// `bump`, `map_Bump`: heights by the book, normals in half of the files.
    Bump,
}

impl Use {
    /// Of a lower-case keyword.
    pub(super) fn of(keyword: &[u8]) -> Option<Self> {
        Some(match keyword {
            b"map_kd" => Self::Diffuse,
            b"map_ks" => Self::Specular,
            b"map_ns" => Self::Exponent,
            b"map_d" | b"map_tr" | b"map_opacity" => Self::Opacity,
            b"norm" | b"map_norm" | b"map_kn" | b"map_normal" => Self::Normal,
            b"bump" | b"map_bump" => Self::Bump,
            _ => return None,
        })
    }

    /// Two uses of one slot replace each other.
    pub(super) fn slot(self) -> u8 {
        match self {
            Self::Diffuse => 0,
            Self::Specular => 1,
            Self::Exponent => 2,
            Self::Opacity => 3,
            Self::Normal | Self::Bump => 4,
        }
    }

    /// What its numbers mean, once heights are normals.
    pub(super) fn content(self) -> Content {
        match self {
            Self::Diffuse | Self::Specular => Content::Color,
            Self::Exponent | Self::Opacity => Content::Scalar,
            Self::Normal | Self::Bump => Content::Normal,
        }
    }
}

/// A picture that a material asks for.
#[derive(Debug, Clone, PartialEq)]
pub struct Asked {
    /// What for.
    pub used: Use,
    /// The file's name as written, without quotes.
    pub name: String,
    /// In the MTL file.
    pub line: u64,
    /// `-s`
    pub scale: Vec2,
    /// `-o`
    pub offset: Vec2,
    /// `-clamp on`
    pub clamp: bool,
    /// `-bm`
    pub strength: f32,
}

impl Asked {
    /// Reads options and name: `-bm 0.5 my file.png`, and `file.png -bm 0.5` too, as some write it.
    /// `None` if there is no name.
    pub(super) fn read(used: Use, rest: &[u8], line: u64, say: &mut impl FnMut(String)) -> Option<Self> {
        let mut asked = Self {
            used,
            name: String::new(),
            line,
            scale: Vec2::ONE,
            offset: Vec2::ZERO,
            clamp: false,
            strength: 1.0,
        };
        // The name is all between the options, blanks and `#` included.
        let (mut from, mut to) = (None, rest.len());
        let mut words = Pieces { text: rest, at: 0 };
        while let Some((at, word)) = words.next() {
            let is_option = most_values(word).is_some();
            match from {
                _ if is_option => {
                    if from.is_some() {
                        to = to.min(at);
                    }
                    asked.option(word, &mut words, say);
                }
                None => from = Some(at),
                Some(_) => {}
            }
        }
        let name = text(rest.get(from?..to)?.trim_ascii());
        unquoted(&name).clone_into(&mut asked.name);
        (!asked.name.is_empty()).then_some(asked)
    }

    fn option(&mut self, word: &[u8], words: &mut Pieces<'_>, say: &mut impl FnMut(String)) {
        let mut numbers = Vec::new();
        let mut switch = None;
        for _ in 0..most_values(word).unwrap_or(0) {
            let Some((_, value)) = words.clone().next() else { break };
            match number(value).filter(|value| value.is_finite()) {
                Some(value) => numbers.push(value),
                // `-o 0.5 file.png`: two of the three numbers are left away.
                None if !numbers.is_empty() || takes_numbers(word) => break,
                None => switch = Some(value),
            }
            words.next();
        }
        match (word, numbers.as_slice()) {
            (b"-s", &[u, ref more @ ..]) => self.scale = Vec2::new(u, more.first().copied().unwrap_or(1.0)),
            (b"-o", &[u, ref more @ ..]) => self.offset = Vec2::new(u, more.first().copied().unwrap_or(0.0)),
            (b"-bm", &[strength, ..]) => self.strength = strength,
            (b"-clamp", _) => self.clamp = switch == Some(b"on"),
            (b"-blendu" | b"-blendv" | b"-cc", _) if switch == Some(b"off") || word != b"-cc" => {}
            (b"-mm", &[0.0, 1.0]) | (b"-t", &[0.0, ..]) => {}
            _ => say(format!("the option {} is not used", quote(word))),
        }
    }
}

/// How many values an option takes at most; `None` if it is none.
fn most_values(word: &[u8]) -> Option<usize> {
    Some(match word {
        b"-s" | b"-o" | b"-t" => 3,
        b"-mm" => 2,
        b"-bm" | b"-boost" | b"-texres" | b"-clamp" | b"-blendu" | b"-blendv" | b"-cc" | b"-imfchan" | b"-type" => {
            1
        }
        _ => return None,
    })
}

fn takes_numbers(word: &[u8]) -> bool {
    matches!(word, b"-s" | b"-o" | b"-t" | b"-mm" | b"-bm" | b"-boost" | b"-texres")
}

/// Words with the places where they start; `#` means nothing here.
#[derive(Clone)]
struct Pieces<'a> {
    text: &'a [u8],
    at: usize,
}

impl<'a> Iterator for Pieces<'a> {
    type Item = (usize, &'a [u8]);

    fn next(&mut self) -> Option<Self::Item> {
        let rest = self.text.get(self.at..)?;
        let start = self.at + rest.iter().position(|byte| *byte > b' ')?;
        let word = self.text.get(start..)?;
        let length = word.iter().position(|byte| *byte <= b' ').unwrap_or(word.len());
        self.at = start + length;
        Some((start, word.get(..length)?))
    }
}
