//! The binary as a script calls it: many pictures, data on stdout, signals, deadlines, and processes side by side.

use std::collections::HashSet;
use std::fs;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

use super::root;

const SMALL: [&str; 6] = ["--size", "33x21", "--samples", "1", "--backend", "cpu"];
/// Minutes of work.
const LONG: [&str; 6] = ["--size", "800x600", "--samples", "60000", "--backend", "cpu"];

pub(super) fn scene(name: &str) -> String {
    root().join("scenes").join(name).display().to_string()
}

pub(super) fn command(folder: &Path, arguments: &[&str], more: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_twinlight"));
    command.current_dir(folder).args(arguments).args(more);
    command
}

pub(super) fn run(folder: &Path, arguments: &[&str], more: &[&str]) -> Output {
    command(folder, arguments, more).output().expect("the binary runs")
}

pub(super) fn words(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

pub(super) fn good(output: &Output) -> String {
    assert_eq!(output.status.code(), Some(0), "{}", words(output));
    String::from_utf8(output.stdout.clone()).expect("text")
}

pub(super) fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("the folder");
    let mut names: Vec<_> =
        entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

fn lines(output: &Output) -> Vec<serde_json::Value> {
    let text = good(output);
    text.lines().map(|line| serde_json::from_str(line).unwrap_or_else(|e| panic!("{line}: {e}"))).collect()
}

/// The room with a light that moves.
fn moving(folder: &Path, frames: u32) -> String {
    let text = fs::read_to_string(scene("room.toml")).expect("the room");
    let path = folder.join("moving.toml");
    let animation = format!(
        "\n[animation]\nframes = {frames}\n[[animation.orbit]]\ntarget = \"camera.position\"\n\
        around = [5, 0, 0]\n"
    );
    fs::write(&path, text + &animation).expect("written");
    path.display().to_string()
}

#[test]
fn frames_get_names_of_their_own_and_are_made_once() {
    let folder = tempfile::tempdir().expect("a folder");
    let scenes = tempfile::tempdir().expect("a folder");
    let moving = moving(scenes.path(), 12);
    let render = |more: &[&str]| {
        let all: Vec<_> = SMALL.iter().chain(more).copied().collect();
        run(folder.path(), &["render", &moving, "--json"], &all)
    };
    let told = lines(&render(&["--frames", "1-9:4,2"]));
    assert_eq!(names(folder.path()), ["moving-0001.png", "moving-0002.png", "moving-0005.png", "moving-0009.png"]);
    let hashes: HashSet<_> = told.iter().map(|line| line["hash"].to_string()).collect();
    assert_eq!(hashes.len(), 4, "four frames, four pictures: {told:?}");
    for line in &told {
        let bytes = fs::read(folder.path().join(line["file"].as_str().expect("a name"))).expect("a picture");
        assert_eq!(line["hash"], blake3::hash(&bytes).to_hex().as_str());
        assert_eq!((&line["size"], &line["method"]), (&serde_json::json!([33, 21]), &"trace".into()));
        assert!(line["seconds"].as_f64().is_some_and(|s| s > 0.0) && line["backend"] == "CPU", "{line}");
    }
    let made = |told: &[serde_json::Value]| told.iter().filter(|line| line["made"] == true).count();
    let again = lines(&render(&["--frames", "1-6"]));
    assert_eq!((again.len(), made(&again)), (6, 3), "those that are there are left as they are: {again:?}");
    assert_eq!(made(&lines(&render(&["--frames", "1-6", "--again"]))), 6);
    assert_eq!(made(&lines(&render(&["--frames", "1-6", "--set", "camera.fov=41"]))), 6, "another camera");
    // A planted fault: a picture that was cut short is not taken for one that is there.
    let torn = folder.path().join("moving-0003.png");
    let bytes = fs::read(&torn).expect("a picture");
    fs::write(&torn, &bytes[..40]).expect("written");
    let mended = lines(&render(&["--frames", "1-6", "--set", "camera.fov=41"]));
    assert_eq!(made(&mended), 1, "{mended:?}");
    assert_eq!(fs::read(&torn).expect("a picture"), bytes);
    assert_eq!(names(folder.path()).len(), 7, "no claim is left: {:?}", names(folder.path()));
}

#[test]
fn several_frames_in_one_png_move() {
    let folder = tempfile::tempdir().expect("a folder");
    let moving = moving(folder.path(), 3);
    good(&run(folder.path(), &["render", &moving, "-o", "all.png"], &SMALL));
    good(&run(folder.path(), &["render", &moving, "-o", "f##.png"], &SMALL));
    let file = std::io::BufReader::new(fs::File::open(folder.path().join("all.png")).expect("a file"));
    let mut reader = png::Decoder::new(file).read_info().expect("a PNG");
    assert_eq!(reader.info().animation_control().map(|c| (c.num_frames, c.num_plays)), Some((3, 0)));
    let told = |frames: &str| {
        let arguments = ["render", moving.as_str(), "-o", "g##.png", "--dry-run", "--frames", frames];
        words(&run(folder.path(), &arguments, &SMALL))
    };
    let beyond =
        "moving.toml: frame 0 and 1 others are outside of its 1 to 3: keys stand still there, orbits go on";
    assert!(told("0-4").contains(beyond), "{}", told("0-4"));
    assert_eq!(told("1-3"), "");
    for number in 1..=3 {
        let mut bytes = vec![0; reader.output_buffer_size().expect("a size")];
        reader.next_frame(&mut bytes).expect("a frame");
        let delay = reader.info().frame_control().map(|c| f64::from(c.delay_num) / f64::from(c.delay_den));
        assert!(delay.is_some_and(|delay| (delay - 1.0 / 24.0).abs() < 1e-4), "{delay:?}");
        let single = image::open(folder.path().join(format!("f{number:02}.png"))).expect("a picture").to_rgb8();
        assert!(single.as_raw() == &bytes, "frame {number}");
    }
    let told = words(&run(folder.path(), &["render", &moving, "-o", "all.png"], &SMALL));
    assert!(told.contains("all.png: is there already"), "{told}");
}

#[test]
fn stdout_is_for_data() {
    let folder = tempfile::tempdir().expect("a folder");
    let room = scene("room.toml");
    good(&run(folder.path(), &["render", &room, "-o", "a.png"], &SMALL));
    let output = run(folder.path(), &["render", &room, "-o", "-", "--progress", "json"], &SMALL);
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(output.stdout, fs::read(folder.path().join("a.png")).expect("a picture"));
    let progress: Vec<serde_json::Value> =
        words(&output).lines().filter_map(|line| serde_json::from_str(line).ok()).collect();
    assert_eq!(progress.last().map(|line| line["done"].clone()), Some(1.0.into()), "{progress:?}");
    let crop = ["--crop", "7x5+20+11", "-o", "-"];
    let output = run(folder.path(), &[&["render", room.as_str()], &crop[..]].concat(), &SMALL);
    let part = image::load_from_memory(&output.stdout).expect("a picture").to_rgb8();
    let whole = image::open(folder.path().join("a.png")).expect("a picture").to_rgb8();
    assert_eq!(part.dimensions(), (7, 5));
    assert!(part.enumerate_pixels().all(|(x, y, pixel)| pixel == whole.get_pixel(x + 20, y + 11)));
    let bust = [SMALL.as_slice(), &["--method", "raster", "--crop", "9x8+12+6", "-o", "b.png"]].concat();
    good(&run(folder.path(), &["render", &scene("bust.toml")], &bust));
    let dry = lines(&run(folder.path(), &["render", &room, "-o", "a.png", "--dry-run", "--json"], &SMALL));
    assert_eq!((dry.len(), &dry[0]["there"]), (1, &true.into()), "{dry:?}");
    good(&run(folder.path(), &["render", &room, "-o", "none.png", "--dry-run"], &SMALL));
    assert_eq!(names(folder.path()), ["a.png", "b.png"]);
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        assert!(good(&run(folder.path(), &["completions", shell], &[])).contains("twinlight"), "{shell}");
    }
}

