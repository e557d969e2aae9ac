//! What changes from frame to frame, and what the command line puts into a scene.

use std::path::Path;

use glam::Vec3;
use twinlight::scene::{Error, Reach, Scene, Source};

use super::{Dice, root};

const SCENE: &str = r#"[camera]
position = [0, 0, 4]
look_at = [0, 0, 0]

[[light.directional]]
toward = [1, 0, 0]

[[material]]
name = "red"

[[object.sphere]]
center = [0, 0, 0]
radius = 1
material = "red"

[animation]
frames = 8
"#;

/// A scene's file with more after it, and what is set.
fn source(more: &str, sets: &[&str]) -> Result<Source, Error> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("moving.toml");
    std::fs::write(&path, format!("{SCENE}{more}")).expect("written");
    let sets: Vec<_> = sets.iter().map(|set| (*set).to_owned()).collect();
    Source::open(&path, &sets, &Reach::default())
}

fn scenes(more: &str, frames: &[i64]) -> Vec<Scene> {
    let source = source(more, &[]).unwrap_or_else(|e| panic!("{e}"));
    frames.iter().map(|&frame| source.scene(frame).unwrap_or_else(|e| panic!("{e}"))).collect()
}

fn track(keys: &str, how: &str) -> String {
    format!("[[animation.track]]\ntarget = \"object.sphere[0].radius\"\nkeys = {keys}\ninterpolation = \"{how}\"\n")
}

#[test]
fn tracks_go_through_their_keys() {
    let radius = |more: &str, frames: &[i64]| -> Vec<f32> {
        scenes(more, frames).iter().map(|scene| scene.spheres[0].radius).collect()
    };
    let keys = "[[3, 1], [7, 5], [9, 2.5]]";
    assert_eq!(
        radius(&track(keys, "linear"), &[1, 3, 4, 5, 7, 8, 9, 99]),
        [1.0, 1.0, 2.0, 3.0, 5.0, 3.75, 2.5, 2.5]
    );
    assert_eq!(radius(&track(keys, "step"), &[0, 3, 6, 7, 8, 9]), [1.0, 1.0, 1.0, 5.0, 5.0, 2.5]);
    // Through three points of a line a smooth curve is that line, whatever the steps between them.
    assert_eq!(radius(&track("[[1, 1], [3, 2], [7, 4]]", "smooth"), &[1, 2, 3, 5, 7]), [1.0, 1.5, 2.0, 3.0, 4.0]);
    let smooth = radius(&track(keys, "smooth"), &[3, 6, 7, 8]);
    assert!(smooth[0] == 1.0 && smooth[2] == 5.0, "{smooth:?}");
    assert!(smooth[1] > 4.0 && smooth[3] < 5.0, "no corner at a key: {smooth:?}");
    let colors = "[[animation.track]]\ntarget = \"material[0].color\"\nkeys = [[1, [0, 0, 0]], [5, [1, 0.5, 0]]]\n";
    assert_eq!(scenes(colors, &[3])[0].materials[0].color, Vec3::new(0.5, 0.25, 0.0));
    let words = "[[animation.track]]\ntarget = \"method\"\nkeys = [[1, \"trace\"], [2, \"raster\"]]\n\
        interpolation = \"step\"\n[[animation.track]]\ntarget = \"camera.fov\"\nkeys = [[1, 50]]\n";
    let both = scenes(words, &[1, 2]);
    assert_ne!(both[0].method, both[1].method);
    assert!(both.iter().all(|scene| scene.camera.fov == 50_f32.to_radians()), "a field that the file leaves out");
}

