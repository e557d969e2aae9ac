//! The binary as a person calls it: pictures, messages and exit codes.

use std::path::Path;
use std::process::{Command, Output};

use super::root;

fn twinlight(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_twinlight"));
    command.current_dir(folder).args(arguments).output().expect("the binary runs")
}

fn words(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn room() -> String {
    root().join("scenes/room.toml").display().to_string()
}

const SMALL: [&str; 4] = ["--size", "61x43", "--samples", "1"];

fn render(folder: &Path, more: &[&str]) -> Output {
    let room = room();
    let arguments: Vec<_> = ["render", &room].into_iter().chain(SMALL).chain(more.iter().copied()).collect();
    twinlight(folder, &arguments)
}

#[test]
fn every_format_holds_the_same_picture() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut pictures = Vec::new();
    for name in ["a.png", "a.tga", "a.ppm", "A.PNG"] {
        let output = render(folder.path(), &["-o", name, "--backend", "cpu"]);
        assert_eq!(output.status.code(), Some(0), "{}", words(&output));
        assert!(output.stdout.is_empty(), "a picture's maker has nothing to say on stdout");
        let path = folder.path().join(name);
        let format = if name.ends_with("ppm") {
            image::ImageFormat::Pnm
        } else {
            image::ImageFormat::from_path(&path).expect("known")
        };
        let picture = image::load_from_memory_with_format(&std::fs::read(path).expect("a file"), format);
        pictures.push(picture.expect("a picture").to_rgb8());
    }
    assert_eq!(pictures[0].dimensions(), (61, 43));
    assert!(pictures.windows(2).all(|two| two[0] == two[1]));
    let output = render(folder.path(), &["--backend", "gpu"]);
    assert_eq!(output.status.code(), Some(0), "{}", words(&output));
    let named = image::open(folder.path().join("room.png")).expect("named after the scene").to_rgb8();
    assert_eq!(named, pictures[0], "both backends draw the same");
    assert!(!words(&output).contains('\u{1b}'), "no progress bar on a pipe: {}", words(&output));
}

#[test]
fn wrong_words_are_told() {
    let folder = tempfile::tempdir().expect("a folder");
    let cases: &[(&[&str], i32, &str)] = &[
        (&["--size", "0x5"], 2, "from 1 to 65536"),
        (&["--size", "wide"], 2, "800x600"),
        (&["--samples", "0"], 2, "from 1 to 65536"),
        (&["--depth", "99"], 2, "from 1 to 32"),
        (&["--method", "guess"], 2, "raster"),
        (&["--backend", "tpu"], 2, "auto"),
        (&["--size", "65536x65536"], 2, "too many pixels"),
        (&["-o", "picture.gif"], 2, ".png, .exr, .tga or .ppm"),
        (&["--adapter", "no such card", "--backend", "gpu"], 5, "no such card"),
    ];
    for (arguments, code, word) in cases {
        let room = room();
        let all: Vec<_> = ["render", &room].into_iter().chain(arguments.iter().copied()).collect();
        let output = twinlight(folder.path(), &all);
        assert_eq!(output.status.code(), Some(*code), "{arguments:?}: {}", words(&output));
        assert!(words(&output).contains(word), "{arguments:?}: {}", words(&output));
    }
    let left: Vec<_> = std::fs::read_dir(folder.path()).expect("the folder").collect();
    assert!(left.is_empty(), "{left:?}");
}

#[test]
fn wrong_scenes_are_told_with_their_place() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("wrong.toml"), "[camera]\nposition = [0, 0, 1]\nlook_at = 7\n")
        .expect("written");
    std::fs::write(folder.path().join("latin.toml"), b"# caf\xe9\n").expect("written");
    for (scene, word) in [
        ("wrong.toml", "wrong.toml:3:11: camera.look_at: found 7"),
        ("latin.toml", "line 1 is not UTF-8"),
        ("none.toml", "none.toml: cannot read"),
        (".", "not a file"),
        ("/dev/zero", "not a file"),
    ] {
        let output = twinlight(folder.path(), &["render", scene, "-o", "a.png"]);
        assert_eq!(output.status.code(), Some(3), "{scene}: {}", words(&output));
        assert!(words(&output).contains(word), "{scene}: {}", words(&output));
    }
}

