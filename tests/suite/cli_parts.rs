//! The binary where one picture is made in parts, killed and taken up again, or comes with passes.

use std::fs;
use std::io::Cursor;
use std::path::Path;
use std::process::Stdio;
use std::time::Duration;

use exr::prelude::{FlatSamples, read_all_flat_layers_from_file};

use super::cli_batch::{command, good, names, run, scene, words};
use super::{Dice, on_cpu, root, scene_on_cpu, small, tables_of};
use twinlight::film::ledger::{Ledger, Reader, Subject, written};
use twinlight::film::merge::{Misfit, merge};
use twinlight::film::{Run, Transfer, stamp_of};

const SIZE: [&str; 2] = ["--size", "37x23"];

fn render(folder: &Path, more: &[&str]) -> String {
    good(&run(folder, &["render", &scene("room.toml")], &[&SIZE, more].concat()))
}

#[test]
fn parts_of_the_samples_make_the_whole() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let of = |more: &[&str]| render(folder, &[&["--samples", "200"], more].concat());
    of(&["-o", "whole.png", "--backend", "cpu"]);
    of(&["--sample-range", "0..128", "-o", "a.part", "--backend", "cpu"]);
    // Three blocks, one of them short, on the other backend.
    of(&["--sample-range", "128..200", "-o", "b.part", "--backend", "gpu"]);
    let merged = |parts: &[&str]| run(folder, &[&["merge", "-o", "merged.png"], parts].concat(), &[]);
    good(&merged(&["b.part", "a.part"]));
    assert_eq!(
        fs::read(folder.join("merged.png")).expect("merged"),
        fs::read(folder.join("whole.png")).expect("whole")
    );
    let told = words(&run(
        folder,
        &["render", &scene("room.toml"), "-o", "merged.png"],
        &[&SIZE[..], &["--samples", "200"]].concat(),
    ));
    assert!(told.contains("is there already"), "it is known as the whole is: {told}");
    fs::remove_file(folder.join("merged.png")).expect("removed");
    of(&["--sample-range", "64..128", "-o", "c.part"]);
    of(&["--sample-range", "128..200", "-o", "d.part", "--set", "camera.fov=50"]);
    let torn = fs::read(folder.join("b.part")).expect("a part");
    fs::write(folder.join("torn.part"), &torn[..torn.len() - 9]).expect("written");
    let mut bent = torn.clone();
    let middle = bent.len() / 2;
    bent[middle] ^= 4;
    fs::write(folder.join("bent.part"), &bent).expect("written");
    fs::write(folder.join("no.part"), "no part").expect("written");
    for (parts, word) in [
        (&["a.part"][..], "samples 128 to 200 are in no part"),
        (&["b.part"], "samples 0 to 128 are in no part"),
        (&["a.part", "b.part", "c.part"], "samples 64 to 128 are in two parts"),
        (&["a.part", "a.part", "b.part"], "samples 0 to 128 are in two parts"),
        (&["a.part", "d.part"], "another picture"),
        (&["a.part", "torn.part"], "damaged"),
        (&["a.part", "bent.part"], "damaged"),
        (&["a.part", "no.part"], "no part of a picture"),
        (&["a.part", "gone.part"], "cannot read"),
        (&["a.part", "/dev/zero"], "not a file"),
    ] {
        let output = merged(parts);
        assert_eq!(output.status.code(), Some(3), "{parts:?}: {}", words(&output));
        assert!(words(&output).contains(word), "{parts:?}: {}", words(&output));
    }
    assert!(!folder.join("merged.png").exists());
    for (arguments, word) in [
        (&["--sample-range", "0..100", "-o", "x.part"][..], "multiples of 64"),
        (&["--sample-range", "0..256", "-o", "x.part"], "multiples of 64"),
        (&["--sample-range", "64..0", "-o", "x.part"], "0..64"),
        (&["--sample-range", "0..64", "-o", "x.png"], "ends in .part"),
        (&["--sample-range", "0..64", "-o", "x.part", "--method", "raster"], "--method trace"),
    ] {
        let output = run(folder, &["render", &scene("room.toml"), "--samples", "200"], arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", words(&output));
        assert!(words(&output).contains(word), "{arguments:?}: {}", words(&output));
    }
}

