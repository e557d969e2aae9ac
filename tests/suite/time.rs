//! Films that grow sample by sample, for as long as there is time, and how far their samples lie apart.

use std::cell::Cell;
use std::ops::ControlFlow;
use std::time::Duration;

use twinlight::cpu::trace::CpuTrace;
use twinlight::film::compare::{Standard, compare};
use twinlight::film::{Film, Run, Watch};
use twinlight::gpu::wgsl::Sources;
use twinlight::gpu::{GpuTrace, Wanted};
use twinlight::math::Vec3;
use twinlight::math::vector::luminance;
use twinlight::render::{Backend, Error, Good, Renderer, Work};
use twinlight::scene::Method;
use twinlight::tables::{Slice, Tables};
use twinlight::trace::{BLOCK, Part, Trace, Until, frame, passes};

use super::cli_batch::{good, run, scene, words};
use super::{Sliced, gpu, on_cpu, root, small, tables_of};

fn tables(scene: &str, samples: u32) -> Tables {
    let mut tables = tables_of(&small(&root().join(format!("scenes/{scene}.toml")), [23, 11], samples));
    tables.view.grid = 0;
    tables
}

/// A film of so many passes.
fn grown<T: Trace>(stages: &mut T, tables: &Tables, part: &Part, samples: u32) -> Film {
    let part = Part { samples: 0..samples, ..part.clone() };
    let film = passes(stages, tables, &part, &mut |_: f64| (), &Until { spent: &|| 0.0, noise: None });
    film.ok().flatten().unwrap_or_else(|| panic!("no film"))
}

#[test]
fn frames_of_one_sample_are_one_frame_of_all() {
    let gpu = gpu();
    for (scene, few) in [("room-diffuse", true), ("room", false), ("bust", false)] {
        // More than a block, and a broken one.
        for samples in [1, 5, BLOCK + 3] {
            let mut tables = tables(scene, samples);
            tables.few &= few;
            let whole = on_cpu(&tables);
            let part = Part::whole(&tables);
            let film = grown(&mut CpuTrace::new(&tables), &tables, &part, samples);
            assert!(film == whole, "{scene}, {samples} samples on the CPU");
            let mut odd = Sliced { stages: CpuTrace::new(&tables), budget: 40, pixels: 37, rounds: 2 };
            if samples < 9 {
                assert!(grown(&mut odd, &tables, &part, samples) == whole, "{scene}, in portions");
            }
            let mut stages = GpuTrace::new(&gpu, &Sources::default(), &tables).expect("kernels");
            let film = grown(&mut stages, &tables, &part, samples);
            assert!(film == whole, "{scene}, {samples} samples on the GPU");
            let whole_there = frame(&mut stages, &tables, &mut |_: f64| ()).expect("a film");
            assert!(whole_there == whole, "{scene}, all at once on the GPU");
        }
    }
}

#[test]
fn rectangles_grow_as_the_whole_does() {
    let tables = tables("room", 3);
    let whole = on_cpu(&tables);
    let corner = Part { columns: 5..9, rows: 3..10, samples: 0..3 };
    let film = grown(&mut CpuTrace::new(&tables), &tables, &corner, 3);
    let wanted = (3..10).flat_map(|y| (5..9).map(move |x| y * 23 + x));
    assert!(wanted.zip(0..).all(|(from, to)| whole.sums()[from] == film.sums()[to]), "a rectangle of it");
}

#[test]
fn a_film_stops_after_the_pass_in_which_its_time_is_used() {
    let tables = tables("room", 1000);
    for most in [1, 7, BLOCK + 1] {
        // The clock moves on with each pass that is begun.
        let clock = Cell::new(0.0);
        let mut watch = |done: f64| {
            assert!((0.0..=1.0).contains(&done));
            clock.set(clock.get() + 1.0);
        };
        let spent = || clock.get() / f64::from(most);
        let Ok(Some(film)) = passes(
            &mut CpuTrace::new(&tables),
            &tables,
            &Part::whole(&tables),
            &mut watch,
            &Until { spent: &spent, noise: None },
        ) else {
            panic!("no film")
        };
        let counts: Vec<f32> = (0..film.pixels()).map(|pixel| film.samples(pixel)).collect();
        assert!(counts.iter().all(|&count| count == counts[0]), "every pixel has as many");
        assert!(counts[0] >= 1.0 && counts[0] <= most as f32, "{} of {most}", counts[0]);
        let mut shorter = tables.clone();
        shorter.samples = counts[0] as u32;
        assert!(on_cpu(&shorter) == film, "the film of so many samples");
    }
}