#[test]
fn wrong_calls_make_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let scenes = tempfile::tempdir().expect("a folder");
    let (room, pyramid) = (scene("room.toml"), scene("pyramid.toml"));
    let moving = moving(scenes.path(), 4);
    let cases: &[(&[&str], i32, &str)] = &[
        (&[&room, "-o", "-", "--json"], 2, "stdout is for"),
        (&[&room, &pyramid, "-o", "a.png"], 2, "would be written there"),
        (&[&room, &room], 2, "would be written there"),
        (&[&moving, "-o", "-"], 2, "one picture alone"),
        (&[&moving, "-o", "a.tga"], 2, "need {frame:4}"),
        (&[&moving, "-o", "{shot}.png"], 2, "there is no {shot}"),
        (&[&moving, "--frames", "9-1"], 2, "not before the first"),
        (&[&room, "--crop", "10x10"], 2, "320x200+64+32"),
        (&[&room, "--crop", "10x10+30+0"], 2, "33x21 pixels"),
        (&[&room, "--set", "camera.fov=400"], 2, "--set:1:12"),
        (&[&room, "--max-memory", "10k", "--size", "800x600"], 6, "MiB of memory may be taken"),
        (&[&room, "--max-memory", "x"], 2, "512M"),
        (&[&room, "--deadline", "soon"], 2, "1.5h"),
        (&[&room, "--deadline", "0"], 7, "deadline"),
        (&[&room, "none.toml"], 3, "none.toml: cannot read"),
    ];
    for (arguments, code, word) in cases {
        let sized: &[&str] = if arguments.contains(&"--size") { &[] } else { &SMALL };
        let output = run(folder.path(), &[&["render"], *arguments].concat(), sized);
        assert_eq!(output.status.code(), Some(*code), "{arguments:?}: {}", words(&output));
        assert!(words(&output).contains(word), "{arguments:?}: {}", words(&output));
        let expected: &[&str] = if arguments.contains(&"none.toml") { &["room.png"] } else { &[] };
        assert_eq!(names(folder.path()), expected, "{arguments:?}: one wrong scene leaves the others");
    }
}

