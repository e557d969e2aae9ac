//! a number in the file -> one that is in range, or an error at its very place

use std::fmt;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Deserialize, Deserializer, Error as _, Visitor};

use super::or_missing;

/// A number between two bounds, both of them allowed, and what to say if it is not.
macro_rules! number {
    ($(#[$doc:meta])* $name:ident, $low:expr, $high:expr, $right:literal) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub struct $name(pub f32);

        impl<'de> Deserialize<'de> for $name {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                let number = deserializer.deserialize_any(Number($right)).map_err(or_missing($right))?;
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
    /// A place on a picture, in pictures.
    Place, -1e4, 1e4, "a place on a picture is a number from -1e4 to 1e4"
}
number! {
    /// A vertical field of view, in degrees.
    Degrees, 1.0, 179.0, "a vertical field of view is a number of degrees from 1 to 179"
}
number! {
    /// Width to height.
    Aspect, 0.01, 100.0, "an aspect is a width divided by a height, from 0.01 to 100"
}

number! {
    /// Frames a second.
    Rate, 0.01, 240.0, "a rate is a number of frames a second from 0.01 to 240"
}
number! {
    /// Whole turns and parts of them.
    Turns, -1e6, 1e6, "turns are a number from -1e6 to 1e6"
}

/// Any number; what would be right is said if there is none.
pub(super) struct Number(pub(super) &'static str);

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
                let number = i64::deserialize(deserializer).map_err(or_missing($right))?;
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
    Side, 1_u32, crate::scene::LONGEST_SIDE, "a film's side is a whole number of pixels from 1 to 65536"
}
count! {
    /// Samples a pixel.
    Samples, 1_u32, crate::scene::MOST_SAMPLES, "samples are a whole number from 1 to 65536"
}
count! {
    /// Rays in a branch.
    Depth, 1_u32, crate::scene::DEEPEST, "a depth is a whole number of rays from 1 to 32"
}
count! {
    /// Texels along a side of a shadow map.
    ShadowSize, 16_u32, 4096_u32, "a shadow map's side is a whole number of texels from 16 to 4096"
}
count! {
    /// Texels around another.
    Blur, 0_u32, 3_u32, "a blur is a whole number of texels from 0 to 3"
}
count! {
    /// Any 32 bits.
    Seed, 0_u32, u32::MAX, "a seed is a whole number from 0 to 4294967295"
}
count! {
    /// Frames of an animation.
    FrameCount, 1_u32, 1_000_000_u32, "frames are a whole number from 1 to 1000000"
}