/// Stops as soon as it is told anything.
struct Stops(Vec<f64>);

impl Watch for Stops {
    fn done(&mut self, fraction: f64) -> ControlFlow<()> {
        self.0.push(fraction);
        ControlFlow::Break(())
    }
}

#[test]
fn a_stop_after_the_time_is_used_is_no_film() {
    let scene = small(&root().join("scenes/room.toml"), [23, 11], 1000);
    let mut renderer = Renderer::open(Backend::Cpu, &Wanted::Software).expect("a CPU");
    let good = Good { time: Some(Duration::ZERO), noise: None };
    let work = Work::new(&scene, Method::Trace).and_then(|work| work.until(good)).expect("a traced picture");
    let mut stops = Stops(Vec::new());
    let made = renderer.make(&work, &mut stops);
    assert!(matches!(made, Err(Error::Stopped)), "a film of no samples: {made:?}");
    assert!(stops.0.iter().all(|&fraction| fraction < 1.0), "{:?}", stops.0);
    let whole = renderer.make(&work, &mut |_: f64| ()).expect("one sample of each pixel");
    assert_eq!(whole.film.samples(0), 1.0);
}

/// Each sample of a pixel on its own.
fn samples_of(tables: &Tables) -> Vec<Film> {
    let all = (0..tables.samples).map(|sample| {
        let mut stages = CpuTrace::new(tables);
        let pixels = tables.view.width * tables.view.height;
        let Ok(mut paths) = stages.begin(&Run::new(0..pixels, sample), sample + 1);
        let slice = Slice { first: 0, count: pixels, samples: sample + 1, budget: u32::MAX };
        let Ok(()) = stages.cast(&mut paths, &slice);
        let Ok(()) = stages.follow(&mut paths, &slice);
        let Ok(()) = stages.gather(&mut paths, &slice);
        let mut film = Film::new(tables.view.width, tables.view.height);
        film.put(0, &paths.sums, &paths.ids);
        film
    });
    all.collect()
}

#[test]
fn variance_is_that_of_the_samples() {
    let tables = tables("room-diffuse", BLOCK + 9);
    let film = on_cpu(&tables);
    let samples = samples_of(&tables);
    let mut apart = 0;
    for pixel in 0..film.pixels() {
        let lights: Vec<f64> = samples
            .iter()
            .map(|film| f64::from(luminance(Vec3::from_array(film.color(pixel).to_array()))))
            .collect();
        let n = lights.len() as f64;
        let mean = lights.iter().sum::<f64>() / n;
        let wanted = lights.iter().map(|light| (light - mean).powi(2)).sum::<f64>() / (n - 1.0);
        let got = f64::from(film.variance(pixel).expect("a variance"));
        assert!((got - wanted).abs() <= 1e-3 * wanted + 1e-5 * mean * mean, "{got} for {wanted} at {pixel}");
        apart += u32::from(wanted > 1e-4);
    }
    assert!(apart * 2 > film.pixels(), "{apart} pixels have samples that differ");
}

#[test]
fn a_fault_in_what_is_squared_is_seen() {
    let tables = tables("room", 3);
    let whole = on_cpu(&tables);
    let gpu = gpu();
    for file in ["trace/gather", "trace/few"] {
        let text =
            Sources::default().get(file).expect("the file").replace("light * light", "light * abs(light) * 1.001");
        let mut tables = tables.clone();
        tables.few = file == "trace/few";
        let mut stages = GpuTrace::new(&gpu, &Sources::default().with(file, text), &tables).expect("kernels");
        let film = frame(&mut stages, &tables, &mut |_: f64| ()).expect("a film");
        assert!(compare(&whole, &film, Standard::Exact).expect("one size").passes(), "the colors are the same");
        assert!(film != whole, "{file}: nobody sees it");
    }
}