#[test]
fn a_picture_is_written_whole_or_not_at_all() {
    let folder = tempfile::tempdir().expect("a folder");
    let old = folder.path().join("old.png");
    std::fs::write(&old, "the old picture").expect("written");
    // A full disk: the system cuts every file at 512 bytes.
    let script = format!(
        "trap '' XFSZ; ulimit -f 1; exec {} render {} --size 160x120 --samples 1 --backend cpu -o old.png",
        env!("CARGO_BIN_EXE_twinlight"),
        room()
    );
    let output = Command::new("sh").current_dir(folder.path()).args(["-c", &script]).output().expect("sh");
    assert_eq!(output.status.code(), Some(4), "{}", words(&output));
    assert!(words(&output).contains("old.png: cannot write"), "{}", words(&output));
    assert_eq!(std::fs::read(&old).expect("still there"), b"the old picture");
    // A folder that cannot be written to, and one that is not there.
    for place in ["/proc/a.png", "nowhere/a.png", "old.png/a.png"] {
        let output = render(folder.path(), &["--backend", "cpu", "-o", place]);
        assert_eq!(output.status.code(), Some(4), "{place}: {}", words(&output));
    }
    let left: Vec<_> = std::fs::read_dir(folder.path()).expect("the folder").collect();
    assert_eq!(left.len(), 1, "nothing is left behind: {left:?}");
    let hours = std::time::SystemTime::now() - std::time::Duration::from_hours(2);
    for (name, old) in [(".twinlight-a.part", true), (".twinlight-b.part", false), ("mine.part", true)] {
        let file = std::fs::File::create(folder.path().join(name)).expect("a file");
        if old {
            file.set_modified(hours).expect("a time");
        }
    }
    assert_eq!(render(folder.path(), &["--backend", "cpu", "-o", "old.png"]).status.code(), Some(0));
    let left =
        [".twinlight-a.part", ".twinlight-b.part", "mine.part"].map(|name| folder.path().join(name).exists());
    assert_eq!(left, [false, true, true], "what a process left that was killed is swept away, and nothing else");
    assert!(image::open(&old).is_ok(), "and where there is room the new picture replaces it");
}

#[test]
fn without_an_adapter_the_cpu_renders_and_says_so() {
    let folder = tempfile::tempdir().expect("a folder");
    let room = room();
    let run = |backend: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_twinlight"));
        command.current_dir(folder.path()).args(["render", &room, "--backend", backend]).args(SMALL);
        for name in ["VK_DRIVER_FILES", "VK_ICD_FILENAMES"] {
            command.env(name, folder.path().join("none.json"));
        }
        command.output().expect("the binary runs")
    };
    let output = run("auto");
    assert_eq!(output.status.code(), Some(0), "{}", words(&output));
    let told = words(&output);
    let notes: Vec<_> = told.lines().filter(|line| line.starts_with("note:")).collect();
    assert_eq!(notes, ["note: no GPU and no software Vulkan adapter was found; rendering on the CPU"]);
    assert_eq!(run("gpu").status.code(), Some(5));
}

#[test]
fn compare_and_info_say_what_they_found() {
    let folder = tempfile::tempdir().expect("a folder");
    let room = room();
    let output =
        twinlight(folder.path(), &["compare", &room, "--size", "61x43", "--samples", "4", "--adapter", "llvmpipe"]);
    assert_eq!(output.status.code(), Some(0), "{}", words(&output));
    let table = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(table.contains("standard: Exact") && table.matches("| ok").count() == 2, "{table}");
    let picture = image::open(folder.path().join("room-compare.png")).expect("the picture").to_rgb8();
    assert_eq!(picture.dimensions(), (3 * 61, 43));
    let info = twinlight(folder.path(), &["info"]);
    let text = String::from_utf8_lossy(&info.stdout).into_owned();
    assert!(text.contains("llvmpipe") && text.contains("would use:"), "{text}");
    let schema = twinlight(folder.path(), &["schema"]);
    assert_eq!(schema.stdout, std::fs::read(root().join("scenes/scene.schema.json")).expect("the schema"));
}
