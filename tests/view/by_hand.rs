//! Drags and keys: what they do to the eye, and that the list of keys is right.

use glam::{Vec2, Vec3};
use twinlight::film::compare::Standard;
use twinlight::render::live::Side;
use twinlight::scene::Draft;
use twinlight::scene::{Camera, Held, Method, Reach, Show};
use twinlight::view::desk::{Desk, Hand};
use twinlight::view::difference::difference;
use twinlight::view::eye::{Eye as _, From};
use twinlight::view::fields::GROUPS;
use twinlight::view::keys::{Command, KEYS, search};

use super::{root, small};

fn camera() -> Camera {
    small("room", [32, 24], 1).camera
}

fn desk(name: &str, method: Method) -> Desk {
    let desk = Desk::open(&root().join(format!("scenes/{name}.toml")), &[], &Reach::default());
    desk.unwrap_or_else(|e| panic!("{e}")).with(Some(method), Side::Gpu)
}

/// Where a point is in the picture: shares of its height, right and down from the middle.
fn seen(camera: &Camera, point: Vec3) -> Vec2 {
    let back = (camera.position - camera.look_at).normalize();
    let right = camera.up.cross(back).normalize();
    let up = back.cross(right);
    let to = point - camera.position;
    let high = 2.0 * (camera.fov / 2.0).tan() * -to.dot(back);
    Vec2::new(to.dot(right), -to.dot(up)) / high
}

#[test]
fn a_turn_about_the_pivot_keeps_it_and_its_distance() {
    let mut eye = camera();
    let pivot = eye.look_at;
    let away = eye.position.distance(pivot);
    for drag in [Vec2::new(0.3, 0.0), Vec2::new(-0.1, 0.2), Vec2::new(0.0, -3.0), Vec2::new(2.0, 5.0)] {
        eye.orbit(pivot, drag);
        assert!((eye.position.distance(pivot) - away).abs() < away * 1e-4, "{drag:?}");
        assert!(seen(&eye, pivot).length() < 1e-3, "{drag:?}");
        // However far one drags, the eye does not turn over.
        let back = (eye.position - eye.look_at).normalize();
        assert!(back.dot(eye.up.normalize()).abs() < 0.99985, "{drag:?}");
    }
}

#[test]
fn what_is_under_the_cursor_stays_there() {
    let pivot = Vec3::new(1.0, 2.0, -30.0);
    let mut eye = camera();
    let before = seen(&eye, pivot);
    eye.pan(pivot, Vec2::new(0.25, -0.125));
    let moved = seen(&eye, pivot) - before;
    assert!(moved.distance(Vec2::new(0.25, -0.125)) < 1e-4, "a pan moves it with the cursor: {moved}");

    let place = Vec2::new(-0.3, 0.2);
    let point = eye.under(pivot, place);
    assert!(seen(&eye, point).distance(place) < 1e-4);
    eye.dolly(point, 0.5);
    assert!(seen(&eye, point).distance(place) < 1e-3, "going nearer keeps it in its place");
}

#[test]
fn looking_around_stays_where_it_is() {
    let mut eye = camera();
    let (place, toward) = (eye.position, (eye.look_at - eye.position).normalize());
    eye.turn(Vec2::new(0.1, 0.05));
    assert!(eye.position.distance(place) < 1e-4);
    assert!((eye.look_at - eye.position).normalize().dot(toward) < 0.9999);
}

#[test]
fn all_is_in_the_frame_from_every_side() {
    let mut desk = desk("pyramid", Method::Raster);
    let sides = [From::Front, From::Back, From::Right, From::Left, From::Top, From::Bottom, From::Corner];
    for side in sides {
        desk.obey(Command::From(side));
        desk.obey(Command::FrameAll);
        let camera = &desk.scene().camera;
        let [center, corner] = desk.scene().bounds().expect("a pyramid");
        let half = corner - center;
        for i in 0..8 {
            let sign = Vec3::from_array([0, 1, 2].map(|bit| if i >> bit & 1 == 0 { -1.0 } else { 1.0 }));
            let at = seen(camera, center + half * sign);
            assert!(at.y.abs() < 0.5 && at.x.abs() < 0.5 * 40.0 / 30.0, "{side:?}: a corner is at {at}");
        }
    }
}

#[test]
fn a_drag_is_one_step_back() {
    let mut desk = desk("room", Method::Trace);
    let start = desk.scene().camera.clone();
    for _ in 0..9 {
        desk.hand(Hand::Orbit(Vec2::new(0.02, 0.01)));
    }
    desk.let_go();
    let end = desk.scene().camera.clone();
    desk.obey(Command::Undo);
    assert_eq!(desk.scene().camera, start);
    desk.obey(Command::Undo);
    assert_eq!(desk.scene().camera, start, "there is nothing before the first step");
    desk.obey(Command::Redo);
    assert_eq!(desk.scene().camera, end);
}

