//! Everything that is promised, checked. One binary: the tests share one device.
//!
//! No test is skipped: a missing adapter or golden picture is a failure. Where a check could be blind, a planted
//! fault beside it (`mutants.rs`, `compare.rs`) shows that it sees.

mod agree;
mod alone;
mod analytic;
mod animation;
mod branches;
mod brute;
mod bvh;
mod cli;
mod cli_bands;
mod cli_batch;
mod cli_explain;
mod cli_parts;
mod cli_words;
mod compare;
mod coordinates;
mod explain;
mod few;
mod frames;
mod fuzz;
mod golden;
mod herds;
mod hostile;
mod inside;
mod instances;
mod kept;
mod layout;
mod loops;
mod maps;
mod mutants;
mod oracle;
#[path = "../fuzz/parsers.rs"]
#[allow(dead_code, unreachable_pub, reason = "other tests and targets ask for the rest")]
mod parsers;
mod parts;
mod plain;
mod power;
mod quotient;
mod raster_closed;
mod raster_exact;
mod raster_frames;
mod raster_lace;
mod raster_mutants;
mod raster_oracle;
mod raster_order;
mod raster_shadows;
mod raster_shrink;
mod raster_veil;
mod raster_ways;
mod raster_windows;
mod schema;
mod stages;
mod textures;
mod tidy;
mod ties;
mod time;
mod trace_lace;
mod trace_maps;
mod waiting;
mod watertight;
mod wide;
mod wrong;

use std::convert::Infallible;
use std::path::{Path, PathBuf};
use std::sync::{LazyLock, Mutex, MutexGuard, PoisonError};

use twinlight::cpu::grays::grays;
use twinlight::cpu::raster::CpuRaster;
use twinlight::cpu::trace::CpuTrace;
use twinlight::film::compare::{Standard, compare};
use twinlight::film::{Film, Run};
use twinlight::gpu::wgsl::Sources;
use twinlight::gpu::{self, Gpu, GpuRaster, GpuTrace, Wanted};
use twinlight::math::random::{pcg4d, unit_float};
use twinlight::math::{Vec3, vector::unit};
use twinlight::prepare::{draw, prepare};
use twinlight::raster;
use twinlight::scene::{self, Method, Scene};
use twinlight::tables::{Slice, Tables};
use twinlight::trace::{self, Paths, Trace};

static GPU: LazyLock<Mutex<Gpu>> = LazyLock::new(|| {
    let gpu = Gpu::open(&Wanted::Software).unwrap_or_else(|e| panic!("{e}; tests/run installs one"));
    Mutex::new(gpu)
});

/// The one device. Its complaints belong to whoever holds it, so one test holds it at a time.
fn gpu() -> MutexGuard<'static, Gpu> {
    GPU.lock().unwrap_or_else(PoisonError::into_inner)
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Every scene that is shipped.
fn scenes() -> Vec<PathBuf> {
    let folder = std::fs::read_dir(root().join("scenes")).expect("scenes");
    let mut all: Vec<_> = folder.map(|entry| entry.expect("an entry").path()).collect();
    all.retain(|path| path.extension().is_some_and(|e| e == "toml"));
    all.sort();
    assert!(all.len() >= 3, "the scenes are gone: {all:?}");
    all
}

/// A shipped scene, small enough to be rendered often.
fn small(path: &Path, size: [u32; 2], samples: u32) -> Scene {
    let mut scene = scene::load(path).unwrap_or_else(|e| panic!("{e}"));
    scene.resize(size).expect("a small film fits");
    scene.trace.samples = samples;
    scene.raster.samples = samples.isqrt().pow(2);
    scene.raster.shadow_size = 256;
    scene
}

fn on_cpu(tables: &Tables) -> Film {
    let Ok(film) = trace::frame(&mut CpuTrace::new(tables), tables, &mut |_| ());
    film
}

fn on_gpu(sources: &Sources, tables: &Tables) -> Result<Film, gpu::Error> {
    let gpu = gpu();
    let film = trace::frame(&mut GpuTrace::new(&gpu, sources, tables)?, tables, &mut |_| ())?;
    assert_eq!(gpu.complaint(), None, "wgpu complained");
    Ok(film)
}

/// The CPU's film of a scene, by the scene's own method.
fn scene_on_cpu(scene: &Scene) -> Film {
    if scene.method == Method::Trace {
        return on_cpu(&tables_of(scene));
    }
    let mut drawing = draw(scene);
    grays(scene, &mut drawing);
    let Ok(film) = raster::frame(&mut CpuRaster::new(&drawing), &drawing, &mut |_| ());
    film
}

/// The GPU's film of a scene, by the scene's own method.
fn scene_on_gpu(sources: &Sources, scene: &Scene) -> Result<Film, gpu::Error> {
    if scene.method == Method::Trace {
        return on_gpu(sources, &tables_of(scene));
    }
    let gpu = gpu();
    let mut drawing = draw(scene);
    grays(scene, &mut drawing);
    let film = raster::frame(&mut GpuRaster::new(&gpu, sources, &drawing)?, &drawing, &mut |_| ())?;
    assert_eq!(gpu.complaint(), None, "wgpu complained");
    Ok(film)
}

/// A stream of numbers that is the same on every run.
struct Dice(u32, u32);

impl Dice {
    fn bits(&mut self) -> u32 {
        self.1 += 1;
        pcg4d([self.0, self.1, 0, 0])[0]
    }

    fn unit(&mut self) -> f32 {
        unit_float(self.bits())
    }

