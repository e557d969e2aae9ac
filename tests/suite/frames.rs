//! Whole frames: GPU against CPU, and portions of any size against an unbroken run.

use twinlight::cpu::shade::scale::heat_of;
use twinlight::cpu::trace::CpuTrace;
use twinlight::film::Film;
use twinlight::film::compare::{Standard, compare};
use twinlight::gpu::wgsl::Sources;
use twinlight::scene::{self, Material, Method, Show};
use twinlight::tables::NONE;
use twinlight::trace;

use super::{Sliced, on_cpu, on_gpu, random_scene, root, scene_on_cpu, scene_on_gpu, scenes, small, tables_of};

fn same(a: &Film, b: &Film, what: &str) {
    let comparison = compare(a, b, Standard::Exact).expect("one size");
    assert!(comparison.passes(), "{what}: {comparison:#?}");
}

#[test]
fn shipped_scenes_are_the_same_to_the_bit() {
    for path in scenes() {
        for (size, samples) in [([97, 61], 4), ([61, 97], 3)] {
            let scene = small(&path, size, samples);
            let gpu = scene_on_gpu(&Sources::default(), &scene).expect("a film");
            same(&scene_on_cpu(&scene), &gpu, &path.display().to_string());
            let lit = (0..gpu.pixels()).filter(|&p| gpu.color(p).max_element() > 0.05).count();
            assert!(lit * 4 > gpu.pixels() as usize, "{}: a black picture proves nothing", path.display());
        }
    }
}

#[test]
fn shipped_scenes_are_the_same_at_their_own_size() {
    // What one input in a hundred thousand shows.
    for path in scenes() {
        let own = scene::load(&path).unwrap_or_else(|e| panic!("{e}"));
        let mut scene = small(&path, own.film.size, 1);
        for method in [Method::Trace, Method::Raster] {
            scene.method = method;
            let gpu = scene_on_gpu(&Sources::default(), &scene).expect("a film");
            same(&scene_on_cpu(&scene), &gpu, &path.display().to_string());
        }
    }
}

#[test]
fn random_scenes_are_the_same_to_the_bit() {
    for number in 0..60 {
        let tables = tables_of(&random_scene(number));
        let gpu = on_gpu(&Sources::default(), &tables).expect("a film");
        same(&on_cpu(&tables), &gpu, &format!("random scene {number}"));
    }
}

#[test]
fn a_traced_model_is_the_same_to_the_bit() {
    let mut scene = small(&root().join("scenes/bust.toml"), [97, 61], 4);
    scene.materials.push(Material { reflect: 0.5, ..random_scene(1).materials.swap_remove(0) });
    for mirrored in [None, Some(scene.materials.len() - 1)] {
        scene.meshes[0].material = mirrored;
        let tables = tables_of(&scene);
        let gpu = on_gpu(&Sources::default(), &tables).expect("a film");
        same(&on_cpu(&tables), &gpu, "the bust, traced");
        let met = (0..gpu.pixels()).filter(|&p| gpu.id(p) != NONE).count();
        assert!(met * 2 > gpu.pixels() as usize, "{met} pixels see something");
    }
}

#[test]
fn steps_are_counted_the_same() {
    for name in ["bust", "room", "pyramid"] {
        let mut scene = small(&root().join(format!("scenes/{name}.toml")), [97, 61], 4);
        scene.raster.show = Show::Steps;
        let tables = tables_of(&scene);
        let cpu = on_cpu(&tables);
        same(&cpu, &on_gpu(&Sources::default(), &tables).expect("a film"), name);
        let mut seen: Vec<_> = (0..cpu.pixels()).map(|p| cpu.color(p).to_array().map(f32::to_bits)).collect();
        seen.sort_unstable();
        seen.dedup();
        // The colors of four samples are mixed.
        let colors = if name == "bust" { 20 } else { 1 };
        assert!(seen.len() >= colors, "{name} has {} colors", seen.len());

        let text =
            Sources::default().get("trace/steps").expect("a file").replace("(found.turns)", "(found.turns + 2u)");
        let wrong = on_gpu(&Sources::default().with("trace/steps", text), &tables).expect("a film");
        assert!(!compare(&cpu, &wrong, Standard::Exact).expect("one size").passes(), "two steps more go unnoticed");
    }
}

#[test]
fn steps_are_what_a_ray_asks() {
    // A lone plane is one question, the root of no tree the second: the scale's third color.
    let mut scene = small(&root().join("scenes/room.toml"), [9, 7], 1);
    scene.raster.show = Show::Steps;
    scene.spheres.clear();
    scene.planes.truncate(1);
    let film = on_cpu(&tables_of(&scene));
    let one = heat_of(film.pixels());
    assert_ne!(film.color(0), one);
    assert_eq!(film.color(0), heat_of(2));
}

#[test]
fn portions_do_not_show() {
    let bust = small(&root().join("scenes/bust.toml"), [31, 23], 2);
    for scene in (0..12).map(random_scene).chain([bust]) {
        let tables = tables_of(&scene);
        let whole = on_cpu(&tables);
        for (budget, pixels, rounds) in [(5, 1000, 1), (6, 64, 2), (17, 65, 3), (200, 7, 1)] {
            let mut stages = Sliced { stages: CpuTrace::new(&tables), budget, pixels, rounds };
            let Ok(film) = trace::frame(&mut stages, &tables, &mut |_| ());
            same(&whole, &film, &format!("budget {budget}, {pixels} pixels, {rounds} rounds"));
        }
    }
}

#[test]
fn samples_add_up_in_order() {
    let scene = random_scene(3);
    let mut tables = tables_of(&scene);
    tables.view.grid = 0;
    tables.samples = 5;
    let five = on_cpu(&tables);
    tables.samples = 9;
    let nine = on_cpu(&tables);
    assert_ne!(five, nine, "more samples are another film");
    // Nine samples in a run that stops after five and goes on.
    let mut stages = CpuTrace::new(&tables);
    let mut paths = trace::Paths::new(0..nine.pixels(), &tables);
    for samples in [5, 9] {
        let slice = twinlight::tables::Slice { first: 0, count: nine.pixels(), samples, budget: u32::MAX };
        for _ in 0..samples {
            use twinlight::trace::Trace as _;
            let Ok(()) = stages.cast(&mut paths, &slice);
            let Ok(()) = stages.follow(&mut paths, &slice);
            let Ok(()) = stages.gather(&mut paths, &slice);
        }
        let mut film = Film::new(nine.width(), nine.height());
        film.put(0, &paths.sums, &paths.ids);
        film.put_squares(0, &paths.squares);
        same(if samples == 5 { &five } else { &nine }, &film, "a run that was stopped");
    }
}
