//! What the window promises, without its window: the time to a first picture, pictures a second while the eye moves, and
//! that memory stays as it is.

use std::path::Path;
use std::time::{Duration, Instant};

use glam::Vec2;
use twinlight::gpu::wgsl::Sources;
use twinlight::gpu::{Gpu, Screen, Wanted};
use twinlight::render::live::{Live, Side};
use twinlight::scene::{Method, Reach};
use twinlight::view::desk::{Desk, Hand};

fn desk(scene: &str, method: Method, size: [u32; 2]) -> Desk {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(scene);
    let edits = [("film.size".to_owned(), format!("[{}, {}]", size[0], size[1]))];
    let desk = Desk::open(&path, &edits, &Reach::default()).unwrap_or_else(|e| panic!("{e}"));
    desk.with(Some(method), Side::Gpu)
}

/// Bytes of memory that this process has.
fn memory() -> u64 {
    let pages = std::fs::read_to_string("/proc/self/statm").unwrap_or_default();
    pages.split(' ').nth(1).and_then(|pages| pages.parse::<u64>().ok()).unwrap_or(0) * 4096
}

fn median(mut times: Vec<Duration>) -> f64 {
    times.sort();
    times[times.len() / 2].as_secs_f64() * 1e3
}

fn main() {
    let frames: u32 = std::env::var("TWINLIGHT_FRAMES").ok().and_then(|n| n.parse().ok()).unwrap_or(100);
    let start = Instant::now();
    let gpu = Gpu::open(&Wanted::Best).unwrap_or_else(|e| panic!("{e}"));
    println!("{}; {frames} moves of the eye, 640 x 480", gpu.adapter().name);
    println!("| scene | method | first picture | a move, median | of full size | memory, first and last |");
    println!("|---|---|---|---|---|---|");
    let mut opened = start.elapsed();
    for (scene, method) in [
        ("bust.toml", Method::Raster),
        ("room.toml", Method::Trace),
        ("bust.toml", Method::Trace),
        ("pyramid.toml", Method::Raster),
    ] {
        let size = [640, 480];
        let room = size.map(|side| side as f32);
        let start = Instant::now();
        let mut desk = desk(scene, method, size);
        let sources = Sources::default();
        let screen = Screen::new(&gpu, &sources, size).expect("a screen");
        let ready = Live::new(&gpu, &sources, desk.wish(room), &Reach::default());
        let mut live = ready.unwrap_or_else(|e| panic!("{e}"));
        let picture = |live: &mut Live<'_>| {
            while !live.step().unwrap_or_else(|e| panic!("{e}")) {}
            live.show(&screen).expect("a picture");
        };
        picture(&mut live);
        let first = opened + start.elapsed();
        let (mut times, mut whole) = (Vec::new(), 0);
        let mut before = 0;
        for i in 0..frames {
            desk.hand(Hand::Orbit(Vec2::new(0.003, if i % 100 < 50 { 0.001 } else { -0.001 })));
            let start = Instant::now();
            assert!(live.aim(&desk.wish(room)).expect("an eye"), "the scene is kept");
            picture(&mut live);
            times.push(start.elapsed());
            whole += u32::from(live.progress().film == size);
            if i == frames / 10 {
                before = memory();
            }
        }
        println!(
            "| {scene} | {method:?} | {:.0} ms | {:.1} ms | {} % | {:.1} MiB, {:.1} MiB |",
            first.as_secs_f64() * 1e3,
            median(times),
            whole * 100 / frames,
            before as f64 / f64::from(1 << 20),
            memory() as f64 / f64::from(1 << 20),
        );
        opened = Duration::ZERO;
    }
}
