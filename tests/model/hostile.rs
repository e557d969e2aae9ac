//! OBJ texts that must not be drawn, and the sentence that says why: file, line, what, what instead.

use std::time::{Duration, Instant};

use twinlight::scene::model::{Error, Limits};

use crate::scratch::{Scratch, check_promises, read};

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

#[test]
fn sentences() {
    let whole = "wanted `v`, `v/vt`, `v//vn` or `v/vt/vn` in whole numbers";
    let three = "wanted an index into `v` from 1 to 3 or from -3 to -1, since 3 stand above this line";
    let cases = [
        ("f 1 2 4", format!("m.obj:4: found the corner `4`; {three}")),
        ("f 1 2 0", format!("m.obj:4: found the corner `0`; {three}")),
        ("f 1 2 -4", format!("m.obj:4: found the corner `-4`; {three}")),
        ("f 1 2 -0", format!("m.obj:4: found the corner `-0`; {three}")),
        ("f 1 2 4294967297", format!("m.obj:4: found the corner `4294967297`; {three}")),
        ("f 1 2 99999999999999999999999", format!("m.obj:4: found the corner `99999999999999999999999`; {three}")),
        ("f 1 2 1.5", format!("m.obj:4: found the corner `1.5`; {whole}")),
        ("f 1 2 x", format!("m.obj:4: found the corner `x`; {whole}")),
        ("f 1 2 -", format!("m.obj:4: found the corner `-`; {whole}")),
        ("f 1 2 /3", format!("m.obj:4: found the corner `/3`; {whole}")),
        ("f 1 2 3/1", "m.obj:4: found the corner `3/1`; wanted no index into `vt`, since no `vt` stands above this line".into()),
        ("f 1//1 2 3", "m.obj:4: found the corner `1//1`; wanted no index into `vn`, since no `vn` stands above this line".into()),
        (
            "vn 0 0 1\nf 1//-6148914691236517207 2//1 3//1",
            "m.obj:5: found the corner `1//-6148914691236517207`; \
             wanted an index into `vn` from 1 to 1 or from -1 to -1, since 1 stand above this line".into(),
        ),
        ("f 1 2 3////", "m.obj:4: found the corner `3////`; wanted `v`, `v/vt`, `v//vn` or `v/vt/vn`".into()),
        ("v 1 2", "m.obj:4: found only 2 of the numbers of a vertex; wanted `v x y z`".into()),
        ("v", "m.obj:4: found only 0 of the numbers of a vertex; wanted `v x y z`".into()),
        ("vt", "m.obj:4: found only 0 of the numbers of a vertex; wanted `vt u v`".into()),
        ("v 1 2 x", "m.obj:4: found `x` where a number should be; wanted `v x y z`, like 0.5 or -1e-3".into()),
        ("v 0,5 0 0", "m.obj:4: found `0,5` where a number should be; wanted `v x y z`, like 0.5 or -1e-3".into()),
        ("v 1 2 \u{1b}[31mred", "m.obj:4: found `` where".into()),
        ("", "m.obj: found 3 vertices and no triangle to draw; wanted at least one `f` line with three corners in different places".into()),
        ("f 1 1 1", "m.obj: found 3 vertices and no triangle".into()),
        ("l 1 2 3", "m.obj: found 3 vertices and no triangle to draw; m.obj:4: points and lines (`p`, `l`) are not drawn; wanted".into()),
    ];
    for (line, sentence) in cases {
        let error = read(format!("{TRIANGLE}{line}\n")).unwrap_err().to_string();
        if line.contains('\u{1b}') {
            assert!(error.contains("[31mred") && !error.contains('\u{1b}'), "{error}");
        } else {
            assert!(error.starts_with(&sentence), "{line}: {error}");
        }
    }
    for empty in ["", "\n\n", "# nothing\n", "\0\0\0\0", "mtllib /dev/zero\n"] {
        let error = read(empty).unwrap_err();
        assert!(matches!(error, Error::Empty { .. }), "{empty:?}: {error}");
    }
    assert_eq!(
        read(b"\xFF\xFEv\0").unwrap_err().to_string(),
        "m.obj:1: found UTF-16 text; wanted the file saved as UTF-8 or ASCII"
    );
}

