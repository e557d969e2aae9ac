//! What people write on the command line, and where pictures go then.

use std::fs;

use super::cli_batch::{good, run, scene, words};

const SMALL: [&str; 4] = ["--size", "33x21", "--samples", "1"];

#[test]
fn a_word_needs_no_quotes() {
    let folder = tempfile::tempdir().expect("a folder");
    let room = scene("room.toml");
    let render = |name: &str, sets: &[&str]| {
        let sets: Vec<_> = sets.iter().flat_map(|set| ["--set", set]).collect();
        let arguments: Vec<_> = ["render", &room, "-o", name].into_iter().chain(SMALL).chain(sets).collect();
        run(folder.path(), &arguments, &[])
    };
    let sets = ["method=raster", "raster.filter=nearest", "material[0].color=#ff8800", "trace.specular=blinn"];
    good(&render("bare.png", &sets));
    let quoted = sets.map(|set| set.replacen('=', "=\"", 1) + "\"");
    good(&render("quoted.png", &quoted.each_ref().map(String::as_str)));
    let read = |name| fs::read(folder.path().join(name)).expect("a picture");
    assert_eq!(read("bare.png"), read("quoted.png"));
    for (set, why) in
        [("method=draw", "unknown variant `draw`"), ("camera.fov=4o", "--set"), ("film.size=[3 4]", "--set")]
    {
        let output = render("wrong.png", &[set]);
        assert_eq!(output.status.code(), Some(2), "{set}");
        assert!(words(&output).contains(why), "{set}: {}", words(&output));
    }
}

#[test]
fn a_pass_is_named_once() {
    let folder = tempfile::tempdir().expect("a folder");
    let output =
        run(folder.path(), &["render", &scene("room.toml"), "-o", "a.exr", "--passes", "depth,id,depth"], &[]);
    assert_eq!(output.status.code(), Some(2), "{}", words(&output));
    assert!(words(&output).contains("--passes names depth twice"), "{}", words(&output));
    assert!(!folder.path().join("a.exr").exists());
}

#[test]
fn a_folder_that_is_not_there_is_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let room = scene("room.toml");
    let arguments: Vec<_> = ["render", &room, "-o", "gone/a.png"].into_iter().chain(SMALL).collect();
    let output = run(folder.path(), &arguments, &[]);
    assert_eq!(output.status.code(), Some(4), "{}", words(&output));
    assert!(words(&output).contains("there is no folder gone"), "{}", words(&output));
}

#[cfg(unix)]
#[test]
fn a_link_stays_and_a_pipe_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let room = scene("room.toml");
    let at = |name: &str| folder.path().join(name);
    fs::create_dir(at("disk")).expect("a folder");
    fs::write(at("disk/old.png"), "old").expect("a file");
    std::os::unix::fs::symlink("last.png", at("disk/next.png")).expect("a link");
    let links = [
        ("old.png", "disk/old.png", "disk/old.png"),
        ("new.png", "disk/new.png", "disk/new.png"),
        ("far.png", "disk/next.png", "disk/last.png"),
    ];
    for (link, next, target) in links {
        std::os::unix::fs::symlink(next, at(link)).expect("a link");
        let arguments: Vec<_> = ["render", &room, "-o", link].into_iter().chain(SMALL).collect();
        good(&run(folder.path(), &arguments, &[]));
        assert!(at(link).is_symlink(), "{link} leads to {target}");
        assert!(!at(target).is_symlink(), "{target} is no link");
        assert!(image::open(at(target)).is_ok(), "{target} is the picture");
        assert!(words(&run(folder.path(), &arguments, &[])).contains("already"), "it is known again");
    }
    std::os::unix::fs::symlink("ring.png", at("ring.png")).expect("a link");
    let arguments: Vec<_> = ["render", &room, "-o", "ring.png"].into_iter().chain(SMALL).collect();
    let output = run(folder.path(), &arguments, &[]);
    assert_eq!(output.status.code(), Some(4), "{}", words(&output));
    assert!(words(&output).contains("without an end"), "{}", words(&output));
    let made = std::process::Command::new("mkfifo").arg(at("pipe.png")).status().expect("mkfifo");
    assert!(made.success());
    let arguments: Vec<_> = ["render", &room, "-o", "pipe.png"].into_iter().chain(SMALL).collect();
    let output = run(folder.path(), &arguments, &[]);
    assert_eq!(output.status.code(), Some(4), "{}", words(&output));
    assert!(words(&output).contains("a pipe or a device has this name"), "{}", words(&output));
}

#[test]
fn a_model_far_from_zero_and_planes_alone_are_told_what_is_true_of_them() {
    let folder = tempfile::tempdir().expect("a folder");
    let obj = "v 500000 5400000 100\nv 500010 5400000 100\nv 500000 5400010 100\nf 1 2 3\n";
    fs::write(folder.path().join("map.obj"), obj).expect("a file");
    let arguments: Vec<_> = ["render", "map.obj"].into_iter().chain(SMALL).collect();
    let told = words(&run(folder.path(), &arguments, &[]));
    assert!(told.contains("told apart in steps of 0.6"), "{told}");
    let walls = scene("room-diffuse.toml");
    let arguments: Vec<_> = ["render", &walls, "--method", "raster"].into_iter().chain(SMALL).collect();
    let told = words(&run(folder.path(), &arguments, &[]));
    assert!(!told.contains("no shadows"), "there is room for shadow maps: {told}");
}
