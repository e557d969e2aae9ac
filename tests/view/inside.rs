//! What the window tells beside a picture: times of stages, what the lights see, ray trees over it, saved pictures.

use std::time::{Duration, Instant};

use glam::Vec2;
use twinlight::explain::{Explainer, Samples};
use twinlight::film::{Saved, is_picture, picture_of, write_whole};
use twinlight::gpu::wgsl::Sources;
use twinlight::gpu::{GpuRaster, Screen};
use twinlight::raster::frame;
use twinlight::render::live::{Live, Side, Wish};
use twinlight::scene::{Light, Method, Reach};
use twinlight::view::inspector::{Answer, Inspector, Question};
use twinlight::view::overlay::{Stroke, lines};

use super::{gpu, root, small};

#[test]
fn every_stage_is_timed_while_that_is_wanted() {
    let gpu = gpu();
    let scene = small("bust", [61, 47], 4);
    let drawing = twinlight::prepare::draw(&scene);
    let render = || {
        let start = Instant::now();
        let mut stages = GpuRaster::new(&gpu, &Sources::default(), &drawing).expect("stages");
        frame(&mut stages, &drawing, &mut |_| ()).expect("a film");
        start.elapsed()
    };
    render();
    assert!(gpu.measure(true), "lavapipe has a clock");
    let took = render();
    let times = gpu.times();
    gpu.measure(false);
    render();
    assert_eq!(gpu.times(), [], "nobody asked for these");

    let passes = |name: &str| times.iter().find(|time| time.name == name).map(|time| time.passes);
    assert_eq!(passes("raster/shade"), Some(4), "one a sample: {times:?}");
    assert_eq!(passes("raster/project"), Some(4 + drawing.lenses.len() as u32), "one a lens");
    let all: Duration = times.iter().map(|time| time.took).sum();
    assert!(all <= took, "{all:?} of {took:?}");
    assert!(times.iter().all(|time| time.took > Duration::ZERO), "{times:?}");
}

#[test]
fn lights_maps_show_what_lights_see() {
    let gpu = gpu();
    let scene = small("bust", [61, 47], 1);
    let wish = |side| Wish { scene: scene.clone(), method: Method::Raster, side, moving: false };
    let mut maps = Vec::new();
    for side in [Side::Gpu, Side::Cpu] {
        let mut live = Live::new(&gpu, &Sources::default(), wish(side), &Reach::default()).expect("a scene");
        let mut known = 0;
        while !live.step().expect("a picture") {}
        let seen = live.lights(&mut known).expect("maps").expect("new ones");
        assert_eq!(live.lights(&mut known).expect("maps"), None, "they are what they were");
        maps.push(seen);
    }
    assert!(maps[0] == maps[1], "both sides see the same");
    let names: Vec<_> = maps[0].iter().map(|map| map.name.as_str()).collect();
    let point =
        scene.lights.iter().position(|light| matches!(light, Light::Point { .. })).expect("a point light") + 1;
    assert_eq!(names.len(), 7, "one for the sun, six for the lamp");
    assert!(names.contains(&format!("light {point}, -z").as_str()), "{names:?}");
    let sun = maps[0].iter().find(|map| !map.name.contains(',')).expect("the sun's");
    assert_eq!((sun.size, sun.shown), ([256; 2], [256; 2]));
    let seen = sun.grays.iter().filter(|gray| **gray > 0).count();
    assert!(seen > 2000 && sun.grays.contains(&255), "{seen} texels see something, the nearest in white");
}

#[test]
fn a_ray_tree_is_drawn_where_it_runs() {
    let scene = small("room", [96, 72], 1);
    let explainer = Explainer::new(&scene, Method::Trace, &Reach::default()).expect("an explainer");
    let mut mirrored = 0;
    for pixel in [[30, 50], [60, 50], [20, 20], [70, 60]] {
        let told = explainer.pixel(pixel).expect("a pixel");
        let lines = lines(&scene, &told);
        let here = (Vec2::new(pixel[0] as f32, pixel[1] as f32) + 0.5) / Vec2::new(96.0, 72.0);
        let Samples::Trace(samples) = &told.samples else { panic!("it was traced") };
        let first = samples[0].rays[0].meets.as_ref().expect("a room has walls");
        let shadows = first.lights.iter().filter(|light| light.before).count();
        // What starts at the first hit starts at the pixel, within it.
        let starts = lines.iter().filter(|line| (line.ends[0] - here).abs().max_element() < 1.0 / 72.0).count();
        assert!(starts >= shadows, "{starts} lines start at {pixel:?}, which has {shadows} shadow rays");
        let lit = lines.iter().filter(|line| line.stroke == Stroke::Lit).count();
        let arrive = samples[0].rays.iter().filter_map(|ray| ray.meets.as_ref()).flat_map(|hit| &hit.lights);
        // Some of them run behind the eye.
        let arrive = arrive.filter(|light| light.before && light.arrives).count();
        assert!(lit <= arrive && lit * 2 >= arrive, "{lit} of {arrive}");
        mirrored += lines.iter().filter(|line| line.stroke == Stroke::Reflected).count();
    }
    assert!(mirrored > 0, "a room of mirrors");
}

