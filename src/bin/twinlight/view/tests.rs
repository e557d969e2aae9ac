//! The window without a screen, on the software adapter: what it shows, what it hears, and that all of it has a name.
//! egui's harness itself asks after each step whether every input has an accessible name.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use clap::Parser as _;
use eframe::egui::{DroppedFile, Event, Key, Modifiers, PointerButton, pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use twinlight::film::{picture_of, write_whole};
use twinlight::gpu::Wanted;
use twinlight::scene::{Method, Show};

use super::Arguments;
use super::app::App;
use super::shell::{Left, setup};
use super::stage::Beside;

#[derive(clap::Parser)]
struct Line {
    #[command(flatten)]
    arguments: Arguments,
}

fn scene(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(name)
}

fn open(scene_name: &str, more: &[&str]) -> Harness<'static, App> {
    let path = scene(scene_name).to_string_lossy().into_owned();
    let words = ["view", &path, "--size", "160x120", "--samples", "4"].into_iter().chain(more.iter().copied());
    let arguments = Line::try_parse_from(words).unwrap_or_else(|e| panic!("{e}")).arguments;
    let builder = Harness::builder().with_size(vec2(900.0, 600.0)).wgpu_setup(setup(Wanted::Software));
    builder.build_eframe(move |cc| App::new(cc, &arguments, Left::default()).unwrap_or_else(|e| panic!("{e}")))
}

#[derive(Debug)]
struct Dropped(PathBuf);

impl DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        std::fs::read(&self.0).map_err(|error| error.to_string())
    }
}

fn drop_file(harness: &mut Harness<'_, App>, file: &Path) {
    harness.input_mut().dropped_files.push(Arc::new(Dropped(file.to_owned())));
    harness.step();
}

/// Steps until something is so.
fn until(harness: &mut Harness<'_, App>, what: &str, so: impl Fn(&App) -> bool) {
    let start = Instant::now();
    while !so(harness.state()) {
        assert!(
            start.elapsed() < Duration::from_mins(1),
            "in a minute: {what}; {:?}",
            harness.state().report.error
        );
        harness.step();
        std::thread::sleep(Duration::from_millis(5));
    }
}

fn done(app: &App) -> bool {
    let target = app.report.progress.target;
    app.picture.screen().is_some() && !app.report.busy && target > 0 && app.report.progress.has >= target
}

fn words(app: &App) -> Vec<u32> {
    app.picture.screen().expect("a picture").read(&app.gpu).expect("its words")
}

#[test]
fn the_window_shows_the_bytes_of_the_picture() {
    let mut harness = open("pyramid.toml", &[]);
    until(&mut harness, "a picture", done);
    harness.run_steps(3);
    let window = harness.render().expect("the window");
    let rect = harness.get_by_label("the picture").rect();
    let words = words(harness.state());
    let [left, top] = [rect.left(), rect.top()].map(|at| at.round() as u32);
    assert_eq!([rect.width(), rect.height()], [160.0, 120.0]);
    let mut colors = std::collections::BTreeSet::new();
    for (i, word) in words.iter().enumerate() {
        let (x, y) = (i as u32 % 160, i as u32 / 160);
        let [red, green, blue, _] = word.to_le_bytes();
        assert_eq!(&window.get_pixel(left + x, top + y).0[..3], [red, green, blue], "pixel {x},{y}");
        colors.insert(*word);
    }
    assert!(colors.len() > 50, "a picture has more than {} colors", colors.len());
}

#[test]
fn keys_and_menus_do_what_they_say() {
    let mut harness = open("pyramid.toml", &["--method", "raster"]);
    until(&mut harness, "a picture", done);
    let plain = words(harness.state());
    harness.key_press(Key::Num4);
    harness.step();
    until(&mut harness, "normals", |app| done(app) && words(app) != plain);
    assert_eq!(harness.state().desk.as_ref().map(|desk| desk.scene().raster.show), Some(Show::Normal));

    harness.get_by_label("Show").click();
    harness.run_steps(3);
    harness.get_by_label_contains("show the picture").click();
    harness.run_steps(3);
    until(&mut harness, "the first picture again", |app| done(app) && words(app) == plain);

    harness.key_press(Key::M);
    harness.step();
    assert_eq!(harness.state().desk.as_ref().map(twinlight::view::desk::Desk::method), Some(Method::Trace));
    until(&mut harness, "a traced picture", |app| done(app) && words(app) != plain);

    harness.key_press(Key::H);
    harness.run_steps(3);
    harness.event(Event::Text("undo".to_owned()));
    harness.run_steps(3);
    assert!(harness.query_by_label("Ctrl+Z").is_some() && harness.query_by_label("F12").is_none());
}

