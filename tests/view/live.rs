//! The kept scene of the preview: what stands still at last is what a frame made at once is, to the bit.

use std::sync::Arc;
use std::time::{Duration, Instant};

use twinlight::cpu::film::develop::develop;
use twinlight::film::Transfer;
use twinlight::gpu::wgsl::Sources;
use twinlight::gpu::{Gpu, Screen, Wanted};
use twinlight::math::Vec3;
use twinlight::render::live::{Live, Side, Wish};
use twinlight::render::{Backend, Renderer};
use twinlight::scene::model::{self, Content, Corner, Map, Model, Texture};
use twinlight::scene::{Behavior, Filter, Light, Mesh, Method, Reach, Scene, Triangle};
use twinlight::view::desk::{Desk, Hand};
use twinlight::view::keys::Command;
use twinlight::view::worker::{Inside, Order, Report, Worker};

use super::{gpu, root, small};

/// The picture that `twinlight render` makes on the CPU.
fn words(scene: &Scene, method: Method) -> Vec<u32> {
    let mut renderer = Renderer::open(Backend::Cpu, &Wanted::Software).expect("a CPU");
    let film = renderer.render(scene, method, &mut |_| ()).expect("a picture").film;
    let picture = film.to_rgb8(scene.film.transfer);
    picture.pixels().map(|p| u32::from_le_bytes([p[0], p[1], p[2], 255])).collect()
}

/// The last picture of a wish.
fn last(gpu: &Gpu, live: &mut Live<'_>, size: [u32; 2]) -> Vec<u32> {
    let screen = Screen::new(gpu, &Sources::default(), size).expect("a screen");
    let mut steps = 0;
    while !live.done() {
        if live.step().expect("work that is done") {
            live.show(&screen).expect("a picture");
        }
        steps += 1;
        assert!(steps < 100_000, "it never ends");
    }
    screen.read(gpu).expect("the picture")
}

fn open<'g>(gpu: &'g Gpu, wish: &Wish) -> Live<'g> {
    Live::new(gpu, &Sources::default(), wish.clone(), &Reach::default()).expect("a scene that is ready")
}

#[test]
fn what_stands_still_is_what_is_rendered() {
    let gpu = gpu();
    for name in ["room", "room-diffuse", "pyramid", "bust", "bust-point"] {
        let scene = small(name, [61, 47], 4);
        let expected = words(&scene, scene.method);
        for side in [Side::Gpu, Side::Cpu] {
            let wish = Wish { method: scene.method, scene: scene.clone(), side, moving: false };
            let got = last(&gpu, &mut open(&gpu, &wish), [61, 47]);
            assert!(got == expected, "{name} on the {side:?}");
        }
    }
    assert_eq!(gpu.complaint(), None, "wgpu complained");
}

#[test]
fn a_kept_scene_is_as_good_as_a_new_one() {
    let gpu = gpu();
    for (name, method) in [("bust", Method::Raster), ("room", Method::Trace), ("room", Method::Raster)] {
        let edits = [("film.size", "[61, 47]"), ("trace.samples", "4"), ("raster.shadow_size", "256")];
        let edits = edits.map(|(place, value)| (place.to_owned(), value.to_owned()));
        for side in [Side::Gpu, Side::Cpu] {
            let path = root().join(format!("scenes/{name}.toml"));
            let desk = Desk::open(&path, &edits, &Reach::default()).unwrap_or_else(|e| panic!("{e}"));
            let mut desk = desk.with(Some(method), side);
            let mut live = open(&gpu, &desk.wish([61.0, 47.0]));
            let drag = |x, y| Hand::Orbit(glam::Vec2::new(x, y));
            for (hand, still) in [(drag(0.1, 0.02), false), (drag(-0.3, 0.1), false), (drag(0.05, 0.0), true)] {
                desk.hand(hand);
                if still {
                    desk.let_go();
                }
                assert!(live.aim(&desk.wish([61.0, 47.0])).expect("an eye"), "only the eye has moved");
                live.step().expect("a first picture");
            }
            let wish = desk.wish([61.0, 47.0]);
            let got = last(&gpu, &mut live, [61, 47]);
            assert!(got == words(&wish.scene, method), "{name} {method:?} on the {side:?}");
            desk.obey(Command::SwitchSide);
            assert!(!live.aim(&desk.wish([61.0, 47.0])).expect("an order"), "another backend is another matter");
        }
    }
}

