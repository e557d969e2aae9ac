//! a number or list in the file -> a value that is in range, or an error at its very place

use std::fmt;

use glam::Vec3;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use serde::de::{Deserializer, Error as _, SeqAccess, Visitor};

use crate::film::{Transfer, decode_hex};

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

/// A number between two bounds, both of them allowed, and what to say if it is not.
macro_rules! number {
    ($(#[$doc:meta])* $name:ident, $low:expr, $high:expr, $right:literal) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub struct $name(pub f32);

        impl<'de> Deserialize<'de> for $name {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                let number = deserializer.deserialize_any(Number($right)).map_err(|_| D::Error::custom($right))?;
                let single = number as f32;
                if ($low..=$high).contains(&single) { Ok(Self(single)) } else { Err(D::Error::custom($right)) }
            }
        }

        impl JsonSchema for $name {
            fn schema_name() -> std::borrow::Cow<'static, str> {
                stringify!($name).into()
            }

            fn json_schema(_: &mut SchemaGenerator) -> Schema {
                json_schema!({"type": "number", "minimum": $low, "maximum": $high, "description": $right})
            }
        }
    };
}

number! {
    /// A share of the light.
    Weight, 0.0, 1.0, "a weight is a number from 0 to 1"
}
number! {
    /// How much light.
    Intensity, 0.0, 1e6, "an intensity is a number from 0 to 1e6"
}
number! {
    /// The specular exponent.
    Exponent, 0.0, 1e4, "an exponent is a number from 0 to 1e4"
}
number! {
    /// A refractive index.
    Index, 1.0, 10.0, "a refractive index is a number from 1 to 10"
}
number! {
    /// A length in world units.
    Length, 1e-6, 1e9, "a length is a number from 1e-6 to 1e9"
}
number! {
    /// A vertical field of view, in degrees.
    Degrees, 1.0, 179.0, "a vertical field of view is a number of degrees from 1 to 179"
}
number! {
    /// Width to height.
    Aspect, 0.01, 100.0, "an aspect is a width divided by a height, from 0.01 to 100"
}

struct Number(&'static str);

impl Visitor<'_> for Number {
    type Value = f64;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0)
    }

    fn visit_f64<E>(self, v: f64) -> Result<f64, E> {
        Ok(v)
    }

    fn visit_i64<E>(self, v: i64) -> Result<f64, E> {
        Ok(v as f64)
    }

    fn visit_u64<E>(self, v: u64) -> Result<f64, E> {
        Ok(v as f64)
    }
}

/// Coordinates stay this small, so that their squares are still numbers.
const FARTHEST: f32 = 1e9;
const POSITION: &str = "a position is a list of three numbers, each from -1e9 to 1e9";
const DIRECTION: &str = "a direction is a list of three numbers from -1e9 to 1e9, not all zero";
const COLOR: &str = "a color is a list of three numbers from 0 to 1e6, or \"#rrggbb\"";

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
        let three = deserializer.deserialize_any(Three(POSITION)).map_err(|_| D::Error::custom(POSITION))?;
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
        let three = deserializer.deserialize_any(Three(DIRECTION)).map_err(|_| D::Error::custom(DIRECTION))?;
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
        deserializer.deserialize_any(ColorVisitor).map_err(|_| D::Error::custom(COLOR))
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

/// A whole number between two bounds, both of them allowed.
macro_rules! count {
    ($(#[$doc:meta])* $name:ident, $low:expr, $high:expr, $right:literal) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub struct $name(pub u32);

        impl $name {
            /// The number, if it is in range.
            #[must_use]
            pub fn new(number: i64) -> Option<Self> {
                (i64::from($low)..=i64::from($high)).contains(&number).then_some(Self(number as u32))
            }

            /// What would be right.
            pub const RIGHT: &'static str = $right;
        }

        impl<'de> Deserialize<'de> for $name {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                let number = i64::deserialize(deserializer).map_err(|_| D::Error::custom($right))?;
                Self::new(number).ok_or_else(|| D::Error::custom($right))
            }
        }

        impl JsonSchema for $name {
            fn schema_name() -> std::borrow::Cow<'static, str> {
                stringify!($name).into()
            }

            fn json_schema(_: &mut SchemaGenerator) -> Schema {
                json_schema!({"type": "integer", "minimum": $low, "maximum": $high, "description": $right})
            }
        }
    };
}

count! {
    /// Pixels along a side of the film.
    Side, 1_u32, super::LONGEST_SIDE, "a film's side is a whole number of pixels from 1 to 65536"
}
count! {
    /// Samples a pixel.
    Samples, 1_u32, super::MOST_SAMPLES, "samples are a whole number from 1 to 65536"
}
count! {
    /// Rays in a branch.
    Depth, 1_u32, super::DEEPEST, "a depth is a whole number of rays from 1 to 32"
}
count! {
    /// Any 32 bits.
    Seed, 0_u32, u32::MAX, "a seed is a whole number from 0 to 4294967295"
}
