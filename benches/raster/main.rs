//! The rasterizer beside the adapter's own graphics pipeline: same device, same vertices, same matrices, in turns.
//!
//! `cargo bench --bench raster` prints, for each scene, the median of nine frames of both, from their submission to their
//! end, and how many pixels agree (`-- "8 px"` for the scenes whose name has that in it; `-- --stages` for each stage's
//! time, waited for one by one; `-- --busy` to count the processor's time instead, which hardly hangs on what runs beside).

#[path = "../bvh/clock.rs"]
#[allow(dead_code, reason = "of threads alone it is asked elsewhere")]
mod clock;
mod frames;
mod full;
mod peer;
mod scenes;

use std::sync::LazyLock;
use std::time::Instant;

use peer::Peer;
use twinlight::gpu::wgsl::Sources;
use twinlight::gpu::{Gpu, GpuImage, GpuRaster, Variant, Wanted};
use twinlight::raster::{Raster as _, draw};
use twinlight::tables::{DEEP, Drawing, Lens, NO_DEPTH};

const TURNS: usize = 9;

/// What tells how many seconds have gone by.
type Clock = fn() -> f64;

fn on_the_wall() -> f64 {
    static START: LazyLock<Instant> = LazyLock::new(Instant::now);
    START.elapsed().as_secs_f64()
}

/// In ms.
fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2] * 1e3
}

/// How many of the pixels have the same depth, as near as the peer's 24 bits tell.
fn alike(ours: &[u32], theirs: &[f32]) -> f64 {
    let depth = |d: u32| if d == NO_DEPTH { 1.0 } else { f64::from(d) / f64::from(DEEP) };
    let same = ours.iter().zip(theirs).filter(|(o, t)| (depth(**o) - f64::from(**t)).abs() < 2e-3);
    same.count() as f64 / theirs.len() as f64
}

/// Every stage by itself, in ms.
fn stages(ours: &mut GpuRaster<'_>, lens: &Lens, image: &mut GpuImage, clock: Clock) -> Vec<(&'static str, f64)> {
    let mut times = Vec::new();
    let mut lap = |ours: &mut GpuRaster<'_>, name, at: f64| {
        ours.told().expect(name);
        times.push((name, (clock() - at) * 1e3));
        clock()
    };
    ours.told().expect("nothing");
    let mut at = clock();
    ours.clear(image).expect("clear");
    at = lap(ours, "clear", at);
    ours.project(lens).expect("project");
    at = lap(ours, "project", at);
    for faces in ours.portions(lens) {
        if faces.start > 0 {
            ours.far(lens, image).expect("far");
            at = lap(ours, "far", at);
            ours.veil(lens).expect("veil");
            at = lap(ours, "veil", at);
        }
        ours.split(lens, image, false, faces).expect("split");
        at = lap(ours, "split", at);
    }
    ours.cut(lens).expect("cut");
    at = lap(ours, "cut", at);
    ours.count(lens).expect("count");
    at = lap(ours, "count", at);
    ours.scan(lens).expect("scan");
    at = lap(ours, "scan", at);
    ours.fill(lens).expect("fill");
    at = lap(ours, "fill", at);
    ours.cover(lens, image).expect("cover");
    lap(ours, "cover", at);
    times
}

fn depths_alone(gpu: &Gpu, name: &str, drawing: &Drawing, by_stage: bool, clock: Clock) {
    let lens = &drawing.eyes[0];
    let peer = Peer::new(gpu, drawing);
    let mut variants = vec![("", Variant::of(gpu)), (", portable", Variant::PORTABLE)];
    variants.dedup_by_key(|(_, variant)| *variant);
    for (way, variant) in variants {
        let mut ours =
            GpuRaster::of(gpu, &Sources::default(), drawing, variant).unwrap_or_else(|e| panic!("{name}: {e}"));
        let mut image = ours.image(lens.pixels() as usize, false).expect("an image");
        let mut times = [Vec::new(), Vec::new()];
        // The first turn compiles, and finds out how much room there must be.
        for turn in 0..=TURNS {
            let start = clock();
            peer.draw();
            let theirs = clock() - start;
            let start = clock();
            ours.clear(&mut image).expect("clear");
            draw(&mut ours, lens, &mut image).expect("a drawing");
            if turn > 0 {
                times[0].push(theirs);
                times[1].push(clock() - start);
            }
        }
        let alike = alike(&ours.seen(&image).expect("depths").0, &peer.depths());
        let [theirs, took] = times.map(median);
        println!(
            "{:<40} {theirs:8.2} ms  {took:8.2} ms   {:5.2} x   {:8.4} %",
            [name, way].concat(),
            theirs / took,
            alike * 100.0
        );
        if by_stage {
            for (stage, took) in stages(&mut ours, lens, &mut image, clock) {
                println!("    {stage:<8} {took:8.2} ms");
            }
        }
    }
}

/// A scene for a film of some size.
type Make = fn([u32; 2]) -> Drawing;

fn main() {
    let gpu = Gpu::open(&Wanted::Best).unwrap_or_else(|e| panic!("{e}"));
    let (flags, names): (Vec<String>, Vec<String>) = std::env::args().skip(1).partition(|a| a.starts_with("--"));
    let by_stage = flags.iter().any(|flag| flag == "--stages");
    let busy = flags.iter().any(|flag| flag == "--busy");
    let clock: Clock = if busy { clock::process } else { on_the_wall };
    let size = [1920, 1080];
    let scenes: [(&str, Make); 8] = [
        ("1 M of 2 px", |size| scenes::sheets(size, [1000, 500], 1)),
        ("1 M of 2 px, shuffled", |size| scenes::shuffled(scenes::sheets(size, [1000, 500], 1))),
        ("1 M of 8 px, 4 layers", |size| scenes::sheets(size, [500, 250], 4)),
        ("1 M of 8 px, 4 layers, farthest first", |size| {
            scenes::farthest_first(scenes::sheets(size, [500, 250], 4))
        }),
        ("250 k of 33 px, 4 layers", |size| scenes::sheets(size, [250, 125], 4)),
        ("40 k of 200 px, 4 layers", |size| scenes::sheets(size, [100, 50], 4)),
        ("64 full-screen, 32 layers", |size| scenes::sheets(size, [1, 1], 32)),
        ("4 M of 0.5 px", |size| scenes::sheets(size, [2000, 1000], 1)),
    ];
    for (name, make) in frames::SCENES {
        if names.is_empty() || names.iter().any(|wanted| name.contains(wanted)) {
            frames::whole(&gpu, name, &make(size), by_stage, clock);
        }
    }
    println!(
        "{}, {} x {}, depth only{}: the peer, ours, how many times as fast",
        gpu.adapter().name,
        size[0],
        size[1],
        if busy { ", by the processor's time" } else { "" }
    );
    for (name, scene) in scenes {
        if names.is_empty() || names.iter().any(|wanted| name.contains(wanted)) {
            depths_alone(&gpu, name, &scene(size), by_stage, clock);
        }
    }
}
