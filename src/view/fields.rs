//! what of a scene can be changed by hand, and within which bounds: the window's panels are made of this list

/// A field of a scene file.
#[derive(Debug, Clone, Copy)]
pub struct Field {
    /// As the file calls it.
    pub name: &'static str,
    /// What it holds.
    pub kind: Kind,
    /// What it is unless it is given, in TOML.
    pub usual: &'static str,
}

/// What a field holds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kind {
    /// A number between two bounds.
    Number(f64, f64),
    /// A whole number between two bounds.
    Whole(f64, f64),
    /// One of some whole numbers.
    OneOf(&'static [u32]),
    /// Some numbers, each between two bounds.
    Numbers(f64, f64),
    /// Red, green and blue, or `#rrggbb`.
    Color,
    /// One of some words.
    Word(&'static [&'static str]),
}

/// A table, or each of an array of tables.
#[derive(Debug, Clone, Copy)]
pub struct Group {
    /// As the file calls it.
    pub place: &'static str,
    /// What a person calls it.
    pub title: &'static str,
    /// Whether there may be many.
    pub many: bool,
    /// What is in it.
    pub fields: &'static [Field],
}

const fn field(name: &'static str, kind: Kind, usual: &'static str) -> Field {
    Field { name, kind, usual }
}

const WEIGHT: Kind = Kind::Number(0.0, 1.0);
const INTENSITY: Kind = Kind::Number(0.0, 1e6);
const POSITION: Kind = Kind::Numbers(-1e9, 1e9);
const FILTER: Kind = Kind::Word(&["nearest", "bilinear", "mipmap"]);
const SPECULAR: Kind = Kind::Word(&["phong", "blinn"]);

/// All of them. The camera is moved by hand, and written when the scene is saved.
pub const GROUPS: &[Group] = &[
    Group {
        place: "light.directional",
        title: "Directional light",
        many: true,
        fields: &[
            field("toward", POSITION, "[0, 1, 0]"),
            field("color", Kind::Color, "[1, 1, 1]"),
            field("intensity", INTENSITY, "1"),
        ],
    },
    Group {
        place: "light.point",
        title: "Point light",
        many: true,
        fields: &[
            field("position", POSITION, "[0, 0, 0]"),
            field("color", Kind::Color, "[1, 1, 1]"),
            field("intensity", INTENSITY, "1"),
        ],
    },
    Group {
        place: "material",
        title: "Material",
        many: true,
        fields: &[
            field("color", Kind::Color, "[1, 1, 1]"),
            field("local", WEIGHT, "1"),
            field("reflect", WEIGHT, "0"),
            field("exponent", Kind::Number(0.0, 1e4), "10"),
        ],
    },
    Group {
        place: "film",
        title: "Film",
        many: false,
        fields: &[
            field("size", Kind::Numbers(1.0, 8192.0), "[800, 600]"),
            field("transfer", Kind::Word(&["srgb", "none"]), "\"srgb\""),
            field("background", Kind::Color, "[0, 0, 0]"),
        ],
    },
    Group {
        place: "raster",
        title: "Rasterizer",
        many: false,
        fields: &[
            field("samples", Kind::OneOf(&[1, 4, 9, 16, 25, 36, 64]), "4"),
            field("shadow_size", Kind::Whole(16.0, 4096.0), "2048"),
            field("shadow", WEIGHT, "0.3"),
            field("bias", WEIGHT, "0.0005"),
            field("blur", Kind::Whole(0.0, 3.0), "1"),
            field("ambient", Kind::Color, "[0, 0, 0]"),
            field("specular", SPECULAR, "\"phong\""),
            field("filter", FILTER, "\"mipmap\""),
        ],
    },
    Group {
        place: "trace",
        title: "Ray tracer",
        many: false,
        fields: &[
            field("samples", Kind::Whole(1.0, 65536.0), "16"),
            field("depth", Kind::Whole(1.0, 32.0), "6"),
            field("specular", SPECULAR, "\"phong\""),
            field("filter", FILTER, "\"mipmap\""),
            field("cutoff", WEIGHT, "0.0009765625"),
            field("seed", Kind::Whole(0.0, 4294967295.0), "0"),
        ],
    },
];
