//! The CPU's pictures against those in `tests/golden`. A missing one is a failure.
//!
//! `UPDATE_GOLDEN=1 tests/run golden` writes them; look at what it wrote before you commit it.

use std::path::Path;

use twinlight::film::write_whole;
use twinlight::scene::Scene;

use super::{root, scene_on_cpu, scenes, small};

fn check(name: &str, scene: &Scene) {
    let picture = scene_on_cpu(scene).to_rgb8(scene.film.transfer);
    let path = root().join(format!("tests/golden/{name}.png"));
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        write_whole(&path, &picture).unwrap_or_else(|e| panic!("{e}"));
        return;
    }
    let new = path.with_extension("new.png");
    let hint = "UPDATE_GOLDEN=1 tests/run golden writes it";
    let bytes = std::fs::read(&path).unwrap_or_else(|e| panic!("{}: {e}; {hint}", path.display()));
    let golden = image::load_from_memory(&bytes).expect("a picture").to_rgb8();
    if golden != picture {
        write_whole(&new, &picture).unwrap_or_else(|e| panic!("{e}"));
        let differ = golden.pixels().zip(picture.pixels()).filter(|(a, b)| a != b).count();
        panic!("{name}: {differ} pixels differ; {} is what came out; {hint}", new.display());
    }
    let _ = std::fs::remove_file(new);
}

fn name(path: &Path) -> String {
    path.file_stem().expect("a name").to_string_lossy().into_owned()
}

#[test]
fn shipped_scenes_look_as_they_did() {
    for path in scenes() {
        check(&name(&path), &small(&path, [133, 101], 4));
    }
}

#[test]
fn the_specs_figures_look_as_they_did() {
    let room = root().join("scenes/room.toml");
    let diffuse = root().join("scenes/room-diffuse.toml");
    for depth in [3, 6] {
        let mut scene = small(&room, [133, 101], 16);
        scene.trace.depth = depth;
        check(&format!("figure-2.6-depth-{depth}"), &scene);
    }
    for grid in [1, 2, 4] {
        check(&format!("figure-2.5-grid-{grid}"), &small(&diffuse, [133, 101], grid * grid));
    }
}