    fn within(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.unit()
    }

    fn below(&mut self, n: usize) -> usize {
        self.bits() as usize % n
    }

    fn point(&mut self, reach: f32) -> Vec3 {
        Vec3::from_array(std::array::from_fn(|_| self.within(-reach, reach)))
    }

    fn direction(&mut self) -> Vec3 {
        loop {
            let v = self.point(1.0);
            if v.length() > 0.1 {
                return unit(v);
            }
        }
    }
}

/// A scene of everything there is, in disorder: the same for the same number.
fn random_scene(number: u32) -> Scene {
    let mut dice = Dice(number, 0);
    let mut scene = small(&root().join("scenes/pyramid.toml"), [31, 23], 1 + number % 5);
    scene.camera.position = dice.point(4.0) + Vec3::Z * 9.0;
    scene.camera.look_at = dice.point(2.0);
    scene.trace.depth = 1 + dice.below(7) as u32;
    scene.trace.seed = dice.bits();
    scene.trace.specular = [scene::Specular::Phong, scene::Specular::Blinn][dice.below(2)];
    scene.materials = (0..4)
        .map(|i| scene::Material {
            name: i.to_string(),
            color: dice.point(0.5) + 0.5,
            local: dice.unit(),
            reflect: dice.unit(),
            refract: dice.unit(),
            exponent: [0.0, 1.0, 7.5, 80.0][dice.below(4)],
            index: dice.within(1.0, 2.5),
            behavior: [scene::Behavior::Mirror, scene::Behavior::Diffuse, scene::Behavior::Glass][dice.below(3)],
            maps: scene::Maps::default(),
        })
        .collect();
    scene.spheres = (0..dice.below(12))
        .map(|_| scene::Sphere { center: dice.point(4.0), radius: dice.within(0.05, 1.5), material: dice.below(4) })
        .collect();
    scene.planes = (0..dice.below(4))
        .map(|_| scene::Plane {
            point: dice.point(6.0),
            normal: dice.direction(),
            material: dice.below(4),
            tile: 1.0,
        })
        .collect();
    scene.triangles = (0..dice.below(20))
        .map(|_| {
            let a = dice.point(5.0);
            let vertices = [a, a + dice.point(2.0), a + dice.point(2.0)];
            scene::Triangle { vertices, material: dice.below(4), uvs: scene::Triangle::UVS }
        })
        .collect();
    scene.lights = (0..dice.below(4))
        .map(|_| {
            let power = dice.point(0.5) + 0.5;
            if dice.below(2) == 0 {
                scene::Light::Point { position: dice.point(6.0), power }
            } else {
                scene::Light::Directional { toward: dice.direction(), power, camera: None }
            }
        })
        .collect();
    scene
}

/// The CPU's stages in portions of any size.
struct Sliced<'a> {
    stages: CpuTrace<'a>,
    budget: u32,
    pixels: u32,
    rounds: u32,
}

impl Trace for Sliced<'_> {
    type Paths = Paths;
    type Error = Infallible;

    fn most_pixels(&self) -> u32 {
        self.pixels
    }

    fn budget(&self) -> u32 {
        self.budget
    }

    fn rounds(&self) -> u32 {
        self.rounds
    }

    fn begin(&mut self, run: &Run, end: u32) -> Result<Paths, Infallible> {
        self.stages.begin(run, end)
    }

    fn cast(&mut self, paths: &mut Paths, slice: &Slice) -> Result<(), Infallible> {
        self.stages.cast(paths, slice)
    }

    fn follow(&mut self, paths: &mut Paths, slice: &Slice) -> Result<(), Infallible> {
        self.stages.follow(paths, slice)
    }

    fn steps(&mut self, paths: &mut Paths, slice: &Slice) -> Result<(), Infallible> {
        self.stages.steps(paths, slice)
    }

    fn gather(&mut self, paths: &mut Paths, slice: &Slice) -> Result<(), Infallible> {
        self.stages.gather(paths, slice)
    }

    fn few(&mut self, paths: &mut Paths, slice: &Slice) -> Result<(), Infallible> {
        self.stages.few(paths, slice)
    }

    fn settle(&mut self, paths: &mut Paths) -> Result<u32, Infallible> {
        assert_eq!(self.stages.status().flags, 0);
        self.stages.settle(paths)
    }

    fn end(&mut self, paths: Paths) -> Result<Paths, Infallible> {
        self.stages.end(paths)
    }

    fn ease(&mut self, error: Infallible) -> Result<(), Infallible> {
        Err(error)
    }
}

/// Plants faults into kernels (file, what stands there, what is planted): each makes some film another one. What has no
/// film any more is seen, too.
fn planted<T>(
    faults: &[(&str, &str, &str)],
    things: &[T],
    wanted: &[Film],
    on_gpu: impl Fn(&Sources, &T) -> Option<Film>,
) {
    for (file, right, wrong) in faults {
        let text = Sources::default().get(file).expect("the file").into_owned();
        assert!(text.contains(right), "{file} has no {right}");
        let sources = Sources::default().with(file, text.replace(right, wrong));
        let seen = things.iter().zip(wanted).any(|(thing, wanted)| {
            on_gpu(&sources, thing)
                .is_none_or(|gpu| !compare(wanted, &gpu, Standard::Exact).expect("one size").passes())
        });
        assert!(seen, "nobody sees {wrong} in {file}");
    }
}

fn tables_of(scene: &Scene) -> Tables {
    prepare(scene)
}