#[test]
fn a_view_of_the_rasterizer_is_drawn_by_it() {
    let mut desk = desk("room", Method::Trace);
    desk.obey(Command::Show(Show::Normal));
    assert_eq!((desk.method(), desk.scene().raster.show), (Method::Raster, Show::Normal));
}

#[test]
fn a_value_is_seen_taken_back_and_refused() {
    let mut desk = desk("room", Method::Trace);
    let start = desk.scene().lights.clone();
    for intensity in [0.5, 0.6, 0.7] {
        desk.set("light.point[0].intensity", &Held::Number(intensity)).expect("a right value");
    }
    desk.let_go();
    assert_ne!(desk.scene().lights, start);
    assert!(desk.unsaved());
    let wrong = desk.set("light.point[0].intensity", &Held::Number(-1.0)).expect_err("no light is below nothing");
    assert!(wrong.contains("intensity"), "{wrong}");
    assert_eq!(desk.draft().get("light.point[0].intensity"), Some(Held::Number(0.7)));
    desk.let_go();
    desk.obey(Command::Undo);
    assert_eq!(desk.scene().lights, start, "three values of one drag are one step");
    assert!(!desk.unsaved());
}

#[test]
fn every_field_of_the_panels_is_one_of_the_format() {
    let mut desk = desk("room", Method::Trace);
    for group in GROUPS {
        if group.many && desk.draft().count(group.place) == 0 {
            continue;
        }
        for field in group.fields {
            let place = if group.many {
                format!("{}[0].{}", group.place, field.name)
            } else {
                format!("{}.{}", group.place, field.name)
            };
            let mut usual = Draft::new("").expect("nothing is TOML");
            usual.set("usual", field.usual).unwrap_or_else(|e| panic!("{place}: {e}"));
            let usual = usual.get("usual").expect("a value");
            assert_eq!(desk.set(&place, &usual), Ok(()), "{place}");
        }
    }
}

#[test]
fn what_is_saved_opens_as_it_was_seen() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("room.toml");
    std::fs::copy(root().join("scenes/room.toml"), &file).expect("a copy");
    let mut desk = Desk::open(&file, &[], &Reach::default()).expect("a room");
    desk.hand(Hand::Orbit(Vec2::new(0.07, 0.03)));
    desk.hand(Hand::Dolly(Vec2::new(0.1, 0.2), 0.9));
    desk.set("light.point[0].intensity", &Held::Number(0.55)).expect("a right value");
    desk.let_go();
    assert_eq!(desk.save().expect("a place to write"), file);
    assert!(!desk.unsaved());
    let text = std::fs::read_to_string(&file).expect("a file");
    assert!(text.contains("# 1.05 rad") && text.starts_with("#:schema"), "comments stay: {text}");
    let again = Desk::open(&file, &[], &Reach::default()).expect("a room");
    assert!(again.scene().camera == desk.scene().camera && again.scene().lights == desk.scene().lights);
}

#[test]
fn undo_never_writes_over_what_somebody_else_has_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("room.toml");
    std::fs::copy(root().join("scenes/room.toml"), &file).expect("a copy");
    let open = |desk: Option<&Desk>| {
        let edits = desk.map(|desk| desk.draft().edits().to_vec()).unwrap_or_default();
        Desk::open(&file, &edits, &Reach::default()).expect("a room")
    };
    let text = || std::fs::read_to_string(&file).expect("a file");
    let turn = Hand::Orbit(Vec2::new(0.07, 0.03));
    let mut desk = open(None);
    let start = desk.scene().camera.clone();
    desk.set("light.point[0].intensity", &Held::Number(0.55)).expect("a right value");
    desk.let_go();
    desk.hand(turn);
    desk.let_go();
    // One step is done, one is in hand, and one is taken back, when the file is another.
    desk.obey(Command::Undo);
    desk.hand(turn);
    let other = text().replace("[film]", "# by another hand\n[film]");
    assert_ne!(other, text(), "that is no test");
    std::fs::write(&file, &other).expect("written");
    assert!(desk.renew(open(Some(&desk))), "steps are gone, and that is told");
    desk.let_go();
    for command in [Command::Undo, Command::Undo, Command::Redo, Command::Redo, Command::Undo] {
        desk.obey(command);
        assert!(desk.draft().text().contains("# by another hand"), "{command:?}");
    }
    assert_eq!(desk.scene().camera, start, "the step in hand is one that can be undone");
    assert_eq!(desk.draft().get("light.point[0].intensity"), Some(Held::Number(0.55)), "what was put in stays");
    desk.save().expect("a place to write");
    assert_eq!(text(), other.replacen("intensity = 0.4", "intensity = 0.55", 1));
    // What the window itself has written is no other text.
    assert!(!desk.renew(open(Some(&desk))), "nothing is gone");
    desk.obey(Command::Redo);
    assert_ne!(desk.scene().camera, start);
}

