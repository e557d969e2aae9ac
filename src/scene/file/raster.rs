//! The parts of a scene file that are about drawing: `[raster]` and `[[object.mesh]]`.

use schemars::JsonSchema;
use serde::Deserialize;

use super::Specular;
use crate::scene::value::{At, Blur, Color, Length, Position, Samples, ShadowSize, Weight};

/// How triangles are drawn (spec part 1).
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Raster {
    /// Samples a pixel, on an n x n grid: a square number, 256 at most. 4 unless given.
    pub samples: At<Samples>,
    /// Width and height of a light's shadow map, in texels; halved while all lights' together need more than 128
    /// MiB. 2048 unless given. A point light has six, whose depths begin at a hundredth of the distance to the scene's
    /// far side, or nearer where something is: down to a hundred thousandth of it, before which nothing casts a shadow.
    /// A directional light without a camera has two, each of half that size if there is no room, where one thing (a
    /// ground, say) is at least eight times as large as all smaller ones together: the first of these alone, so that
    /// their shadows are sharp. There is room for 32 maps; lights after those cast no shadows, and a note says so.
    /// Infinite planes cast shadows as far as the maps reach, which is around all other things.
    pub shadow_size: ShadowSize,
    /// What a light still counts for where it is shadowed. 0.3 unless given.
    pub shadow: Weight,
    /// How much farther from the light than its caster a point must lie to be shadowed, as a share of what the light's
    /// shadow map shows across there, beside the part that follows from the slope by itself. 0.0005 unless given.
    pub bias: Weight,
    /// Texels around a point's own that are asked for its shadow, in each direction: soft edges (percentage-closer
    /// filtering). 1 unless given.
    pub blur: Blur,
    /// Added to every color. Black unless given.
    pub ambient: Color,
    /// The specular term: "phong" or "blinn". "phong" unless given.
    pub specular: Specular,
    /// How textures are read. "mipmap" unless given.
    pub filter: Filter,
}

impl Default for Raster {
    fn default() -> Self {
        Self {
            samples: At::nowhere(Samples(4)),
            shadow_size: ShadowSize(2048),
            shadow: Weight(0.3),
            bias: Weight(0.0005),
            blur: Blur(1),
            ambient: Color::BLACK,
            specular: Specular::Phong,
            filter: Filter::Mipmap,
        }
    }
}

/// How textures are read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, serde::Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Filter {
    /// The nearest texel: the spec's figures.
    Nearest,
    /// Between the four nearest texels.
    Bilinear,
    /// Between the four nearest texels of the two levels that are nearest in size.
    #[default]
    Mipmap,
}

/// A model from an OBJ file, with the materials and textures that it names.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Mesh {
    /// The OBJ file, relative to the scene's folder and inside it.
    pub path: At<String>,
    /// Where its origin stands, in world space. [0, 0, 0] unless given.
    #[serde(default = "origin")]
    pub translate: Position,
    /// Degrees that it is turned about x, then about y, then about z. [0, 0, 0] unless given.
    #[serde(default = "origin")]
    pub rotate: Position,
    /// How large it is. 1 unless given.
    #[serde(default = "one")]
    pub scale: Length,
    /// The name of a material that covers it instead of its own.
    #[serde(default)]
    #[schemars(with = "String")]
    pub material: Option<At<String>>,
    /// Whether its faces are seen from their front alone; they cast shadows all the same, and those of glass are seen from
    /// both sides by the ray tracer. false unless given.
    #[serde(default)]
    pub one_sided: bool,
    /// Where it stands, if not once and as it says itself: each instance is the mesh as placed above, and then turned,
    /// scaled and moved again. The ray tracer keeps the model once however many there are.
    #[serde(default)]
    pub instance: Vec<Instance>,
}

/// One of the places in which a mesh stands.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Instance {
    /// Where it stands, in world space. [0, 0, 0] unless given.
    #[serde(default = "origin")]
    pub translate: Position,
    /// Degrees that it is turned about x, then about y, then about z. [0, 0, 0] unless given.
    #[serde(default = "origin")]
    pub rotate: Position,
    /// How large it is. 1 unless given.
    #[serde(default = "one")]
    pub scale: Length,
    /// The name of a material that covers it instead of the mesh's.
    #[serde(default)]
    #[schemars(with = "String")]
    pub material: Option<At<String>>,
}

fn origin() -> Position {
    Position(glam::Vec3::ZERO)
}

fn one() -> Length {
    Length(1.0)
}