#[test]
fn a_drag_turns_the_eye_and_undo_turns_it_back() {
    let mut harness = open("pyramid.toml", &[]);
    until(&mut harness, "a picture", done);
    let camera = |app: &App| app.desk.as_ref().map(|desk| desk.scene().camera.clone());
    let home = camera(harness.state());
    let middle = harness.get_by_label("the picture").rect().center();
    let press = |at, pressed| Event::PointerButton {
        pos: at,
        button: PointerButton::Primary,
        pressed,
        modifiers: Modifiers::NONE,
    };
    harness.event(Event::PointerMoved(middle));
    harness.event(press(middle, true));
    harness.step();
    for i in 1..6 {
        harness.event(Event::PointerMoved(pos2(middle.x + 6.0 * i as f32, middle.y)));
        harness.step();
    }
    harness.event(press(pos2(middle.x + 30.0, middle.y), false));
    harness.run_steps(3);
    assert_ne!(camera(harness.state()), home, "it has turned");
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(3);
    assert_eq!(camera(harness.state()), home, "in one step");
}

#[test]
fn a_dropped_picture_is_compared_with_and_a_dropped_scene_is_opened() {
    let mut harness = open("pyramid.toml", &[]);
    until(&mut harness, "a picture", done);
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("saved.png");
    write_whole(&file, &picture_of([160, 120], &words(harness.state()))).expect("a file");
    drop_file(&mut harness, &file);
    let beside = |app: &App| app.compared.as_ref().map(|compared| compared.beside.clone());
    assert!(matches!(beside(harness.state()), Some(Beside::Saved(saved)) if saved.path() == file));
    harness.key_press(Key::D);
    harness.run_steps(3);
    until(&mut harness, "a verdict", |app| app.compared.as_ref().is_some_and(|c| c.words().is_some()));
    let verdict = harness.state().compared.as_ref().and_then(|c| c.words().map(str::to_owned)).unwrap_or_default();
    assert!(verdict.starts_with("0 pixels differ"), "{verdict}");

    drop_file(&mut harness, &scene("room.toml"));
    let path = |app: &App| app.desk.as_ref().map(|desk| desk.path().to_owned());
    until(&mut harness, "the room", |app| path(app).is_some_and(|path| path.ends_with("room.toml")));
}

#[test]
fn what_is_inside_is_told() {
    let mut harness = open("bust.toml", &["--set", "raster.shadow_size=256"]);
    until(&mut harness, "a picture", done);
    harness.key_press(Key::T);
    harness.key_press(Key::L);
    harness.step();
    until(&mut harness, "times and maps", |app| {
        done(app) && !app.report.times.is_empty() && !app.report.lights.is_empty()
    });
    harness.run_steps(3);
    assert!(harness.query_by_label("raster/shade").is_some(), "the chart names the stages");
    assert!(harness.query_all_by_label_contains("what light 1").count() >= 1, "a light's map has a name");
    // Their windows lie over the picture.
    harness.key_press(Key::T);
    harness.key_press(Key::L);
    harness.key_press(Key::I);
    harness.run_steps(3);
    let middle = harness.get_by_label("the picture").rect().center();
    harness.event(Event::PointerMoved(middle));
    harness.step();
    until(&mut harness, "an answer", |app| app.inspected.as_ref().is_some_and(|told| !told.lines.is_empty()));
}

#[test]
fn what_is_wrong_is_said_and_the_window_stays() {
    let mut harness = open("pyramid.toml", &[]);
    until(&mut harness, "a picture", done);
    let folder = tempfile::tempdir().expect("a folder");
    let broken = folder.path().join("broken.toml");
    std::fs::write(&broken, "[camera\n").expect("a file");
    drop_file(&mut harness, &broken);
    until(&mut harness, "a sentence", |app| {
        app.error.as_ref().is_some_and(|error| error.contains("broken.toml:1"))
    });
    assert!(done(harness.state()), "the last good picture is there");
}

#[test]
fn every_panel_has_names() {
    let mut harness = open("bust.toml", &["--set", "raster.shadow_size=256"]);
    until(&mut harness, "a picture", done);
    for title in ["Film", "Rasterizer", "Ray tracer", "Camera"] {
        if let Some(header) = harness.query_by_label(title) {
            header.click();
        }
        harness.run_steps(3);
    }
    assert!(harness.query_by_label("shadow_size").is_some(), "the panel of the rasterizer is open");
}