#[test]
fn neither_hand_writes_over_the_other() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("room.toml");
    std::fs::copy(root().join("scenes/room.toml"), &file).expect("a copy");
    let open = |edits: &[(String, String)]| Desk::open(&file, edits, &Reach::default()).expect("a room");
    let text = || std::fs::read_to_string(&file).expect("a file");
    let mut desk = open(&[]);
    let intensity = "light.point[0].intensity";
    desk.set(intensity, &Held::Number(0.55)).expect("a right value");
    desk.let_go();
    // Another hand writes the file, and the window has not read it yet.
    let other = text().replace("[film]", "# by another hand\n[film]");
    std::fs::write(&file, &other).expect("written");
    assert!(desk.is_behind());
    let why = desk.save().expect_err("it would be lost");
    assert!(why.contains("has changed since it was read"), "{why}");
    assert_eq!(text(), other, "and is not");
    // What is put in while it is read stays, too.
    let read = open(desk.draft().edits());
    desk.set(intensity, &Held::Number(0.66)).expect("a right value");
    desk.set("film.background", &Held::Numbers(vec![0.5, 0.25, 0.125])).expect("a right value");
    desk.let_go();
    desk.renew(read);
    assert_eq!(desk.draft().get(intensity), Some(Held::Number(0.66)));
    assert_eq!(desk.scene().film.background.to_array(), [0.5, 0.25, 0.125]);
    assert!(!desk.is_behind() && desk.draft().text().contains("# by another hand"));
    desk.save().expect("a place to write");
    assert!(text().contains("# by another hand") && text().contains("intensity = 0.66"), "{}", text());
}

#[test]
fn a_copied_camera_is_pasted_to_the_bit() {
    let mut one = desk("room", Method::Trace);
    one.hand(Hand::Orbit(Vec2::new(0.31, -0.2)));
    let mut other = desk("room", Method::Trace);
    other.paste_camera(&one.camera_toml()).expect("a camera");
    let [a, b] = [&one, &other].map(|desk| desk.scene().camera.clone());
    assert_eq!((a.position, a.look_at), (b.position, b.look_at));
    for wrong in ["nothing", "a = 1", "[camera]\nfov = 400"] {
        other.paste_camera(wrong).expect_err(wrong);
    }
}

#[test]
fn a_model_alone_is_worked_on_like_a_scene() {
    let path = root().join("scenes/meshes/bust.obj");
    let mut desk = Desk::open(&path, &[], &Reach::default()).expect("a model");
    let alone = twinlight::scene::load(&path).expect("a model");
    assert_eq!((desk.scene().camera.position, desk.scene().film.size), (alone.camera.position, alone.film.size));
    desk.set("light.directional[0].intensity", &Held::Number(0.5)).expect("a light");
    let command = desk.command([320, 200], "bust.png".as_ref()).expect("a command");
    assert!(
        command.contains("light.directional[0].intensity=0.5") && command.contains("--size 320x200"),
        "{command}"
    );
}

#[test]
fn the_difference_of_two_pictures_is_counted_and_judged() {
    let picture = vec![0xff80_8080_u32; 12];
    let mut other = picture.clone();
    let same = difference([4, 3], &picture, &other, Standard::Exact).expect("one size");
    assert!(same.passes && same.pixels == 0);
    other[5] = 0xff80_8090;
    let found = difference([4, 3], &picture, &other, Standard::Exact).expect("one size");
    assert_eq!((found.passes, found.pixels, found.largest, found.words[5]), (false, 1, 16, 0xff00_00ff));
    assert!(difference([4, 4], &picture, &other, Standard::Exact).is_none());
}

#[test]
fn no_key_does_two_things_and_every_view_has_one() {
    for (i, key) in KEYS.iter().enumerate() {
        assert!(KEYS[..i].iter().all(|other| other.chord != key.chord), "{} does two things", key.chord);
    }
    for show in <Show as clap::ValueEnum>::value_variants() {
        assert!(KEYS.iter().any(|key| key.command == Command::Show(*show)), "{show:?} has no key");
    }
}

#[test]
fn the_list_is_searched_by_words() {
    assert_eq!(search("ctrl UNDO").len(), 1);
    assert!(search("").len() > KEYS.len());
    assert!(search("nothing is called so").is_empty());
}
