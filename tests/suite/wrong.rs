//! Wrong scenes: each error names file, line and field, says what was found and what would be right.

use std::path::Path;

use twinlight::scene::{Error, parse};

const GOOD: &str = r#"[camera]
position = [0, 0, 5]
look_at = [0, 0, 0]
up = [0, 1, 0]
near = 1
far = 10

[film]
size = [8, 6]

[[light.directional]]
toward = [1, 1, 1]

[[material]]
name = "red"
color = "ff0000"

[[object.sphere]]
center = [0, 0, 0]
radius = 1
material = "red"

[[object.triangle]]
vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
material = "red"
"#;

fn good() -> String {
    GOOD.replace("\"ff0000\"", "\"#ff0000\"")
}

fn complaint(text: &str) -> String {
    match parse(text, Path::new("scenes/wrong.toml")) {
        Ok(_) => panic!("this should not be a scene:\n{text}"),
        Err(Error::Text(complaint)) => complaint.to_string(),
        Err(other) => panic!("{other}"),
    }
}

#[test]
fn the_scene_they_are_made_of_is_right() {
    parse(&good(), Path::new("x")).unwrap_or_else(|e| panic!("{e}"));
    parse(&good().replace('\n', "\r\n"), Path::new("x")).unwrap_or_else(|e| panic!("{e}"));
}

#[test]
fn each_fault_is_told_where_it_stands() {
    // What is replaced, by what, and the line and words that the error must have.
    let table: &[(&str, &str, usize, &[&str])] = &[
        ("far = 10", "far = 1", 6, &["camera.far", "found 1", "beyond the near one"]),
        ("far = 10", "far = nan", 6, &["camera.far", "found nan", "from 1e-6"]),
        ("far = 10", "far = inf", 6, &["camera.far", "found inf"]),
        ("near = 1", "near = -1", 5, &["camera.near", "found -1"]),
        ("near = 1", "neer = 1", 5, &["camera.neer", "unknown field `neer`", "`near`"]),
        ("near = 1", "near = \"x\"", 5, &["camera.near", "found \"x\"", "a length is a number"]),
        ("near = 1", "near = ", 5, &["string values must be quoted"]),
        ("up = [0, 1, 0]", "up = [0, 0, 0]", 4, &["camera.up", "found [0, 0, 0]", "not all zero"]),
        ("up = [0, 1, 0]", "up = [0, 0, 2]", 4, &["camera.up", "not along the view"]),
        ("look_at = [0, 0, 0]", "look_at = [0, 0, 5]", 3, &["camera.look_at", "not its own position"]),
        ("look_at = [0, 0, 0]\n", "", 1, &["camera", "missing field `look_at`"]),
        ("toward = [1, 1, 1]\n", "", 11, &["light.directional[0]", "missing field `toward`"]),
        ("radius = 1\n", "", 18, &["object.sphere[0]", "missing field `radius`"]),
        ("[0, 0, 5]", "[0, 0, nan]", 2, &["camera.position", "three numbers"]),
        ("[0, 0, 5]", "[0, 0, 5, 6]", 2, &["camera.position", "three numbers"]),
        ("[8, 6]", "[8, 0]", 9, &["film.size", "found [8, 0]", "from 1 to 65536"]),
        ("[8, 6]", "[65536, 65536]", 9, &["film.size", "found [65536, 65536]", "too many pixels"]),
        ("toward = [1, 1, 1]", "toward = [0, 0, 0]", 12, &["light.directional[0].toward", "not all zero"]),
        (
            "toward = [1, 1, 1]",
            "toward = [1, 1, 1]\ncamera = { position = [2, 2, 2], look_at = [2, 2, 2] }",
            13,
            &["light.directional[0].camera.look_at", "not its own position"],
        ),
        ("\"#ff0000\"", "\"red\"", 16, &["material[0].color", "found \"red\"", "\"#rrggbb\""]),
        ("color = \"#ff0000\"", "refract = 0.5", 16, &["material[0].refract", "behavior = \"glass\""]),
        ("color = \"#ff0000\"", "index = 1.5", 16, &["material[0].index", "behavior = \"glass\""]),
        ("color = \"#ff0000\"", "behavior = \"shiny\"", 16, &["material[0].behavior", "`shiny`", "`glass`"]),
        (
            "radius = 1\nmaterial = \"red\"",
            "radius = 1\nmaterial = \"blue\"",
            21,
            &["object.sphere[0].material", "found \"blue\"", "the materials are \"red\""],
        ),
        ("radius = 1", "radius = 0", 20, &["object.sphere[0].radius", "found 0", "from 1e-6"]),
        ("[0, 1, 0]]", "[2, 0, 0]]", 24, &["object.triangle[0].vertices", "not on one line"]),
        ("[film]", "[film", 8, &["scenes/wrong.toml:8:"]),
        ("[film]", "[camera]", 8, &["duplicate key"]),
        ("[film]", "[[material]]\nname = \"red\"\n[film]", 17, &["material[1].name", "one name"]),
        ("[film]", "[flim]", 8, &["flim", "unknown field `flim`", "`film`"]),
    ];
    for (from, to, line, words) in table {
        let text = good();
        assert!(text.contains(from), "{from}");
        let told = complaint(&text.replacen(from, to, 1));
        let place = format!("scenes/wrong.toml:{line}:");
        assert!(told.starts_with(&place), "{to}: wanted {place}\n{told}");
        for word in *words {
            assert!(told.contains(word), "{to}: wanted {word:?}\n{told}");
        }
        assert!(told.contains('^'), "{told}");
    }
}

#[test]
fn odd_texts_are_told_too() {
    for text in ["", "\u{feff}", "x", "= 1", "[camera]", "\0", "camera = 1", "🦀 = [", "[[[[", "a.b.c = 1"] {
        let told = complaint(text);
        assert!(told.starts_with("scenes/wrong.toml:1:"), "{text:?}: {told}");
    }
    let deep = format!("a = {}{}", "[".repeat(100_000), "]".repeat(100_000));
    assert!(complaint(&deep).len() < 1000);
}