#[test]
fn orbits_turn_evenly_and_end_where_they_began() {
    let camera = "[[animation.orbit]]\ntarget = \"camera.position\"\naround = [1, 0, 0]\n";
    let light = "[[animation.orbit]]\ntarget = \"light.directional[0].toward\"\naxis = [0, 0, 3]\nturns = -0.5\n";
    let all = scenes(&(camera.to_owned() + light), &[1, 2, 3, 5, 9]);
    assert_eq!(all[0].camera.position, Vec3::new(0.0, 0.0, 4.0), "frame 1 is the file's");
    assert_eq!(all[4].camera.position, all[0].camera.position, "and the one after the last is that again");
    for scene in &all {
        let away = scene.camera.position - Vec3::X;
        assert!((away.length() - 17_f32.sqrt()).abs() < 1e-6 && away.y == 0.0, "{away}");
    }
    // A quarter turn about y takes z to x.
    assert!((all[2].camera.position - Vec3::new(5.0, 0.0, 1.0)).length() < 1e-6, "{}", all[2].camera.position);
    let toward = |i: usize| match &all[i].lights[0] {
        twinlight::scene::Light::Directional { toward, .. } => *toward,
        other @ twinlight::scene::Light::Point { .. } => panic!("{other:?}"),
    };
    assert!((toward(3) - Vec3::new(0.0, -1.0, 0.0).normalize()).length() < 0.8, "{}", toward(3));
    assert!((toward(4) + Vec3::X).length() < 1e-6, "half a turn the other way: {}", toward(4));
}

#[test]
fn what_is_set_wins_and_is_told_by_its_own_place() {
    let set = |sets: &[&str]| source("", sets).and_then(|source| source.scene(1));
    let scene = set(&["camera.fov=40", "object.sphere[0].center[1] = 2.5", "film.size=[7, 5]", "camera.fov=30"])
        .unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(scene.camera.fov, 30_f32.to_radians(), "the last one counts");
    assert_eq!(scene.spheres[0].center, Vec3::new(0.0, 2.5, 0.0));
    assert_eq!(scene.film.size, [7, 5], "a table that the file has not");
    for (wrong, words) in [
        ("camera.fov=400", "--set:1:12: camera.fov: found 400; a vertical field of view"),
        ("camera.fovv=40", "--set:1:13: camera.fovv: unknown field `fovv`"),
        ("camera.fov", "is written as camera.fov=40"),
        ("camera..fov=1", "is no field"),
        ("[0]=1", "is no field"),
        ("camera.fov=", "--set:1:"),
        ("camera.fov=1 2", "--set:1:"),
        ("object.sphere[1].radius=1", "entries go from 0 to below 1"),
        ("object.sphere.radius=1", "are called [0], [1]"),
        ("camera.fov.x=1", "object.sphere"),
        ("method.x.y=1", "--set:1:"),
        (
            "object.sphere[0].material=\"blue\"",
            "--set:1:27: object.sphere[0].material: found \"blue\"; the materials",
        ),
        ("animation.frames=0", "--set:1:18: animation.frames: found 0"),
    ] {
        match set(&[wrong]) {
            Err(Error::Text(told)) => {
                assert!(told.of_command_line(), "{told}");
                let words = if wrong == "camera.fov.x=1" { "camera.fov" } else { words };
                assert!(told.to_string().contains(words), "{wrong}: {told}");
            }
            other => panic!("{wrong}: {:?}", other.map(|_| "a scene")),
        }
    }
    let model = Source::open(&root().join("scenes/meshes/bust.obj"), &["camera.fov=3".into()], &Reach::default());
    let model = model.and_then(|source| source.scene(1)).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(model.camera.fov, 3_f32.to_radians(), "a model alone is like a scene that nobody has written");
}

