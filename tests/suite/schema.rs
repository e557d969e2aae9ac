//! `scenes/scene.schema.json` says of a file what the parser says of it.

use std::path::Path;

use twinlight::scene::{file, parse};

use super::{root, scenes};

fn schema() -> jsonschema::Validator {
    let schema: serde_json::Value = serde_json::from_str(&file::schema()).expect("the schema is JSON");
    jsonschema::validator_for(&schema).expect("the schema is a schema")
}

fn json(text: &str) -> serde_json::Value {
    let table: toml::Table = toml::from_str(text).expect("TOML");
    serde_json::to_value(table).expect("JSON")
}

#[test]
fn the_schema_that_is_shipped_is_the_parsers() {
    let shipped = std::fs::read_to_string(root().join("scenes/scene.schema.json")).expect("the schema");
    assert!(shipped == file::schema(), "twinlight schema > scenes/scene.schema.json");
}

#[test]
fn every_shipped_scene_passes_both() {
    let schema = schema();
    for path in scenes() {
        let text = std::fs::read_to_string(&path).expect("a scene");
        let errors: Vec<_> = schema.iter_errors(&json(&text)).map(|e| e.to_string()).collect();
        assert!(errors.is_empty(), "{}: {errors:?}", path.display());
        parse(&text, &path).unwrap_or_else(|e| panic!("{e}"));
        assert!(text.starts_with("#:schema ./scene.schema.json"), "{}: editors need the line", path.display());
    }
}

/// What one value alone can have wrong, both must refuse.
#[test]
fn what_the_schema_refuses_the_parser_refuses_and_the_other_way_round() {
    let schema = schema();
    let good = "[camera]\nposition = [0, 0, 5]\nlook_at = [0, 0, 0]\nfov = 60\n[film]\nsize = [8, 6]\n\
        background = \"#102030\"\n[trace]\nsamples = 4\ndepth = 3\nspecular = \"blinn\"\n\
        [[material]]\nname = \"a\"\ncolor = [1, 0.5, 0]\nbehavior = \"glass\"\nindex = 1.5\n\
        [[object.sphere]]\ncenter = [0, 0, 0]\nradius = 1\nmaterial = \"a\"\n";
    let both = |text: &str| (schema.is_valid(&json(text)), parse(text, Path::new("x")).is_ok());
    assert_eq!(both(good), (true, true));
    let changes = [
        ("fov = 60", "fov = 0"),
        ("fov = 60", "fov = 200"),
        ("fov = 60", "fov = \"wide\""),
        ("fov = 60", "fovv = 60"),
        ("[0, 0, 5]", "[0, 0]"),
        ("[0, 0, 5]", "[0, 0, 2e9]"),
        ("look_at = [0, 0, 0]\n", ""),
        ("[8, 6]", "[0, 6]"),
        ("[8, 6]", "[8.5, 6]"),
        ("[8, 6]", "[8, 6, 3]"),
        ("[8, 6]", "[8, 70000]"),
        ("#102030", "#10203"),
        ("#102030", "red"),
        ("samples = 4", "samples = 0"),
        ("samples = 4", "samples = 65537"),
        ("depth = 3", "depth = 33"),
        ("\"blinn\"", "\"gouraud\""),
        ("[1, 0.5, 0]", "[1, -0.5, 0]"),
        ("index = 1.5", "index = 0.5"),
        ("radius = 1", "radius = 0"),
        ("radius = 1", "radius = -1"),
        ("radius = 1\n", ""),
        ("material = \"a\"\n", "material = 1\n"),
        ("[[object.sphere]]", "[[object.cube]]"),
    ];
    for (from, to) in changes {
        assert!(good.contains(from), "{from}");
        assert_eq!(both(&good.replacen(from, to, 1)), (false, false), "{to} for {from}");
    }
}