#[test]
fn other_lights_and_another_background_are_taken_up() {
    let gpu = gpu();
    for (name, method) in [("room", Method::Trace), ("bust", Method::Trace), ("bust", Method::Raster)] {
        for side in [Side::Gpu, Side::Cpu] {
            let mut wish = Wish { method, scene: small(name, [31, 23], 1), side, moving: false };
            let mut live = open(&gpu, &wish);
            last(&gpu, &mut live, [31, 23]);
            wish.scene.film.background = glam::Vec3::new(0.1, 0.4, 0.2);
            let first = wish.scene.lights.first_mut().expect("a light");
            *first =
                Light::Point { position: glam::Vec3::new(1.0, 2.0, 2.5), power: glam::Vec3::new(0.3, 0.9, 0.4) };
            assert!(live.aim(&wish).expect("a wish"), "{name} is made ready anew");
            let got = last(&gpu, &mut live, [31, 23]);
            assert!(got == words(&wish.scene, method), "{name} {method:?} on the {side:?}");
        }
    }
}

#[test]
fn other_numbers_of_materials_are_taken_up() {
    let gpu = gpu();
    for name in ["room", "room-diffuse", "stones", "dahlia"] {
        for side in [Side::Gpu, Side::Cpu] {
            let mut wish = Wish { method: Method::Trace, scene: small(name, [31, 23], 1), side, moving: false };
            let mut live = open(&gpu, &wish);
            let before = last(&gpu, &mut live, [31, 23]);
            for material in &mut wish.scene.materials {
                material.color = glam::Vec3::new(0.2, 0.7, 0.9) - material.color * 0.2;
                (material.local, material.reflect, material.exponent) = (0.6, 0.3, 7.0);
                (material.refract, material.index) = (material.refract * 0.5, material.index + 0.1);
            }
            assert!(live.aim(&wish).expect("a wish"), "{name} is made ready anew");
            let got = last(&gpu, &mut live, [31, 23]);
            assert!(got != before, "{name}: that is no test");
            assert!(got == words(&wish.scene, Method::Trace), "{name} on the {side:?}");
            // Other kernels, or other pictures to read, are another matter.
            let first = wish.scene.materials.first_mut().expect("a material");
            first.behavior = if first.behavior == Behavior::Glass { Behavior::Diffuse } else { Behavior::Glass };
            assert!(!live.aim(&wish).expect("a wish"), "{name} is not made ready anew");
        }
    }
}

/// A square in the light of the pyramid's scene, with holes that its picture cuts by a few texels.
fn square_with_holes() -> Mesh {
    let corner = |i| Corner { position: i, uv: i, normal: 0 };
    let face = |corners: [u32; 3]| model::Triangle { corners: corners.map(corner), material: 0, group: 0 };
    let texels = (0..16_u32).map(|i| [9, 9, 9, (i * 97 % 256) as u8]).collect();
    let picture =
        Texture { file: String::new(), content: Content::Scalar, width: 4, height: 4, texels, has_alpha: true };
    let scale = glam::Vec2::ONE;
    let holes = Map { texture: 0, scale, offset: glam::Vec2::ZERO, clamp: false, strength: 1.0 };
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let model = Model {
        groups: vec![String::new()],
        positions: square.map(|[x, y]| Vec3::new(2.0 * x - 0.5, 2.0 * y + 0.5, 1.5)).to_vec(),
        uvs: square.map(glam::Vec2::from_array).to_vec(),
        normals: vec![Vec3::Z],
        triangles: vec![face([0, 1, 2]), face([0, 2, 3])],
        textures: vec![picture],
        materials: vec![model::Material { opacity_map: Some(holes), ..model::Material::named("lace") }],
        ..Model::default()
    };
    Mesh::of(Arc::new(model))
}

#[test]
fn another_filter_is_another_hole_and_another_shadow() {
    let gpu = gpu();
    for side in [Side::Gpu, Side::Cpu] {
        let mut scene = small("pyramid", [61, 47], 1);
        scene.meshes = vec![square_with_holes()];
        // Where there is an infinite plane, the lights' depths are drawn again anyway.
        scene.planes.clear();
        let mut wish = Wish { method: Method::Raster, scene, side, moving: false };
        let mut live = open(&gpu, &wish);
        let before = last(&gpu, &mut live, [61, 47]);
        for filter in [Filter::Nearest, Filter::Bilinear, Filter::Mipmap, Filter::Nearest] {
            wish.scene.raster.filter = filter;
            assert!(live.aim(&wish).expect("a wish"), "only the filter is another");
            let got = last(&gpu, &mut live, [61, 47]);
            assert!(got == words(&wish.scene, Method::Raster), "{filter:?} on the {side:?}");
            assert!(filter != Filter::Nearest || got != before, "that is no test");
        }
    }
    assert_eq!(gpu.complaint(), None, "wgpu complained");
}