#[test]
fn wrong_animations_are_told_with_line_and_frame() {
    let told = |more: &str, frame: i64| {
        let scene = source(more, &[]).and_then(|source| source.scene(frame));
        scene.err().unwrap_or_else(|| panic!("this should not be a scene:\n{more}")).to_string()
    };
    for (more, words) in [
        (track("[[1, 1], [5, -3]]", "linear"), "animation.track[0].keys: found [[1, 1], [5, -3]]; a length is"),
        (track("[[1, 1], [5, -3]]", "linear"), "(in frame 4)"),
        (track("[]", "linear"), "keys are at least one"),
        (track("[[5, 1], [5, 2]]", "linear"), "at a later frame"),
        (track("[[1, 1], [5, \"x\"]]", "linear"), "needs \"step\""),
        (track("[[1, [1, 2]], [5, [1]]]", "linear"), "lists of as many"),
        (track("[1, 2]", "linear"), "a key is a list of a frame and a value"),
        (track("[[1.5, 2]]", "linear"), "a key is a list of a frame and a value"),
        (track("[[1, 2, 3]]", "linear"), "a key is a list of a frame and a value"),
        (track("[[1, 2]]", "cubic"), "unknown variant `cubic`"),
        (track("[[1, 2]]", "step").replace("object.sphere[0]", "object.sphere[8]"), "entries go from 0 to below 1"),
        (track("[[1, 2]]", "step").replace("object.sphere[0]", "obj ect"), "is no field"),
        ("[[animation.orbit]]\ntarget = \"camera.fov\"\n".to_owned(), "only such a list turns"),
        ("[[animation.orbit]]\ntarget = \"camera.position\"\naxis = [0, 0, 0]\n".to_owned(), "not all zero"),
        ("rate = 0\n".to_owned(), "a rate is"),
        ("speed = 1\n".to_owned(), "unknown field `speed`"),
    ] {
        let told = told(&more, 4);
        assert!(told.contains(words), "{more}: wanted {words:?}\n{told}");
        assert!(told.contains("moving.toml:"), "{told}");
    }
}

/// Any text as an animation or as what is set: an error or a scene.
#[test]
fn no_text_makes_it_panic() {
    const PARTS: &[&str] = &[
        "camera",
        ".",
        "fov",
        "[",
        "0",
        "]",
        "=",
        "1e999",
        "nan",
        "-inf",
        "\"",
        "[[1, ",
        "]]",
        "{",
        "}",
        "a",
        ",",
        "'''",
        "\n",
        "[animation]",
        "[[animation.track]]\n",
        "target = \"camera.fov\"\n",
        "keys = ",
        "[[1, 40]]",
        "[[1, [1]], [9223372036854775807, 2]]",
        "[[-9223372036854775808, 1], [9, 2]]",
        "\n[[animation.orbit]]\n",
        "turns = 1e6\n",
        "interpolation = \"smooth\"\n",
        "object.sphere[0].radius",
        "[18446744073709551616]",
        "é",
    ];
    let mut dice = Dice(77, 0);
    let (mut wrong, mut right) = (0, 0);
    for _ in 0..3000 {
        let mut text = || (0..=dice.below(7)).map(|_| PARTS[dice.below(PARTS.len())]).collect::<String>();
        let (more, set) = (text(), text());
        let sets = if more.len() % 2 == 0 { vec![set.as_str()] } else { Vec::new() };
        match source(&more, &sets).and_then(|source| source.scene(7)) {
            Ok(_) => right += 1,
            Err(error) => {
                assert!(!error.to_string().is_empty());
                wrong += 1;
            }
        }
    }
    assert!(right > 10 && wrong > 1000, "{right} right, {wrong} wrong: that is no fuzzing");
}

#[test]
fn the_turntable_turns() {
    let source = Source::open(&root().join("scenes/turntable.toml"), &[], &Reach::default());
    let source = source.unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(source.frames(), Some((100, 25.0)));
    assert_eq!(source.path(), Path::new(root()).join("scenes/turntable.toml"));
    let [first, middle] = [1, 51].map(|frame| source.scene(frame).unwrap_or_else(|e| panic!("{e}")));
    assert!((first.camera.position * Vec3::new(-1.0, 1.0, -1.0) - middle.camera.position).length() < 1e-5);
    let same = std::sync::Arc::ptr_eq(&first.meshes[0].model, &middle.meshes[0].model);
    assert!(same, "the model is read once for all frames");
}
