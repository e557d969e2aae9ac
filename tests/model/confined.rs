//! Names that lead out of the folder, or to what is no file: not opened, and no waiting.

use std::os::unix::fs::symlink;
use std::path::Path;
use std::time::{Duration, Instant};

use twinlight::scene::model::{Confined, Limits, Refusal, read_model};

use crate::pictures::png;
use crate::scratch::{Scratch, warnings};

const SECRET: &str = "newmtl a\nKd 1 0 0\n";

fn scene() -> Scratch {
    let scratch = Scratch::new();
    scratch.file("outside.mtl", SECRET).file("outside2/x.mtl", SECRET).file("in/sub/inside.mtl", SECRET);
    symlink(scratch.0.join("outside.mtl"), scratch.0.join("in/link.mtl")).unwrap();
    symlink(scratch.0.join("outside2"), scratch.0.join("in/linked")).unwrap();
    symlink("sub/inside.mtl", scratch.0.join("in/good.mtl")).unwrap();
    symlink("loop.mtl", scratch.0.join("in/loop.mtl")).unwrap();
    symlink("/dev/zero", scratch.0.join("in/zero.mtl")).unwrap();
    let made = std::process::Command::new("mkfifo").arg(scratch.0.join("in/fifo.mtl")).status().unwrap();
    assert!(made.success());
    std::fs::create_dir(scratch.0.join("in/folder.mtl")).unwrap();
    scratch
}

#[test]
fn escapes() {
    let scratch = scene();
    let absolute = scratch.0.join("outside.mtl").display().to_string();
    let names = [
        absolute.as_str(),
        "../outside.mtl",
        "..\\outside.mtl",
        "sub/../../outside.mtl",
        "sub\\..\\..\\outside.mtl",
        "./../outside.mtl",
        "../in/../outside.mtl",
        "link.mtl",
        "linked/x.mtl",
        "LINK.mtl",
        "Linked/X.mtl",
        "zero.mtl",
        "fifo.mtl",
        "folder.mtl",
        "loop.mtl",
        "/dev/zero",
        "/dev/tty",
        "/dev/stdin",
        "//server/share/a.mtl",
        "\\\\server\\share\\a.mtl",
        "C:\\a.mtl",
        "C:a.mtl",
        "file:///etc/passwd",
        "/proc/self/environ",
        "\0.mtl",
        "a\0../../outside.mtl",
        ".",
        "..",
        "/",
        "",
        "../../../../../../../../etc/passwd",
        "sub/inside.mtl/../../../outside.mtl",
        "/sub/inside.mtl",
        "~/a.mtl",
        "$HOME/a.mtl",
        "|ls",
        "nul",
        "con.mtl",
        "sub//..//..//outside.mtl",
        "..%2foutside.mtl",
        "....//outside.mtl",
    ];
    for name in names {
        let obj = format!("mtllib {name}\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n");
        scratch.file("in/m.obj", obj);
        let start = Instant::now();
        let folder = Confined::new(&scratch.0.join("in")).unwrap();
        let model = read_model(Path::new("m.obj"), &folder, &Limits::default()).unwrap();
        assert!(start.elapsed() < Duration::from_secs(1), "{name}");
        assert_eq!(model.materials[1].diffuse, glam::Vec3::splat(0.8), "{name} was read: {:?}", warnings(&model));
        assert_eq!(model.warnings.len(), 2, "{name}: {:?}", warnings(&model));
    }
    // The same rule for pictures and for the OBJ file itself.
    scratch
        .file("outside.png", png(1, 1, |_, _| [1, 2, 3, 255]))
        .file("in/m.mtl", "newmtl a\nmap_Kd ../outside.png\n");
    scratch.file("in/m.obj", "mtllib m.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n");
    let folder = Confined::new(&scratch.0.join("in")).unwrap();
    let model = read_model(Path::new("m.obj"), &folder, &Limits::default()).unwrap();
    assert_eq!(
        warnings(&model),
        [
            "m.mtl:2: the picture `../outside.png`: the name leads out of the scene's folder; a checkerboard is drawn instead"
        ]
    );
    let obj = |name: &str| read_model(Path::new(name), &folder, &Limits::default()).unwrap_err().to_string();
    assert_eq!(
        obj("../outside.mtl"),
        "../outside.mtl: the name leads out of the scene's folder; wanted a relative name of a file in the scene's folder or below it"
    );
    assert_eq!(obj("no.obj"), "no.obj: there is no such file; wanted the name of a file in the scene's folder");
    assert_eq!(
        obj("fifo.mtl"),
        "fifo.mtl: this is not a regular file; wanted a file, not a folder, device or pipe"
    );
    assert_eq!(obj("sub"), "sub: this is not a regular file; wanted a file, not a folder, device or pipe");
    assert_eq!(
        obj("link.mtl"),
        "link.mtl: the name leads out of the scene's folder; wanted a relative name of a file in the scene's folder or below it"
    );
    assert!(matches!(folder.open(Path::new("/etc/passwd")), Err(Refusal::Outside)));
    assert!(matches!(folder.open(Path::new("../outside.mtl")), Err(Refusal::Outside)));
}

#[test]
fn allowed() {
    let scratch = scene();
    let with = scratch.0.join("in");
    for name in ["sub/inside.mtl", "sub\\inside.mtl", "./sub/../sub/inside.mtl", "good.mtl"] {
        scratch.file(
            "in/m.obj",
            format!("mtllib {name}\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n"),
        );
        let model = read_model(Path::new("m.obj"), &Confined::new(&with).unwrap(), &Limits::default()).unwrap();
        assert_eq!((model.materials[1].diffuse, model.warnings.len()), (glam::Vec3::X, 0), "{name}");
    }
    // Up is fine inside the root; a search path adds a second root.
    scratch
        .file("in/sub/m.obj", "mtllib ../good.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n");
    let model = read_model(Path::new("sub/m.obj"), &Confined::new(&with).unwrap(), &Limits::default()).unwrap();
    assert_eq!(model.warnings.len(), 0);
    scratch.file("in/m.obj", "mtllib x.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n");
    let both = Confined::new(&with).unwrap().and(&scratch.0.join("outside2")).unwrap();
    assert_eq!(read_model(Path::new("m.obj"), &both, &Limits::default()).unwrap().warnings.len(), 0);
    let (folder, name) = Confined::around(&with.join("m.obj")).unwrap();
    assert_eq!(name, Path::new("m.obj"));
    assert!(folder.open(&name).is_ok());
    assert!(matches!(Confined::new(&with.join("none")), Err(Refusal::Missing)));
    assert!(matches!(Confined::new(&with.join("m.obj")), Err(Refusal::Missing)));
}
