//! The part of a scene file that is about what objects are made of: `[[material]]`.

use schemars::JsonSchema;
use serde::Deserialize;

use crate::scene::value::{At, Color, Exactly, Exponent, Index, Intensity, Length, Weight};

/// What an object is made of. Its light is `local` x (light that falls on it) + `reflect` x (reflected path)
/// + `refract` x (refracted path).
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// The name that objects call it by; no two alike.
    pub name: At<String>,
    /// Its color. White unless given.
    #[serde(default = "super::white")]
    pub color: Color,
    /// A picture that its color is multiplied with. PNG, JPEG or TGA, relative to the scene's folder and inside it, as
    /// all of a material's pictures.
    #[serde(default)]
    #[schemars(with = "String")]
    pub color_map: Option<At<String>>,
    /// A picture of tangent-space normals (+x to its right, +y up), or a gray one of heights.
    #[serde(default)]
    #[schemars(with = "String")]
    pub normal_map: Option<At<String>>,
    /// A picture that the specular term is multiplied with.
    #[serde(default)]
    #[schemars(with = "String")]
    pub specular_map: Option<At<String>>,
    /// How strong the normal map is. 1 unless given.
    #[serde(default)]
    #[schemars(with = "Intensity")]
    pub bump: Option<At<Intensity>>,
    /// How often the pictures are repeated, across and up. [1, 1] unless given.
    #[serde(default)]
    #[schemars(with = "Exactly<Length, 2>")]
    pub repeat: Option<At<Exactly<Length, 2>>>,
    /// Which way rays go on. "mirror" unless given.
    #[serde(default)]
    pub behavior: Behavior,
    /// Weight of the light that falls on it directly. 1 unless given.
    #[serde(default)]
    #[schemars(with = "Weight")]
    pub local: Option<Weight>,
    /// Weight of the reflected path. 0 unless given; 1 if the behavior is "diffuse".
    #[serde(default)]
    #[schemars(with = "Weight")]
    pub reflect: Option<Weight>,
    /// Weight of the refracted path; only if the behavior is "glass", and then 1 unless given.
    #[serde(default)]
    #[schemars(with = "Weight")]
    pub refract: Option<At<Weight>>,
    /// The specular exponent k. 10 unless given.
    #[serde(default = "ten")]
    pub exponent: Exponent,
    /// Refractive index; only if the behavior is "glass", and then 1.5 unless given.
    #[serde(default)]
    #[schemars(with = "Index")]
    pub index: Option<At<Index>>,
}

fn ten() -> Exponent {
    Exponent(10.0)
}

/// Which way rays go on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, serde::Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Behavior {
    /// In the mirror direction, colorless.
    #[default]
    Mirror,
    /// Anywhere in the hemisphere around the mirror direction, tinted.
    Diffuse,
    /// In the mirror direction, and refracted through the surface into a body: closed, and none within another. No
    /// light is asked inside of it, so that behind a single pane, or below a plane, all is dark.
    Glass,
}
