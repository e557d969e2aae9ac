//! The binary where a picture has more pixels than there is memory for: it is made in bands, which do not show.

use std::fs;
use std::io::{Seek as _, SeekFrom, Write as _};
use std::ops::{ControlFlow, Range};
use std::path::Path;
use std::process::{Output, Stdio};
use std::time::Duration;

use twinlight::cpu::raster::CpuRaster;
use twinlight::film::ledger::Reader;
use twinlight::film::{Run, Watch};
use twinlight::prepare::draw;
use twinlight::raster;

use super::cli_batch::{command, good, names, run, scene, words};
use super::{root, small};

/// Too little for a film of this size at once.
const LITTLE: [&str; 4] = ["--max-memory", "8M", "--size", "601x403"];

fn render(folder: &Path, name: &str, more: &[&str]) -> Output {
    let usual = ["--samples", "1", "--set", "raster.shadow_size=64"];
    run(folder, &["render", &scene(name)], &[&LITTLE[2..], &usual, more].concat())
}

#[test]
fn bands_do_not_show_in_the_picture() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    for (name, more) in [("room.toml", &[][..]), ("pyramid.toml", &["--method", "raster"])] {
        for (ending, backend) in [("png", "cpu"), ("png", "gpu"), ("tga", "cpu"), ("ppm", "cpu")] {
            let [whole, bands] = ["whole", "bands"].map(|name| format!("{name}.{ending}"));
            good(&render(folder, name, &[more, &["-o", &whole, "--backend", backend]].concat()));
            let made = [more, &["-o", &bands, "--backend", backend, "--json"], &LITTLE[..2]].concat();
            let output = render(folder, name, &made);
            good(&output);
            let bytes = fs::read(folder.join(&bands)).expect("a picture");
            assert!(bytes == fs::read(folder.join(whole)).expect("a picture"), "{name} {ending} {backend}");
            let told: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
            assert_eq!(told["hash"], blake3::hash(&bytes).to_hex().to_string());
            assert_eq!(words(&output).lines().filter(|line| line.contains("601x403 in")).count(), 1);
            assert!(words(&render(folder, name, &made)).contains("is there already"));
            for name in names(folder) {
                fs::remove_file(folder.join(name)).expect("removed");
            }
        }
    }
    // A rectangle of it, and what has no bands.
    let crop = ["--crop", "590x400+7+3", "--max-memory", "8M", "--backend", "cpu"];
    good(&render(folder, "room.toml", &[&crop[..], &["-o", "bands.png"]].concat()));
    good(&render(folder, "room.toml", &[&crop[..2], &crop[4..], &["-o", "whole.png"]].concat()));
    assert!(
        fs::read(folder.join("bands.png")).expect("bands") == fs::read(folder.join("whole.png")).expect("whole")
    );
    let output = render(folder, "room.toml", &["-o", "a.exr", "--max-memory", "4M", "--backend", "cpu"]);
    assert_eq!(output.status.code(), Some(6), "{}", words(&output));
    assert!(words(&output).contains("can be made in bands"), "{}", words(&output));
}

/// Listens to nothing but what is kept.
struct Keeper(Vec<Run>);

impl Watch for Keeper {
    fn done(&mut self, _fraction: f64) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    fn kept(&mut self, first: u32) -> Option<Run> {
        self.0.iter().rev().find(|run| run.pixels.start == first).cloned()
    }

    fn keep(&mut self, run: &Run) {
        self.0.push(run.clone());
    }
}

