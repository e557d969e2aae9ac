//! The part of a scene file that is about time: `[animation]`.

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use serde::de::{Deserializer, Error as _, SeqAccess, Visitor};

use crate::scene::value::{At, Direction, FrameCount, Position, Rate, Turns};

/// What changes from frame to frame. Anything of a scene can: each frame is the scene with some values put in.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Animation {
    /// Frames are numbered from 1 to this.
    pub frames: FrameCount,
    /// Frames a second, in an animated picture. 24 unless given.
    #[serde(default = "rate")]
    pub rate: Rate,
    /// Values that follow keys.
    #[serde(default)]
    pub track: Vec<Track>,
    /// Points and directions that turn about an axis: turntables, and sweeps of a light.
    #[serde(default)]
    pub orbit: Vec<Orbit>,
}

fn rate() -> Rate {
    Rate(24.0)
}

/// A value that follows keys.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Track {
    /// The field that changes, as `camera.fov`, or `light.point[0].position` where entries are counted from 0.
    pub target: At<String>,
    /// Frames, and the value there: [[1, 40], [120, 60]]. Before the first and after the last one nothing changes.
    pub keys: At<Vec<Key>>,
    /// What lies between keys. "linear" unless given.
    #[serde(default)]
    pub interpolation: Interpolation,
}

/// What lies between keys.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, serde::Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Interpolation {
    /// The same change in every frame.
    #[default]
    Linear,
    /// A curve through the keys without corners (Catmull and Rom).
    Smooth,
    /// The last key's value: for words and whole numbers.
    Step,
}

/// A point or direction that turns about an axis, evenly, and is where it was in the frame after the last.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Orbit {
    /// The field that turns: a list of three numbers, as `camera.position` or `light.directional[0].toward`.
    pub target: At<String>,
    /// A point of the axis. [0, 0, 0] unless given.
    #[serde(default = "origin")]
    pub around: Position,
    /// The axis' direction. [0, 1, 0] unless given.
    #[serde(default = "up")]
    pub axis: Direction,
    /// How many turns all frames make together, counterclockwise as seen from the axis' end. 1 unless given.
    #[serde(default = "one")]
    pub turns: Turns,
}

fn origin() -> Position {
    Position(glam::Vec3::ZERO)
}

fn up() -> Direction {
    Direction(glam::Vec3::Y)
}

fn one() -> Turns {
    Turns(1.0)
}

/// A frame, and the value there.
#[derive(Debug, Clone, PartialEq)]
pub struct Key {
    /// Which frame.
    pub frame: i64,
    /// Any value of TOML.
    pub value: toml::Value,
}

const KEY: &str = "a key is a list of a frame and a value, as [1, 40] or [24, [0, 1, 5]]";

impl<'de> Deserialize<'de> for Key {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(Pair).map_err(|_| D::Error::custom(KEY))
    }
}

struct Pair;

impl<'de> Visitor<'de> for Pair {
    type Value = Key;

    fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(KEY)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Key, A::Error> {
        let wrong = || A::Error::custom(KEY);
        let frame = list.next_element()?.ok_or_else(wrong)?;
        let value = list.next_element()?.ok_or_else(wrong)?;
        match list.next_element::<serde::de::IgnoredAny>()? {
            None => Ok(Key { frame, value }),
            Some(_) => Err(wrong()),
        }
    }
}

impl JsonSchema for Key {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Key".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let pair = [json_schema!({"type": "integer"}), json_schema!({})];
        json_schema!({
            "type": "array", "prefixItems": pair, "items": false, "minItems": 2, "maxItems": 2, "description": KEY
        })
    }
}