#[test]
fn what_there_is_no_room_for_is_not_told() {
    let inspector = Inspector::new(Box::new(|| ()));
    let ask = |memory, point| {
        let reach = Reach { memory, ..Reach::default() };
        let scene = small("bust", [16, 12], 1);
        inspector.ask(Question { scene, method: Method::Trace, pixel: [8, 6], reach, point });
        let start = Instant::now();
        loop {
            match inspector.answer() {
                Some(Answer::Text(_, text, _)) => return text,
                Some(Answer::Point(Ok(point))) => return format!("{point:?}"),
                Some(Answer::Point(Err(why))) => return why,
                None => assert!(start.elapsed() < Duration::from_mins(1), "no answer"),
            }
            std::thread::sleep(Duration::from_millis(1));
        }
    };
    for point in [true, false] {
        let refused = ask(Some(1 << 20), point);
        assert!(refused.contains("1 MiB of memory may be taken"), "{refused}");
        let told = ask(None, point);
        assert!(told.starts_with("Some(Vec3") || told.contains("linear"), "{told}");
    }
}

#[test]
fn a_seen_face_is_outlined_around_its_pixel() {
    let scene = small("bust", [96, 72], 1);
    let explainer = Explainer::new(&scene, Method::Raster, &Reach::default()).expect("an explainer");
    let told = explainer.pixel([48, 30]).expect("a pixel");
    let lines = lines(&scene, &told);
    assert_eq!(lines.len(), 3);
    let middle = (Vec2::new(48.0, 30.0) + 0.5) / Vec2::new(96.0, 72.0);
    let turns = lines.iter().map(|line| (line.ends[1] - line.ends[0]).perp_dot(middle - line.ends[0]) > 0.0);
    let turns: Vec<_> = turns.collect();
    assert!(turns.iter().all(|turn| *turn == turns[0]), "the pixel lies inside: {lines:?}");
}

#[test]
fn a_saved_picture_has_the_pixels_that_are_wanted() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("saved.png");
    let words: Vec<u32> = (0..6).map(|i| 0xff00_0000 | (i * 0x28_1e0a)).collect();
    write_whole(&file, &picture_of([3, 2], &words)).expect("a picture");
    let saved = Saved::open(&file).expect("the same");
    assert_eq!(saved.words([3, 2]), words);
    assert_eq!(saved.words([30, 20]).len(), 600);
    assert!(is_picture(&file) && !is_picture(&root().join("scenes/room.toml")));
    let wrong = Saved::open(&root().join("scenes/room.toml")).expect_err("no picture");
    assert!(wrong.contains("room.toml"), "{wrong}");
}

#[test]
fn what_is_told_costs_no_bit_of_the_picture() {
    let gpu = gpu();
    let scene = small("pyramid", [61, 47], 4);
    let wish = Wish { method: Method::Raster, scene, side: Side::Gpu, moving: false };
    let screen = Screen::new(&gpu, &Sources::default(), [61, 47]).expect("a screen");
    let mut live = Live::new(&gpu, &Sources::default(), wish, &Reach::default()).expect("a scene");
    let picture = |live: &mut Live<'_>| {
        while !live.done() {
            live.step().expect("work");
        }
        live.show(&screen).expect("a picture");
        screen.read(&gpu).expect("words")
    };
    let plain = picture(&mut live);
    gpu.measure(true);
    live.again().expect("again");
    assert!(!live.done(), "it is made anew");
    assert!(picture(&mut live) == plain);
    gpu.measure(false);
}