#[test]
fn the_command_makes_as_many_samples_as_there_is_time_for() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let render = |name: &str, more: &[&str]| {
        run(folder, &["render", &scene(name), "--size", "23x11", "--backend", "cpu"], more)
    };
    let arguments = ["--time", "0.2s", "--json", "-o", "a.exr", "--passes", "variance,samples"];
    let told: serde_json::Value =
        serde_json::from_str(&good(&render("room-diffuse.toml", &arguments))).expect("JSON");
    let samples = told["samples"].as_f64().expect("a number");
    assert!(samples > 16.0 && samples < 65_536.0, "{samples} samples in 0.2 s");
    let again = render("room-diffuse.toml", &arguments);
    assert!(words(&again).contains("is there already"), "{}", words(&again));
    let most = render("room-diffuse.toml", &["--time", "1h", "--samples", "3", "-o", "b.png"]);
    assert!(words(&most).contains(", 3 samples a pixel"), "{}", words(&most));
    for more in [
        &["--time", "1s", "-o", "c.png"][..],
        &["--noise", "0.1", "-o", "c.png"],
        &["--passes", "variance", "-o", "c.exr"],
    ] {
        let drawn = render("bust.toml", more);
        assert_eq!(drawn.status.code(), Some(2), "{}", words(&drawn));
        assert!(words(&drawn).contains("--method trace makes them so"), "{}", words(&drawn));
    }
}

#[test]
fn tiles_end_when_their_error_is_low_enough() {
    let mut tables = tables_of(&small(&root().join("scenes/room-diffuse.toml"), [48, 40], 2048));
    tables.view.grid = 0;
    let noise = 0.012;
    let until = Until { spent: &|| 0.0, noise: Some(noise) };
    let part = Part::whole(&tables);
    let Ok(Some(film)) = passes(&mut CpuTrace::new(&tables), &tables, &part, &mut |_: f64| (), &until) else {
        panic!("no film")
    };
    let gpu = gpu();
    for few in [true, false] {
        let tables = Tables { few, ..tables.clone() };
        let mut stages = GpuTrace::new(&gpu, &Sources::default(), &tables).expect("kernels");
        let there =
            passes(&mut stages, &tables, &part, &mut |_: f64| (), &until).expect("no error").expect("a film");
        assert!(film == there, "the GPU ends where the CPU does, few: {few}");
    }
    let mut exact = tables.clone();
    (exact.samples, exact.view.seed) = (2048, 5);
    let exact = on_cpu(&exact);
    let mut counts = std::collections::BTreeSet::new();
    for (top, left) in [0, 16, 32].into_iter().flat_map(|top| [0, 16, 32].map(move |left| (top, left))) {
        let tile = (top..40.min(top + 16)).flat_map(|y| (left..left + 16).map(move |x| y * 48 + x));
        let tile: Vec<u32> = tile.collect();
        let samples = film.samples(tile[0]);
        assert!(tile.iter().all(|&pixel| film.samples(pixel) == samples), "a tile ends as one");
        assert!(samples >= 16.0 && samples % 16.0 == 0.0, "{samples}");
        counts.insert(samples as u32);
        let apart = |pixel: u32| f64::from(luminance(film.color(pixel) - exact.color(pixel))).powi(2);
        let error = (tile.iter().map(|&pixel| apart(pixel)).sum::<f64>() / tile.len() as f64).sqrt();
        // What is compared with has an error of its own, and what is estimated is one by chance.
        assert!(error < f64::from(noise) * 1.4, "{error} after {samples} samples at {left}, {top}");
        if samples < 2048.0 {
            assert!(error > f64::from(noise) * 0.3 || samples == 16.0, "{error} is more than was asked for");
        }
    }
    assert!(counts.len() > 2, "dark tiles end before bright ones: {counts:?}");
}
