//! a figure -> where the course project's document explains it

use serde::{Serialize as _, Serializer};

/// Fields of an [`Explanation`](super::Explanation), or words in them, each with its equation or section.
pub type Places = &'static [(&'static str, &'static str)];

/// Of the rasterizer's figures.
pub const DRAWN: Places = &[
    ("places", "1.2.3 Clip2Screen"),
    ("clip", "1.2.3 Camera2Clip"),
    ("edges", "Eq. 1.1"),
    ("weights", "Eq. 1.5"),
    ("z", "Eq. 1.4"),
    ("depth", "1.2.3 Depth testing"),
    ("point", "Eq. 1.5"),
    ("uv", "1.2.3 Center of gravity"),
    ("maps", "1.2.3 Fragment shader"),
    ("albedo", "1.2.3 Illustration"),
    ("specular", "1.2.3 Illustration"),
    ("exponent", "1.2.3 Illustration"),
    ("tangents", "1.2.3 Normal, fig. 1.9"),
    ("smooth", "1.2.3 Normal, fig. 1.9"),
    ("normal", "1.2.3 Normal, fig. 1.10"),
    ("view", "fig. 1.11"),
    ("toward", "fig. 1.11"),
    ("texel", "1.2.3 Shadow mapping"),
    ("share", "1.2.3 Shadow mapping"),
    ("diffuse", "I_diffuse, 1.2.3"),
    ("phong", "1.2.3 Illustration"),
    ("ambient", "Ambient, 1.2.3"),
    ("color", "color, 1.2.3"),
];

/// Of the ray tracer's figures.
pub const TRACED: Places = &[
    ("at", "2.2, fig. 2.2"),
    ("rays", "2.1, fig. 2.1"),
    ("weight", "2.1, step 5"),
    ("direction", "2.2"),
    ("sphere", "Eq. 2.3"),
    ("plane", "Eq. 2.5"),
    ("triangle", "2.3 Triangle"),
    ("point", "P + tD, Eq. 2.2"),
    ("normal", "Eq. 2.4, fig. 1.11"),
    ("maps", "1.2.3 Fragment shader"),
    ("tangents", "1.2.3 Normal, fig. 1.9"),
    ("shading", "1.2.3 Normal, fig. 1.10"),
    ("lights", "2.1, step 2"),
    ("toward", "fig. 1.11"),
    ("phong", "1.2.3 Illustration"),
    ("reflected", "Eq. 2.6; 2.1, step 3"),
    ("refracted", "Eq. 2.7; 2.1, step 4"),
    ("color", "2.1, step 5"),
];

/// Where a field is explained.
pub(super) fn place(places: Places, field: &str) -> &'static str {
    places.iter().find(|(name, _)| *name == field).map_or("", |(_, place)| place)
}

pub(super) fn serialize<S: Serializer>(places: &Places, to: S) -> Result<S::Ok, S::Error> {
    places.iter().copied().collect::<std::collections::BTreeMap<_, _>>().serialize(to)
}