#[test]
fn killed_at_any_moment_it_goes_on_and_makes_the_same() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    // Seconds of work in runs of a fraction of a second.
    let arguments =
        ["render", &scene("room-diffuse.toml"), "--size", "301x203", "--samples", "320", "--backend", "cpu"];
    good(&run(folder, &arguments, &["-o", "whole.png"]));
    let mut dice = Dice(4, 0);
    let mut kept = 0;
    for number in 0..6 {
        let mut child = command(folder, &arguments, &["-o", "killed.png"]);
        let mut child = child.stderr(Stdio::null()).spawn().expect("the binary runs");
        std::thread::sleep(Duration::from_millis(if number == 0 { 2600 } else { 20 + dice.below(2500) as u64 }));
        let _ = child.kill();
        let _ = child.wait();
        if folder.join("killed.png").exists() {
            break;
        }
        let file = folder.join(".killed.png.kept");
        if let Some(mut reader) = fs::File::open(file).ok().and_then(Reader::new) {
            let runs = std::iter::from_fn(|| reader.run()).count();
            assert!(runs >= kept, "what was kept stays: {runs} of {kept}");
            kept = runs;
        }
    }
    good(&run(folder, &arguments, &["-o", "killed.png"]));
    let [whole, killed] = ["whole.png", "killed.png"].map(|name| fs::read(folder.join(name)).expect("a picture"));
    assert!(whole == killed, "{kept} runs had been kept");
    assert_eq!(names(folder), ["killed.png", "whole.png"], "and nothing else is left");
}

fn subject() -> Subject {
    let transfer = Transfer::None;
    Subject { stamp: "s".to_owned(), width: 5, columns: 1..4, rows: 2..5, samples: 7, transfer, from: 0, to: 7 }
}

fn runs() -> Vec<Run> {
    let run = |first: u32, to: u32| {
        let mut run = Run::new(first..first + 3, 0);
        run.add(to, &[[0.1, f32::NAN, -0.0, to as f32]; 3], &[0.2, f32::INFINITY, to as f32], &[first, 8, 9]);
        run
    };
    vec![run(11, 3), run(16, 7), run(11, 7), run(21, 7)]
}

#[test]
fn a_ledger_gives_back_what_was_put_in_whatever_befell_its_end() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("ledger");
    let open = |subject: &Subject| {
        let file = fs::OpenOptions::new().read(true).append(true).create(true).open(&path).expect("a file");
        Ledger::open(file, subject).expect("a ledger")
    };
    let mut ledger = open(&subject());
    for run in runs() {
        ledger.keep(&run);
        ledger.flush().expect("written");
    }
    let bytes = fs::read(&path).expect("a file");
    assert_eq!(bytes, written(&subject(), &runs()), "it is what is written at once");
    let bits = |run: &Run| run.sums.iter().flatten().map(|part| part.to_bits()).collect::<Vec<_>>();
    for cut in 0..=bytes.len() {
        fs::write(&path, &bytes[..cut]).expect("written");
        let mut ledger = open(&subject());
        let again = ledger.kept(21);
        assert_eq!(again.is_some(), cut == bytes.len(), "cut at {cut}");
        if let Some(found) = ledger.kept(11) {
            let wanted = if found.samples.end == 7 { &runs()[2] } else { &runs()[0] };
            assert_eq!((bits(&found), &found.ids, &found.pixels), (bits(wanted), &wanted.ids, &wanted.pixels));
        }
        // What is put in after a cut can be read too.
        ledger.keep(&runs()[3]);
        ledger.flush().expect("written");
        drop(ledger);
        assert_eq!(open(&subject()).kept(21).map(|run| bits(&run)), Some(bits(&runs()[3])), "cut at {cut}");
    }
    // A planted fault: of another picture, nothing is taken.
    fs::write(&path, &bytes).expect("written");
    assert!(open(&Subject { stamp: "t".to_owned(), ..subject() }).kept(11).is_none());
    assert_eq!(fs::read(&path).expect("a file").len(), 0);
}

#[test]
fn no_bytes_make_the_merge_panic() {
    let complete = [&runs()[1], &runs()[2], &runs()[3]].map(Clone::clone);
    let good = written(&subject(), &complete);
    let put = |bytes: &[u8]| merge(vec![("x".to_owned(), Cursor::new(bytes.to_vec()))]);
    let (told, film) = put(&good).expect("a picture");
    assert_eq!((told, film.width(), film.height(), film.id(3)), (subject(), 3, 3, 16));
    assert_eq!(put(&written(&subject(), &runs())).err(), Some(Misfit::Pixels(0, 3)));
    let mut dice = Dice(9, 0);
    let mut passed = 0;
    for _ in 0..20_000 {
        let mut bytes = good.clone();
        for _ in 0..=dice.below(3) {
            let at = dice.below(bytes.len());
            match dice.below(4) {
                0 => bytes[at] = dice.bits() as u8,
                1 => bytes.truncate(at.max(1)),
                2 => drop(bytes.splice(at..at, good[at.min(good.len())..].to_vec())),
                // Numbers of the first line, where lies would be costly.
                _ => {
                    let at = dice.below(170).min(bytes.len() - 1);
                    bytes[at] = b'0' + dice.below(10) as u8;
                }
            }
        }
        passed += u32::from(put(&bytes).is_ok());
    }
    assert!(passed < 2000, "{passed} of the damaged files were taken for whole");
}

