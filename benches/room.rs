//! The spec's room on both backends, beside the spec's way to trace it: recursive, on one thread.
//!
//! `cargo bench --bench room` renders 800 x 600, 4 x 4, depth 6, all sides in turn, and prints the best of three
//! (`-- 320x240 1` for another size and number of turns). Before a time counts, the pictures are compared.

use std::time::{Duration, Instant};

use glam::Vec3;
use twinlight::film::Film;
use twinlight::film::compare::{Standard, compare};
use twinlight::gpu::Wanted;
use twinlight::prepare::prepare;
use twinlight::render::{Backend, Renderer};
use twinlight::scene::{self, Method, Scene};

#[path = "../tests/suite/recursive.rs"]
mod recursive;

type Real = f32;
type Vector = Vec3;

fn real(x: f32) -> f32 {
    x
}

fn vector(v: Vec3) -> Vec3 {
    v
}

/// The spec's program in its own words: one ray after the other, on one thread.
fn peer(scene: &Scene) -> (Film, Duration) {
    let view = prepare(scene).view;
    let start = Instant::now();
    let tracer = recursive::Recursive::new(scene, 1e-3);
    let [width, height] = scene.film.size;
    let (mut sums, mut ids) = (Vec::new(), Vec::new());
    for pixel in 0..width * height {
        let directions = (0..scene.trace.samples).map(|s| twinlight::cpu::trace::primary::primary(&view, pixel, s));
        let mut sum = Vec3::ZERO;
        for direction in directions {
            sum += tracer.trace(view.eye, direction, false, scene.trace.depth);
        }
        sums.push([sum.x, sum.y, sum.z, scene.trace.samples as f32]);
        ids.push(0);
    }
    let mut film = Film::new(width, height);
    film.put(0, &sums, &ids);
    (film, start.elapsed())
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let mut scene = scene::load("scenes/room.toml".as_ref()).unwrap_or_else(|e| panic!("{e}"));
    if let Some((w, h)) = arguments.first().and_then(|size| size.split_once('x')) {
        scene.film.size = [w, h].map(|side| side.parse().expect("a number of pixels"));
    }
    let turns = arguments.get(1).map_or(3, |turns| turns.parse().expect("a number of turns"));

    let mut on_cpu = Renderer::open(Backend::Cpu, &Wanted::Best).expect("the CPU");
    let mut on_gpu = Renderer::open(Backend::Gpu, &Wanted::Best).unwrap_or_else(|e| panic!("{e}"));
    let adapter = on_gpu.gpu().map(|gpu| gpu.adapter().name.clone()).unwrap_or_default();
    let mut best = [Duration::MAX; 3];
    for _ in 0..turns {
        let (truth, took) = peer(&scene);
        best[0] = best[0].min(took);
        for (renderer, best) in [&mut on_cpu, &mut on_gpu].into_iter().zip(&mut best[1..]) {
            let rendered = renderer.render(&scene, Method::Trace, &mut |_| ()).unwrap_or_else(|e| panic!("{e}"));
            *best = (*best).min(rendered.took);
            let alike = compare(&truth, &rendered.film, Standard::Near).expect("one size");
            let far = alike.rows.iter().find(|row| row.tolerance.tier == 'B').map_or(1.0, |row| row.found);
            assert!(far < 0.005, "{}: {far} of the pixels are another picture's", rendered.by);
        }
    }
    let [width, height] = scene.film.size;
    println!("room, {width} x {height}, {} samples, depth {}:", scene.trace.samples, scene.trace.depth);
    let names = ["recursive, one thread".to_owned(), "CPU twin".to_owned(), adapter];
    for (name, took) in names.iter().zip(best) {
        let share = took.as_secs_f64() / best[0].as_secs_f64();
        println!("  {name:<40} {:>8.3} s  {share:.3} of the recursive one", took.as_secs_f64());
    }
}
