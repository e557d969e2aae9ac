//! a number or list in the file -> a value that is in range, or an error at its very place

mod number;

pub use number::{
    Aspect, Blur, Degrees, Depth, Exponent, FrameCount, Index, Intensity, Length, Place, Rate, Samples, Seed,
    ShadowSize, Side, Turns, Weight,
};

use std::fmt;
use std::marker::PhantomData;

use glam::Vec3;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use serde::de::{Deserializer, Error as _, SeqAccess, Visitor};

use crate::film::{Transfer, decode_hex};
use number::Number;

/// A value and the bytes of the text that it was read from; none if it was left out.
#[derive(Debug, Clone, Deserialize)]
#[serde(transparent)]
pub struct At<T>(toml::Spanned<T>);

impl<T> At<T> {
    /// A value that stands nowhere in the text.
    pub fn nowhere(value: T) -> Self {
        Self(toml::Spanned::new(0..0, value))
    }

    /// The value.
    pub fn get(&self) -> &T {
        self.0.get_ref()
    }

    /// Where it stands.
    pub fn span(&self) -> std::ops::Range<usize> {
        self.0.span()
    }
}

impl<T: JsonSchema> JsonSchema for At<T> {
    fn inline_schema() -> bool {
        T::inline_schema()
    }

    fn schema_name() -> std::borrow::Cow<'static, str> {
        T::schema_name()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        T::json_schema(generator)
    }
}

/// Coordinates stay this small, so that their squares are still numbers.
const FARTHEST: f32 = 1e9;
const POSITION: &str = "a position is a list of three numbers, each from -1e9 to 1e9";
const DIRECTION: &str = "a direction is a list of three numbers from -1e9 to 1e9, not all zero";
const COLOR: &str = "a color is a list of three numbers from 0 to 1e6, or \"#rrggbb\"";

/// What would be right; of a field that is not there, that it is missing.
fn or_missing<E: serde::de::Error>(right: &str) -> impl FnOnce(E) -> E {
    move |error| if error.to_string().starts_with("missing field") { error } else { E::custom(right) }
}

struct Three(&'static str);

impl<'de> Visitor<'de> for Three {
    type Value = [f64; 3];

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<[f64; 3], A::Error> {
        let mut three = [0.0; 3];
        for place in &mut three {
            *place = list.next_element_seed(Part(self.0))?.ok_or_else(|| A::Error::custom(self.0))?;
        }
        if list.next_element::<serde::de::IgnoredAny>()?.is_some() {
            return Err(A::Error::custom(self.0));
        }
        Ok(three)
    }
}

struct Part(&'static str);

impl<'de> serde::de::DeserializeSeed<'de> for Part {
    type Value = f64;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<f64, D::Error> {
        deserializer.deserialize_any(Number(self.0))
    }
}

fn bounded(three: [f64; 3], low: f32, high: f32) -> Option<Vec3> {
    let v = Vec3::from_array(three.map(|c| c as f32));
    v.to_array().iter().all(|c| (low..=high).contains(c)).then_some(v)
}

fn list_schema(low: f32, high: f32, description: &str) -> Schema {
    let number = json_schema!({"type": "number", "minimum": low, "maximum": high});
    json_schema!({"type": "array", "items": number, "minItems": 3, "maxItems": 3, "description": description})
}

/// A place in world space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Position(pub Vec3);

impl<'de> Deserialize<'de> for Position {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let three = deserializer.deserialize_any(Three(POSITION)).map_err(or_missing(POSITION))?;
        bounded(three, -FARTHEST, FARTHEST).map(Self).ok_or_else(|| D::Error::custom(POSITION))
    }
}

impl JsonSchema for Position {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Position".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        list_schema(-FARTHEST, FARTHEST, POSITION)
    }
}

/// A direction in world space, of length one however long it was written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Direction(pub Vec3);

impl<'de> Deserialize<'de> for Direction {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let three = deserializer.deserialize_any(Three(DIRECTION)).map_err(or_missing(DIRECTION))?;
        let v = bounded(three, -FARTHEST, FARTHEST).ok_or_else(|| D::Error::custom(DIRECTION))?;
        // In f64, in which no such length is lost.
        let length = v.as_dvec3().length();
        if length < 1e-30 {
            return Err(D::Error::custom(DIRECTION));
        }
        Ok(Self((v.as_dvec3() / length).as_vec3()))
    }
}

impl JsonSchema for Direction {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Direction".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        list_schema(-FARTHEST, FARTHEST, DIRECTION)
    }
}

/// A color: three numbers, or what a display shows for `#rrggbb`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Color {
    /// Linear or display-referred, as the film's transfer says.
    Parts(Vec3),
    /// A display's numbers.
    Shown([u8; 3]),
}

impl Color {
    /// White.
    pub const WHITE: Self = Self::Parts(Vec3::ONE);
    /// Black.
    pub const BLACK: Self = Self::Parts(Vec3::ZERO);

    /// The color as the renderer reckons with it.
    #[must_use]
    pub fn under(self, transfer: Transfer) -> Vec3 {
        match self {
            Self::Parts(parts) => parts,
            Self::Shown(rgb) => decode_hex(rgb, transfer),
        }
    }
}

struct ColorVisitor;

impl<'de> Visitor<'de> for ColorVisitor {
    type Value = Color;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(COLOR)
    }

    fn visit_str<E: serde::de::Error>(self, text: &str) -> Result<Color, E> {
        let digits = text.strip_prefix('#').filter(|d| d.len() == 6 && d.bytes().all(|b| b.is_ascii_hexdigit()));
        let number = digits.and_then(|d| u32::from_str_radix(d, 16).ok()).ok_or_else(|| E::custom(COLOR))?;
        let [_, red, green, blue] = number.to_be_bytes();
        Ok(Color::Shown([red, green, blue]))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Color, A::Error> {
        let three = Three(COLOR).visit_seq(list)?;
        bounded(three, 0.0, 1e6).map(Color::Parts).ok_or_else(|| A::Error::custom(COLOR))
    }
}

impl<'de> Deserialize<'de> for Color {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ColorVisitor).map_err(or_missing(COLOR))
    }
}

impl JsonSchema for Color {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Color".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let parts = list_schema(0.0, 1e6, "red, green, blue");
        json_schema!({
            "description": COLOR,
            "anyOf": [parts, {"type": "string", "pattern": "^#[0-9a-fA-F]{6}$"}]
        })
    }
}

/// A list of just so many.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Exactly<T, const N: usize>(pub [T; N]);

struct Many<T, const N: usize>(PhantomData<T>);

impl<'de, T: Deserialize<'de>, const N: usize> Visitor<'de> for Many<T, N> {
    type Value = Exactly<T, N>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a list of {N}")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Self::Value, A::Error> {
        let mut all = Vec::with_capacity(N);
        while let Some(entry) = list.next_element()? {
            all.push(entry);
        }
        let found = all.len();
        let all = <[T; N]>::try_from(all);
        all.map(Exactly).map_err(|_| A::Error::custom(format!("invalid length {found}, expected a list of {N}")))
    }
}

impl<'de, T: Deserialize<'de>, const N: usize> Deserialize<'de> for Exactly<T, N> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(Many(PhantomData))
    }
}

impl<T: JsonSchema, const N: usize> JsonSchema for Exactly<T, N> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> std::borrow::Cow<'static, str> {
        format!("{}{N}", T::schema_name()).into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let items = generator.subschema_for::<T>();
        json_schema!({"type": "array", "items": items, "minItems": N, "maxItems": N})
    }
}