/// Each limit is held, and stands in the sentence.
#[test]
fn limits() {
    let quad = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\no a\nusemtl b\nf 1 2 3 4\n";
    let all = Limits::default;
    let cases = [
        (Limits { obj_bytes: 20, ..all() }, "m.obj:0: too many bytes in this file; at most 20 are taken"),
        (Limits { line_bytes: 8, ..all() }, "m.obj:7: too many bytes in one line; at most 8 are taken"),
        (Limits { vertices: 3, ..all() }, "m.obj:4: too many vertices (`v`); at most 3 are taken"),
        (Limits { triangles: 1, ..all() }, "m.obj:7: too many triangles; at most 1 are taken"),
        (Limits { names: 1, ..all() }, "m.obj:5: too many names of groups or materials; at most 1 are taken"),
        (
            Limits { memory: 500, ..all() },
            "m.obj:1: too many bytes of memory for this model; at most 500 are taken",
        ),
    ];
    for (limits, sentence) in cases {
        let error = Scratch::new().file("m.obj", quad).read_within("m.obj", &limits).unwrap_err();
        assert_eq!(error.to_string(), sentence);
    }
    let just = Limits { obj_bytes: quad.len() as u64, line_bytes: 9, vertices: 4, triangles: 2, names: 2, ..all() };
    Scratch::new().file("m.obj", quad).read_within("m.obj", &just).unwrap();
}

/// Texts made to take long or to fill memory: an answer within two seconds, in a debug build too.
#[test]
fn texts_that_would_hang() {
    let many = |line: &str, count: usize| format!("{TRIANGLE}{}f 1 2 3\n", line.repeat(count));
    let star: String = (0..60_000).map(|at| format!("v {} {} 0\n", at % 997, (at * 7919) % 1009)).collect();
    let star = format!("{star}f {}\n", (1..=60_000).map(|at| format!("{at} ")).collect::<String>());
    let hub: String = (0..60_000).map(|at| format!("v {} 1 {}\nf 1 -2 -1\n", at, at * 37 % 9973)).collect();
    let cases = [
        ("a line of 1.5 MB", format!("{TRIANGLE}f {}\n", "1 ".repeat(750_000))),
        ("no end of line", "v ".repeat(800_000)),
        ("a line of blanks and joints", format!("{TRIANGLE}{}f 1 2 3\n", "\\\n".repeat(500_000))),
        ("spaces and joints", format!("{TRIANGLE}{}f 1 2 3\n", "   \\\n".repeat(200_000))),
        ("many unknown statements", many("x\n", 300_000)),
        (
            "many different unknown statements",
            (0..100_000).map(|at| format!("x{at}\n")).collect::<String>() + TRIANGLE + "f 1 2 3\n",
        ),
        ("many mtllib lines", many("mtllib a.mtl\n", 100_000)),
        ("many names in one mtllib line", format!("mtllib {}\n{TRIANGLE}f 1 2 3\n", "a.mtl ".repeat(150_000))),
        ("many groups", (0..100_000).map(|at| format!("g {at}\n")).collect::<String>() + TRIANGLE + "f 1 2 3\n"),
        ("a polygon that crosses itself 60,000 times", star),
        ("a polygon of one corner", format!("{TRIANGLE}f {}2 3\n", "1 ".repeat(400_000))),
        ("60,000 triangles around one vertex", format!("v 0 0 0\nv 0 0 0\nv 0 1 0\n{hub}")),
        ("60,000 flat ones around one vertex", format!("v 0 0 0\nv 0 0 0\nv 0 1 0\ns off\n{hub}")),
    ];
    for (name, text) in cases {
        let start = Instant::now();
        let result = read(&text);
        let took = start.elapsed();
        assert!(took < Duration::from_secs(4), "{name}: {took:?}");
        if let Err(error) = result {
            assert!(error.to_string().len() < 300, "{name}: {error}");
        }
    }
}

/// Nothing that a terminal would obey gets into a message.
#[test]
fn messages_are_harmless() {
    let model = read(format!("{TRIANGLE}usemtl a\u{1b}[31m\nmtllib \u{1b}]0;x\u{7}.mtl\nf 1 2 3\n")).unwrap();
    assert_eq!(model.warnings.len(), 2);
    assert!(model.warnings.iter().all(|warning| !warning.text.contains(char::is_control)), "{:?}", model.warnings);
    let many = read(format!("mtllib {}\n{TRIANGLE}f 1 2 3\n", "a.mtl ".repeat(1000))).unwrap();
    assert_eq!(many.warnings[1].text, "only the first 64 names of this line are used");
}

/// Numbers at the ends of what a float holds.
#[test]
fn extreme_numbers() {
    for number in ["1e38", "-3.4e38", "1e-45", "1e-30", "-0", "00000000000000000000001", "1e-999999999"] {
        let text = format!("v {number} 0 0\nv 0 {number} 0\nv 0 0 {number}\nv 1 1 1\nv 3 -1 2\nf 1 2 3 4 5\n");
        if let Ok(model) = read(text) {
            check_promises(&model);
        }
    }
}