#[test]
fn an_exr_holds_the_films_own_numbers_and_its_passes() {
    let folder = tempfile::tempdir().expect("a folder");
    let passes = ["--passes", "depth,normal,albedo,shadow,id,samples"];
    for (name, sized) in [("pyramid.toml", ["--samples", "4"]), ("bust.toml", ["--samples", "1"])] {
        let call = ["render", &scene(name), "--backend", "cpu", "--set", "raster.shadow_size=256"];
        let more = [&SIZE[..], &sized, &passes].concat();
        good(&run(folder.path(), &call, &[&more[..], &["-o", "a.exr"]].concat()));
        let scene = small(&root().join("scenes").join(name), [37, 23], sized[1].parse().expect("a number"));
        let film = if name == "bust.toml" { scene_on_cpu(&scene) } else { on_cpu(&tables_of(&scene)) };
        let image = read_all_flat_layers_from_file(folder.path().join("a.exr")).expect("an EXR");
        let channels = &image.layer_data[0].channel_data.list;
        let names: Vec<_> = channels.iter().map(|channel| channel.name.to_string()).collect();
        let wanted = [
            "B",
            "G",
            "R",
            "albedo.B",
            "albedo.G",
            "albedo.R",
            "depth.Z",
            "id.Y",
            "normal.X",
            "normal.Y",
            "normal.Z",
            "samples.Y",
            "shadow.Y",
        ];
        assert_eq!(names, wanted);
        let floats = |name: &str| match &channels[names.iter().position(|n| n == name).expect(name)].sample_data {
            FlatSamples::F32(values) => values.clone(),
            other => panic!("{name}: {other:?}"),
        };
        let red: Vec<_> = (0..film.pixels()).map(|pixel| film.color(pixel).x.to_bits()).collect();
        assert_eq!(floats("R").iter().map(|v| v.to_bits()).collect::<Vec<_>>(), red, "{name}: the film's own bits");
        assert!(matches!(&channels[7].sample_data, FlatSamples::U32(ids) if ids == film.ids()), "{name}");
        let (depth, normal) = (floats("depth.Z"), [floats("normal.X"), floats("normal.Y"), floats("normal.Z")]);
        let seen: Vec<usize> = (0..depth.len()).filter(|&i| depth[i].is_finite()).collect();
        assert!(seen.len() > 100, "{name}: {} pixels see something", seen.len());
        for &i in &seen {
            let length = normal.iter().map(|part| part[i] * part[i]).sum::<f32>().sqrt();
            assert!((length - 1.0).abs() < 1e-4, "{name}: a normal of length {length}");
            assert!(depth[i] >= scene.camera.near * 0.99, "{name}: depth {}", depth[i]);
        }
        assert!(floats("shadow.Y").iter().all(|share| (0.0..=1.0001).contains(share)));
        assert!(stamp_of(&folder.path().join("a.exr")).is_some_and(|stamp| stamp.contains("+depth +normal")));
        let told = words(&run(folder.path(), &call, &[&more[..], &["-o", "a.exr"]].concat()));
        assert!(told.contains("is there already"), "{told}");
        good(&run(folder.path(), &call, &[&more[..], &["-o", "b.png"]].concat()));
        for pass in passes[1].split(',') {
            let picture = image::open(folder.path().join(format!("b.{pass}.png"))).expect(pass).to_rgb8();
            let first = picture.get_pixel(0, 0);
            assert!(
                pass == "samples" || picture.pixels().any(|pixel| pixel != first),
                "{name}: {pass} is one color"
            );
        }
    }
}

/// The depth of a ball in the middle of the view is known.
#[test]
fn both_methods_see_one_depth() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = "[camera]\nposition = [0, 0, 5]\nlook_at = [0, 0, 0]\n[film]\nsize = [33, 33]\n[[light.directional]]\n\
        toward = [0, 0, 1]\n[[material]]\nname = \"a\"\n[[object.sphere]]\ncenter = [0, 0, 0]\nradius = 1\nmaterial = \"a\"\n";
    fs::write(folder.path().join("ball.toml"), text).expect("written");
    for method in ["trace", "raster"] {
        let call = ["render", "ball.toml", "--backend", "cpu", "--method", method, "--samples", "1", "-o", "a.exr"];
        good(&run(folder.path(), &call, &["--passes", "depth,normal,shadow", "--again"]));
        let image = read_all_flat_layers_from_file(folder.path().join("a.exr")).expect("an EXR");
        let middle = |name: &str| {
            let channel = image.layer_data[0].channel_data.list.iter().find(|c| c.name.to_string() == name);
            match &channel.expect(name).sample_data {
                FlatSamples::F32(values) => values[16 * 33 + 16],
                other => panic!("{other:?}"),
            }
        };
        assert!((middle("depth.Z") - 4.0).abs() < 0.02, "{method}: {}", middle("depth.Z"));
        assert!(middle("normal.Z") > 0.99, "{method}: {}", middle("normal.Z"));
        assert_eq!(middle("shadow.Y"), 1.0, "{method}");
    }
}
