//! `twinlight explain` as a person and a script call it.

use std::collections::BTreeSet;
use std::process::Command;

use twinlight::explain::{DRAWN, Explainer, TRACED};
use twinlight::scene::{Method, Reach};

use super::explain::pixels;
use super::{root, small};

fn twinlight(arguments: &[&str]) -> (Option<i32>, String, String) {
    let out = Command::new(env!("CARGO_BIN_EXE_twinlight")).args(arguments).output().expect("the binary runs");
    let text = |bytes| String::from_utf8(bytes).expect("text");
    (out.status.code(), text(out.stdout), text(out.stderr))
}

#[test]
fn the_command_tells_the_rendered_pixel() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("a.png").display().to_string();
    let scene = root().join("scenes/bust.toml").display().to_string();
    let job = ["--size", "97x61", "--set", "raster.shadow_size=256"];
    let all = |first: &[&str], last: &[&str]| {
        let arguments: Vec<_> = first.iter().chain(&job).chain(last).copied().collect();
        twinlight(&arguments)
    };
    let (code, _, words) = all(&["render", &scene], &["--backend", "cpu", "-o", &file]);
    assert_eq!(code, Some(0), "{words}");
    let picture = image::open(&file).expect("a picture").to_rgb8();
    for [x, y] in [[48, 30], [0, 0], [96, 60], [40, 20]] {
        let at = format!("{x},{y}");
        let (code, text, words) = all(&["explain", &scene, "--pixel", &at], &[]);
        assert_eq!(code, Some(0), "{words}");
        let [r, g, b] = picture.get_pixel(x, y).0;
        assert!(text.ends_with(&format!(" -> 8 bits {r} {g} {b}\n")), "{text}");
        assert!(text.lines().all(|line| line.len() <= 120), "{text}");
        let (_, json, _) = all(&["explain", &scene, "--pixel", &at, "--json"], &[]);
        let json: serde_json::Value = serde_json::from_str(&json).expect("JSON");
        assert_eq!(json["rgb8"], serde_json::json!([r, g, b]));
        assert_eq!(json["pixel"], serde_json::json!([x, y]));
    }
    for (pixel, more, code, word) in [
        ("97,0", &[][..], 2, "97x61"),
        ("1;2", &[], 2, "400,300"),
        ("1,2", &["--show", "tiles"], 2, "counts faces"),
    ] {
        let (found, _, words) = all(&["explain", &scene, "--pixel", pixel], more);
        assert_eq!(found, Some(code), "{words}");
        assert!(words.contains(word), "{words}");
    }
}

const HEAD: &str = "[camera]\nposition = [0, 0, 9]\nlook_at = [0, 0, 0]\n[film]\nsize = [8, 6]\n\
                    [[material]]\nname = \"white\"\n";

#[test]
fn what_is_too_large_is_a_sentence_for_every_command() {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, text: String| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).expect("written");
        path.display().to_string()
    };
    let spheres = "[[object.sphere]]\ncenter = [0, 0, 0]\nradius = 1\nmaterial = \"white\"\n".repeat(40);
    let spheres = write("spheres.toml", format!("{HEAD}{spheres}"));
    write("many.obj", format!("v 0 0 0\nv 1 0 0\nv 0 1 0\n{}", "f 1 2 3\n".repeat(72_000)));
    // More triangles than 32 bits can number, in the memory of a few.
    let places = "[[object.mesh.instance]]\n".repeat(60_000);
    let places = write("places.toml", format!("{HEAD}[[object.mesh]]\npath = \"many.obj\"\n{places}"));
    let picture = folder.path().join("a.png").display().to_string();
    let cases: [(&[&str], i32, &str); 2] = [
        (&[&spheres, "--method", "raster", "--max-memory", "64M"], 6, "64 MiB of memory may be taken"),
        (&[&places, "--method", "trace"], 3, "can be told apart"),
    ];
    let commands: [(&str, &[&str]); 3] =
        [("render", &["--backend", "cpu", "-o", &picture]), ("explain", &["--pixel", "4,3"]), ("times", &[])];
    for (job, code, word) in cases {
        for (command, more) in commands {
            let (found, _, words) = twinlight(&[&[command], job, more].concat());
            assert!(found == Some(code) && words.contains(word), "{command} {job:?}: exit {found:?}, {words}");
        }
    }
}

/// The names of all fields in a value, and the words that stand as values.
fn fields(value: &serde_json::Value, names: &mut BTreeSet<String>, words: &mut BTreeSet<String>) {
    match value {
        serde_json::Value::Object(map) => {
            for (name, inner) in map {
                names.insert(name.clone());
                if name != "spec" {
                    fields(inner, names, words);
                }
            }
        }
        serde_json::Value::Array(all) => all.iter().for_each(|inner| fields(inner, names, words)),
        serde_json::Value::String(word) => {
            words.insert(word.clone());
        }
        _ => {}
    }
}

#[test]
fn the_json_is_what_the_help_says() {
    let (code, help, _) = twinlight(&["explain", "--help"]);
    assert_eq!(code, Some(0));
    let outline = help.split_once("The object of --json").expect("an outline").1;
    let outline = outline.split_once('{').expect("an outline").1;
    let promised: BTreeSet<String> = outline
        .split(|c: char| !(c.is_ascii_alphanumeric() || c == '_'))
        .filter(|word| !word.is_empty())
        .map(str::to_owned)
        .collect();
    let mut found = BTreeSet::from(["raster", "trace"].map(str::to_owned));
    for (scene, method, places) in [("bust", Method::Raster, DRAWN), ("pyramid", Method::Trace, TRACED)] {
        let scene = small(&root().join(format!("scenes/{scene}.toml")), [97, 61], 1);
        let explainer = Explainer::new(&scene, method, &Reach::default()).expect("an explainer");
        let (mut names, mut words) = (BTreeSet::new(), BTreeSet::new());
        for at in pixels(1, [97, 61], 40) {
            let json = serde_json::to_value(explainer.pixel(at).expect("a pixel")).expect("JSON");
            fields(&json, &mut names, &mut words);
            assert_eq!(json["spec"].as_object().expect("places").len(), places.len());
        }
        for (field, place) in places {
            assert!(names.contains(*field) || words.contains(*field), "{field} ({place}) is told nowhere");
        }
        found.append(&mut names);
    }
    let differ: Vec<_> = found.symmetric_difference(&promised).collect();
    assert!(differ.is_empty(), "the help's outline and the objects differ in {differ:?}");
}