#[test]
fn long_frames_grow_block_by_block() {
    let gpu = gpu();
    let mut scene = small("room-diffuse", [17, 13], 150);
    scene.trace.depth = 3;
    let expected = words(&scene, Method::Trace);
    for side in [Side::Gpu, Side::Cpu] {
        let wish = Wish { method: Method::Trace, scene: scene.clone(), side, moving: false };
        assert!(last(&gpu, &mut open(&gpu, &wish), [17, 13]) == expected, "{side:?}");
    }
}

/// The numbers of a film, some of them no numbers at all, on both sides.
#[test]
fn a_film_is_developed_alike() {
    let gpu = gpu();
    let numbers = [0.0, -1.0, 0.003, 0.0031308, 0.2, 0.5, 0.999, 1.0, 7.0, f32::NAN, f32::INFINITY, 1e-30];
    let sums: Vec<[f32; 4]> = (0..600_usize)
        .map(|i| [numbers[i % 12], numbers[i / 12 % 12], (i as f32 / 599.0).powi(3), [0.0, 1.0, 3.0, 16.0][i % 4]])
        .collect();
    for transfer in [Transfer::Srgb, Transfer::None] {
        for size in [[30, 20], [61, 47], [7, 3]] {
            let screen = Screen::new(&gpu, &Sources::default(), size).expect("a screen");
            let print = screen.print([30, 20], transfer);
            screen.develop(&gpu, &print, &gpu.upload("sums", &sums).expect("room")).expect("a picture");
            let by_kernel = screen.read(&gpu).expect("the picture");
            screen.put(&gpu, &develop(&print, &sums)).expect("a picture");
            assert!(by_kernel == screen.read(&gpu).expect("the picture"), "{transfer:?} {size:?}");
        }
    }
}

/// A wish for a floor of so many squares, of which each is two triangles.
fn floor(side: u32) -> Wish {
    let mut scene = small("pyramid", [31, 23], 1);
    let corner = |x: u32, z: u32| Vec3::new(x as f32, 0.0, z as f32) / side as f32;
    let square = |i: u32| {
        let (x, z) = (i % side, i / side);
        let [a, b, c, d] = [corner(x, z), corner(x + 1, z), corner(x + 1, z + 1), corner(x, z + 1)];
        [[a, b, c], [a, c, d]].map(|vertices| Triangle { vertices, material: 0, uvs: Triangle::UVS })
    };
    scene.triangles = (0..side * side).flat_map(square).collect();
    Wish { scene, method: Method::Trace, side: Side::Cpu, moving: false }
}

/// Asks again and again, as a hand does, until it has what it wants.
fn until(worker: &Worker, mut next: impl FnMut() -> Option<Wish>, done: impl Fn(&Report) -> bool) -> Report {
    let start = Instant::now();
    let sources = Arc::new(Sources::default());
    loop {
        if let Some(wish) = next() {
            let (sources, reach) = (Arc::clone(&sources), Reach::default());
            worker.ask(Order { wish, sources, reach, inside: Inside::default() });
        }
        std::thread::sleep(Duration::from_millis(5));
        let report = worker.report();
        assert_eq!(report.error, None);
        if done(&report) {
            return report;
        }
        assert!(start.elapsed() < Duration::from_mins(2), "it never ends: {:?}", report.progress);
    }
}

#[test]
fn a_tree_in_the_making_gives_way_to_another_scene_and_not_to_another_eye() {
    let gpu = Arc::new(Gpu::open(&Wanted::Software).expect("lavapipe"));
    let worker = Worker::new(gpu, Box::new(|| ()));
    // The eye moves all the time, and there is a picture all the same.
    let mut wish = floor(300);
    let moving = || {
        wish.scene.camera.position.x += 0.001;
        Some(wish.clone())
    };
    let report = until(&worker, moving, |report| report.pictures > 0);
    assert_eq!(report.building, None, "there is nothing left to build");
    // Another scene is not waited for, and is no error.
    let mut wishes = vec![Wish { scene: small("room", [37, 29], 1), ..floor(1) }, floor(600)];
    let size = |report: &Report| report.screen.as_ref().map(|screen| screen.size());
    let report = until(&worker, || wishes.pop(), |report| !report.busy && size(report) == Some([37, 29]));
    assert!(report.progress.has == report.progress.target && report.building.is_none(), "{:?}", report.progress);
}