#[test]
fn a_drawn_band_is_taken_up_as_it_was_kept() {
    let drawing = draw(&small(&root().join("scenes/stones.toml"), [31, 23], 4));
    let made = |rectangle: [Range<u32>; 2], height: u32, keeper: &mut Keeper| {
        let mut bands = Vec::new();
        let Ok(()) =
            raster::bands(&mut CpuRaster::new(&drawing), &drawing, &rectangle, height, keeper, &mut |band| {
                bands.push(band);
                ControlFlow::Continue(())
            });
        bands
    };
    let Ok(whole) = raster::frame(&mut CpuRaster::new(&drawing), &drawing, &mut |_| ());
    let rows = |top: u32, bottom: u32| &whole.sums()[top as usize * 31..bottom as usize * 31];
    let mut keeper = Keeper(Vec::new());
    for height in [7, 5, 22, 100] {
        let bands = made([0..31, 0..23], height, &mut keeper);
        let tops: Vec<_> = (0..23).step_by(height as usize).collect();
        assert_eq!(bands.iter().map(|band| band.top).collect::<Vec<_>>(), tops);
        for band in bands {
            assert!(
                band.film.sums() == rows(band.top, band.top + band.film.height()),
                "{height} from {}",
                band.top
            );
        }
    }
    assert!(keeper.0.iter().all(|run| run.pixels.len() < whole.sums().len()), "of one band alone nothing is kept");
    // What is kept is believed where it fits, and nowhere else.
    keeper.0.retain(|run| run.pixels == (7 * 31..14 * 31));
    keeper.0[0].sums[40] = [1.0, 2.0, 3.0, 4.0];
    let bands = made([0..31, 0..23], 7, &mut keeper);
    assert!(bands[1].film.sums()[40] == [1.0, 2.0, 3.0, 4.0] && bands[2].film.sums() == rows(14, 21));
    keeper.0.truncate(1);
    keeper.0[0].samples = 0..9;
    assert!(made([0..31, 0..23], 7, &mut keeper)[1].film.sums() == rows(7, 14));
    keeper.0[0].pixels = 7 * 31..13 * 31;
    keeper.0.truncate(1);
    assert!(made([0..31, 0..23], 7, &mut keeper)[1].film.sums() == rows(7, 14));
}

#[test]
fn bands_that_were_made_are_not_made_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let more = ["--backend", "cpu", "--max-memory", "8M", "--set", "raster.shadow_size=64"];
    let pyramid = scene("pyramid.toml");
    let usual = [&["render", &pyramid, "--method", "raster", "--size", "1201x803"], &more[..]].concat();
    let kept = folder.join(".a.png.kept");
    let runs = || {
        fs::File::open(&kept).ok().and_then(Reader::new).map_or(0, |mut r| std::iter::from_fn(|| r.run()).count())
    };
    // As many samples as it takes to be killed within a picture.
    let arguments = ["16", "64", "256", "1024"].map(|samples| [&usual[..], &["--samples", samples]].concat());
    let killed = arguments.iter().find(|arguments| {
        let child = command(folder, arguments, &["-o", "a.png", "--again"]).stderr(Stdio::null()).spawn();
        let mut child = child.expect("the binary runs");
        while runs() < 2 && child.try_wait().expect("a child").is_none() {
            std::thread::sleep(Duration::from_millis(20));
        }
        let _ = child.kill();
        let _ = child.wait();
        !folder.join("a.png").exists() || fs::remove_file(folder.join("a.png")).is_err()
    });
    let arguments = killed.expect("it takes seconds");
    assert!(runs() >= 2);
    good(&run(folder, arguments, &["-o", "whole.png"]));
    // What a killed process had begun to write is torn at its end.
    let mut file = fs::OpenOptions::new().write(true).open(&kept).expect("what was kept");
    file.seek(SeekFrom::End(0)).and_then(|_| file.write_all(b"torn")).expect("written");
    good(&run(folder, arguments, &["-o", "a.png"]));
    assert!(fs::read(folder.join("a.png")).expect("a") == fs::read(folder.join("whole.png")).expect("whole"));
    let mut left = names(folder);
    left.retain(|name| !name.starts_with(".twinlight-"));
    assert_eq!(left, ["a.png", "whole.png"]);
}

#[test]
fn a_film_that_does_not_fit_is_made_smaller() {
    let folder = tempfile::tempdir().expect("a folder");
    let large = ["--set", "film.size=[8000, 8000]", "--max-memory", "8M", "--samples", "1", "--backend", "cpu"];
    let ask = |more: &[&str]| {
        run(folder.path(), &["render", &scene("room.toml"), "-o", "a.png"], &[&large, more].concat())
    };
    let refused = ask(&[]);
    assert_eq!(refused.status.code(), Some(6), "{refused:?}");
    let made = ask(&["--size", "31x23"]);
    assert!(made.status.success(), "{made:?}");
}