#[test]
fn check_reads_every_frame() {
    let folder = tempfile::tempdir().expect("a folder");
    let told = good(&run(folder.path(), &["check", &scene("room.toml"), &scene("turntable.toml")], &[]));
    assert!(told.contains("room.toml: ok, 800x600, 2 spheres"), "{told}");
    assert!(told.contains("triangles, 2 lights, 100 frames"), "{told}");
    let track = "[[animation.track]]\ntarget = \"camera.fov\"\nkeys = [[1, 40], [4, 250]]\n";
    let text = fs::read_to_string(moving(folder.path(), 4)).expect("a scene") + track;
    fs::write(folder.path().join("late.toml"), text).expect("written");
    let output = run(folder.path(), &["check", "late.toml", &scene("room.toml")], &[]);
    assert_eq!(output.status.code(), Some(3));
    assert!(words(&output).contains("(in frame 3)"), "{}", words(&output));
    assert!(String::from_utf8_lossy(&output.stdout).contains("room.toml: ok"), "the others are checked too");
}

fn start(folder: &Path, arguments: &[&str], more: &[&str]) -> Child {
    let mut command = command(folder, arguments, more);
    command.stderr(Stdio::null()).stdout(Stdio::null()).spawn().expect("the binary runs")
}

fn signal(child: &Child, name: &str) {
    let sent = Command::new("kill").args([name, &child.id().to_string()]).status().expect("kill");
    assert!(sent.success());
}

/// The exit code, within so many seconds.
fn ends(child: &mut Child, seconds: u64) -> Option<i32> {
    let end = Instant::now() + Duration::from_secs(seconds);
    loop {
        if let Some(status) = child.try_wait().expect("a child") {
            return status.code();
        }
        if Instant::now() > end {
            let _ = child.kill();
            panic!("it does not end");
        }
        std::thread::sleep(Duration::from_millis(20));
    }
}

#[cfg(unix)]
#[test]
fn signals_and_deadlines_end_the_work_and_leave_nothing_torn() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("room.png"), "the old picture").expect("written");
    let room = scene("room.toml");
    for (name, code) in [("-INT", 130), ("-TERM", 143)] {
        let mut child = start(folder.path(), &["render", &room], &LONG);
        std::thread::sleep(Duration::from_millis(700));
        signal(&child, name);
        assert_eq!(ends(&mut child, 20), Some(code), "{name}");
    }
    // The second signal does not wait for the slice.
    let mut child = start(folder.path(), &["render", &room], &LONG);
    std::thread::sleep(Duration::from_millis(700));
    signal(&child, "-INT");
    signal(&child, "-TERM");
    assert!(matches!(ends(&mut child, 20), Some(130 | 143)));
    let mut child = start(folder.path(), &["render", &room, "--deadline", "0.5s"], &LONG);
    assert_eq!(ends(&mut child, 20), Some(7));
    assert_eq!(fs::read(folder.path().join("room.png")).expect("a file"), b"the old picture");
}

#[test]
fn processes_side_by_side_make_each_frame_once() {
    let folder = tempfile::tempdir().expect("a folder");
    let scenes = tempfile::tempdir().expect("a folder");
    let moving = moving(scenes.path(), 24);
    let children: Vec<_> = (0..6)
        .map(|_| {
            let mut command = command(folder.path(), &["render", &moving, "--json"], &SMALL);
            command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the binary runs")
        })
        .collect();
    // One of them is killed; what it had claimed is made by the others.
    let mut made: Vec<String> = Vec::new();
    for (number, mut child) in children.into_iter().enumerate() {
        if number == 0 {
            let _ = child.kill();
            let _ = child.wait();
            continue;
        }
        let told = lines(&child.wait_with_output().expect("a child"));
        assert_eq!(told.len(), 24, "each ends when all is there");
        let own = told.iter().filter(|line| line["made"] == true);
        made.extend(own.map(|line| line["file"].to_string()));
    }
    let once: HashSet<_> = made.iter().collect();
    assert_eq!(once.len(), made.len(), "none is made twice: {made:?}");
    let pictures: Vec<_> = names(folder.path()).into_iter().filter(|name| !name.starts_with('.')).collect();
    assert_eq!(pictures.len(), 24, "{pictures:?}");
    let alone = tempfile::tempdir().expect("a folder");
    good(&run(alone.path(), &["render", &moving], &SMALL));
    for name in pictures {
        let [a, b] = [folder.path(), alone.path()].map(|folder| fs::read(folder.join(&name)).expect("a picture"));
        assert!(a == b, "{name} is what one process makes");
    }
}
