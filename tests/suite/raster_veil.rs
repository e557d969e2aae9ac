//! What is hidden behind what is drawn is left out, and nothing else: the picture is the same.

use std::ops::ControlFlow;
use std::sync::atomic::Ordering::Relaxed;

use twinlight::cpu::raster::CpuRaster;
use twinlight::cpu::raster::behind::unveiled;
use twinlight::cpu::raster::speck::{Speck, speck};
use twinlight::film::Watch;
use twinlight::gpu::wgsl::Sources;
use twinlight::gpu::{GpuRaster, Room};
use twinlight::math::Vec3;
use twinlight::prepare::lens::{Pose, perspective};
use twinlight::raster::{Look, Raster, draw, frame, marked};
use twinlight::tables::{CELL, Drawing, Face, Lens, NONE, Vertex};

use super::raster_exact::{drawn_by, random_drawing, variants};
use super::{Dice, gpu};

/// Sheets of small triangles, one behind the other, some with holes and some twice, in any order.
fn sheets(number: u32) -> Drawing {
    let mut dice = Dice(number, 77);
    let size = [[61, 45], [96, 31], [16, 80], [33, 70]][dice.below(4)];
    let pose = Pose { eye: Vec3::ZERO, axes: [Vec3::X, Vec3::Y, Vec3::Z] };
    let mut lens = perspective(&pose, [1.0, 1.0], [0.1, 100.0], size, [0.0; 2]);
    lens.small = [16, 9, 24, 64][dice.below(4)];
    lens.slope = [0, 200][dice.below(2)];
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    for _ in 0..2 + dice.below(5) {
        let cells = [3 + dice.below(17), 2 + dice.below(3)][dice.below(2)] as u32;
        let [deep, tilt] = [dice.within(1.0, 6.0), [0.0, dice.within(-0.3, 0.3)][dice.below(2)]];
        // The whole view, or a part of it.
        let [wide, x0, y0] =
            [[2.6, -1.3, -1.3], [dice.within(0.5, 2.0), dice.within(-1.2, 0.0), -1.0]][dice.below(2)];
        let holes = [0, 0, 40][dice.below(3)];
        let first = vertices.len() as u32;
        for i in 0..(cells + 1) * (cells + 1) {
            let rough = [dice.within(-0.3, 0.3), dice.within(-0.3, 0.3)];
            let at = |k: u32, rough: f32| (k as f32 + rough) * wide / cells as f32;
            let [x, y] = [x0 + at(i % (cells + 1), rough[0]), y0 + at(i / (cells + 1), rough[1])];
            let position = Vec3::new(x, y, -1.0 - tilt * x) * deep;
            vertices.push(Vertex { position, u: 0.0, normal: Vec3::Z, v: 0.0 });
        }
        for i in (0..cells * (cells + 1)).filter(|i| i % (cells + 1) < cells) {
            if holes == 0 || dice.below(holes) > 0 {
                let a = first + i;
                faces.push(Face { a, b: a + 1, c: a + cells + 1, paint: 0 });
                faces.push(Face { a: a + 1, b: a + cells + 2, c: a + cells + 1, paint: 0 });
            }
        }
    }
    if dice.below(2) == 0 {
        (1..faces.len()).for_each(|i| faces.swap(i, dice.below(i + 1)));
    }
    faces.extend_from_within(..faces.len() / 4);
    Drawing { eyes: vec![lens], vertices, faces, ..random_drawing(0) }
}

fn in_portions(drawing: &Drawing, count: u32) -> (CpuRaster<'_>, [Vec<u32>; 2]) {
    let mut cpu = CpuRaster::new(drawing);
    cpu.portions.fixed = Some(count);
    drawn_by(cpu, drawing)
}

/// Depths and ids, and what would hide the next faces.
type Found = ([Vec<u32>; 2], Vec<[u32; 4]>);

fn on_gpu(kernels: &GpuRaster<'_>, drawing: &Drawing, count: u32) -> Found {
    let lens = &drawing.eyes[0];
    // In many parts, or in one.
    let room = if count == 2 { Room { binding: 4096, ..Room::default() } } else { Room::default() };
    let mut stages = kernels.again(drawing, room).expect("room");
    stages.portions.fixed = Some(count);
    let mut image = stages.image(lens.pixels() as usize, true).expect("an image");
    draw(&mut stages, lens, &mut image).expect("a drawing");
    marked(&mut stages, lens, &mut image).expect("ids");
    if !stages.marks() {
        stages.far(lens, &image).expect("far");
        stages.veil(lens).expect("veil");
    }
    let (depths, ids) = stages.seen(&image).expect("what is seen");
    ([depths, ids], stages.hiding(lens).expect("the veil"))
}

/// How many of a drawing's small faces what is drawn of it hides, of how many.
fn hidden(cpu: &CpuRaster<'_>, drawing: &Drawing) -> [usize; 2] {
    let lens = &drawing.eyes[0];
    let specks = drawing.faces.iter().map(|face| speck(lens, face, &cpu.corners));
    let small: Vec<_> = specks.filter(|s| matches!(s, Speck::Small { .. })).collect();
    let hidden = small.iter().filter(|s| matches!(unveiled(lens, **s, &cpu.veil), Speck::Nothing));
    [hidden.count(), small.len()]
}

#[test]
fn portions_do_not_show() {
    let gpu = gpu();
    let all = variants(&gpu).map(|v| GpuRaster::of(&gpu, &Sources::default(), &sheets(0), v).expect("kernels"));
    let mut sums = [0; 2];
    for number in 0..120 {
        let drawing = sheets(number);
        let (_, wanted) = in_portions(&drawing, 1);
        for count in [2, 3 + number % 5, 50] {
            let (cpu, found) = in_portions(&drawing, count);
            assert!(found == wanted, "drawing {number} on the CPU in {count} portions");
            let (found, veil) = on_gpu(&all[number as usize % all.len()], &drawing, count);
            assert!(veil == cpu.veil, "the veil of drawing {number}");
            assert!(found == wanted, "drawing {number} on the GPU in {count} portions");
            let [some, of] = hidden(&cpu, &drawing);
            sums = [sums[0] + some, sums[1] + of];
        }
    }
    assert!(sums[0] * 3 > sums[1], "too few are hidden: {sums:?}");
}

/// Each cell against each of its pixels, and each square of cells against each of them; then the same of the kernels.
#[test]
fn what_hides_is_the_farthest() {
    let gpu = gpu();
    let kernels = GpuRaster::new(&gpu, &Sources::default(), &sheets(0)).expect("kernels");
    let mut full = 0;
    for number in 0..40 {
        let drawing = sheets(number);
        let ids = number % 2 == 0;
        // Maps of shadows lie in one image, one after the other.
        let lens = &Lens { first: if ids { 0 } else { 77 }, ..drawing.eyes[0] };
        let words = (lens.first + lens.pixels()) as usize;
        let mut cpu = CpuRaster::new(&drawing);
        let mut stages = kernels.again(&drawing, Room::default()).expect("room");
        let Ok(mut image) = cpu.image(words, ids);
        let mut on_device = stages.image(words, ids).expect("an image");
        let Ok(()) = draw(&mut cpu, lens, &mut image);
        draw(&mut stages, lens, &mut on_device).expect("a drawing");
        let Ok(()) = cpu.far(lens, &image);
        let Ok(()) = cpu.veil(lens);
        stages.far(lens, &on_device).expect("far");
        stages.veil(lens).expect("veil");
        assert_eq!(stages.hiding(lens).expect("veil"), cpu.veil, "veil of drawing {number}");
        let cells = gpu.read(&stages.cells).expect("cells");
        assert_eq!(cells[..cpu.cells.len()], cpu.cells, "far of drawing {number}");
        let across = lens.cells()[1];
        for (row, cell) in cpu.veil.iter().zip(0..) {
            let [x, y] = [cell % across * CELL, cell / across * CELL];
            if x >= lens.width || y >= lens.height {
                continue;
            }
            for (farthest, side) in row.iter().zip(1..=3) {
                let ends = [x, y].map(|at| at + side * CELL);
                let rows =
                    (y..ends[1].min(lens.height)).flat_map(|y| (x..ends[0].min(lens.width)).map(move |x| [x, y]));
                let pixels =
                    rows.map(|[x, y]| image.nears[(lens.first + y * lens.width + x) as usize].load(Relaxed));
                assert_eq!(Some(*farthest), pixels.min(), "drawing {number}, cell {cell}, {side} cells");
                full += u32::from(*farthest > 0);
            }
            assert_eq!(row[3], 0, "nothing hides what is larger");
        }
    }
    assert!(full > 500, "the drawings are empty: {full}");
}

/// What hid a lens's faces does not hide the next one's.
#[test]
fn each_lens_hides_its_own() {
    let gpu = gpu();
    let mut drawing = sheets(3);
    let away = Pose { eye: Vec3::new(0.0, 0.0, -9.0), axes: [Vec3::NEG_X, Vec3::Y, Vec3::NEG_Z] };
    let size = [drawing.eyes[0].width, drawing.eyes[0].height];
    drawing.eyes.push(perspective(&away, [1.0, 1.0], [0.1, 100.0], size, [0.0; 2]));
    let seen = |eyes: &[usize]| {
        let mut stages = GpuRaster::new(&gpu, &Sources::default(), &drawing).expect("kernels");
        let mut cpu = CpuRaster::new(&drawing);
        (stages.portions.fixed, cpu.portions.fixed) = (Some(4), Some(4));
        let pixels = drawing.eyes[0].pixels() as usize;
        let mut on_device = stages.image(pixels, true).expect("an image");
        let Ok(mut image) = cpu.image(pixels, true);
        for eye in eyes.iter().map(|&i| &drawing.eyes[i]) {
            stages.clear(&mut on_device).expect("clear");
            let Ok(()) = cpu.clear(&mut image);
            draw(&mut stages, eye, &mut on_device).expect("a drawing");
            marked(&mut stages, eye, &mut on_device).expect("ids");
            let Ok(()) = draw(&mut cpu, eye, &mut image);
            let Ok(()) = marked(&mut cpu, eye, &mut image);
        }
        let found = stages.seen(&on_device).expect("what is seen");
        assert!(found == image.seen(), "eyes {eyes:?}");
        found
    };
    for order in [[0, 1], [1, 0]] {
        assert!(seen(&order) == seen(&order[1..]), "after another eye, eye {} sees something else", order[1]);
    }
}

/// Faces are divided only where there is much to hide.
#[test]
fn portions_are_as_many_as_layers_ask_for() {
    let pose = Pose { eye: Vec3::ZERO, axes: [Vec3::X, Vec3::Y, Vec3::Z] };
    let eye = |size| perspective(&pose, [1.0, 1.0], [0.1, 100.0], size, [0.0; 2]);
    let layers = |count: u32, deep: f32| {
        let (mut vertices, mut faces) = (Vec::new(), Vec::new());
        for layer in 0..count {
            for i in 0..100_u32 * 100 {
                let at = |k: u32| k as f32 / 50.0 - 1.0;
                let [x, y] = [at(i % 100), at(i / 100)];
                let first = vertices.len() as u32;
                for [x, y] in [[x, y], [x + 0.02, y], [x, y + 0.02], [x + 0.02, y + 0.02]] {
                    let position = Vec3::new(x, y, -1.0) * (deep + layer as f32);
                    vertices.push(Vertex { position, u: 0.0, normal: Vec3::Z, v: 0.0 });
                }
                faces.push(Face { a: first, b: first + 1, c: first + 2, paint: 0 });
                faces.push(Face { a: first + 1, b: first + 3, c: first + 2, paint: 0 });
            }
        }
        Drawing { vertices, faces, ..random_drawing(0) }
    };
    let count = |drawing: &Drawing, size| {
        let portions = CpuRaster::new(drawing).portions(&eye(size));
        assert_eq!((portions[0].start, portions[portions.len() - 1].end), (0, drawing.faces.len() as u32));
        assert!(portions.windows(2).all(|two| two[0].end == two[1].start && !two[0].is_empty()));
        portions.len()
    };
    let size = [301, 203];
    assert_eq!([1, 2, 4, 9].map(|n| count(&layers(n, 2.0), size)), [1, 1, 2, 5]);
    assert_eq!(count(&layers(9, -20.0), size), 1, "behind the eye there is nothing to hide");
    assert_eq!(count(&layers(9, 2.0), [3001, 2003]), 1, "large faces are drawn later");
    let mut odd = layers(4, 2.0);
    odd.vertices.iter_mut().step_by(3).for_each(|v| v.position = Vec3::new(f32::NAN, f32::INFINITY, -1.0));
    assert!(count(&odd, size) <= 2, "what is no number hides nothing");
}

/// Goes on so many times.
struct Times {
    left: usize,
    asked: usize,
}

impl Watch for Times {
    fn done(&mut self, _fraction: f64) -> ControlFlow<()> {
        self.asked += 1;
        if self.asked > self.left { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

/// A stop need not wait for a whole lens.
#[test]
fn portions_can_be_stopped() {
    let drawing = sheets(0);
    let run = |left| {
        let mut cpu = CpuRaster::new(&drawing);
        cpu.portions.fixed = Some(20);
        let mut watch = Times { left, asked: 0 };
        let Ok(film) = frame(&mut cpu, &drawing, &mut watch);
        (watch.asked, film.ids().iter().any(|id| *id != NONE))
    };
    assert_eq!(run(usize::MAX), (20, true));
    assert_eq!(run(5), (6, false));
}

/// What a stage takes is not told as another's, whatever runs after it.
#[test]
fn the_clock_tells_the_same_in_portions() {
    let gpu = gpu();
    let mut drawing = sheets(3);
    while drawing.vertices.len() < 400_000 {
        drawing.vertices.extend_from_within(..);
    }
    let project = |portions| {
        let mut stages = GpuRaster::new(&gpu, &Sources::default(), &drawing).expect("kernels");
        stages.portions.fixed = Some(portions);
        let lens = &drawing.eyes[0];
        let mut image = stages.image(lens.pixels() as usize, true).expect("an image");
        // The first time, lavapipe compiles.
        let times = [(); 4].map(|()| {
            assert!(gpu.measure(true), "lavapipe has a clock");
            draw(&mut stages, lens, &mut image).expect("a drawing");
            stages.seen(&image).expect("what is seen");
            gpu.times().iter().find(|time| time.name == "raster/project").expect("it ran").took
        });
        gpu.measure(false);
        times.into_iter().min().expect("four times")
    };
    let [one, many] = [project(1), project(3)];
    assert!(one < many * 5 && many < one * 5, "{one:?} in one portion, {many:?} in three");
}

#[test]
fn planted_faults_are_seen() {
    let faults = [
        ("raster/far", "y > end", "y >= end"),
        ("raster/far", "min(first.x + $iu, last.x)", "first.x"),
        ("raster/far", "lens.first + y * lens.width * WORDS + WORDS - 1u", "lens.first + y * lens.width * WORDS"),
        ("raster/veil", "min(two, cells[y2 + x2])", "two"),
        ("raster/veil", "let x1 = min(x + 1u, across - 1u)", "let x1 = x"),
        ("raster/veil", "y + 2u", "y + 1u"),
        ("raster/veil", "vec4u(one, two", "vec4u(one, one"),
        ("raster/behind", "0u, cells > 2u", "row.z, cells > 2u"),
        ("raster/behind", "max(further.x, further.y)", "further.x"),
        ("raster/behind", "< far)", "<= far)"),
        ("raster/behind", "nears.most", "nears.least"),
        ("raster/behind", "first.y * lens.columns", "first.x * lens.columns"),
    ];
    let gpu = gpu();
    for (file, right, wrong) in faults {
        let text = Sources::default().get(file).expect("the file").into_owned();
        assert!(text.contains(right), "{file} has no {right}");
        let sources = Sources::default().with(file, text.replace(right, wrong));
        let all = variants(&gpu).map(|v| GpuRaster::of(&gpu, &sources, &sheets(0), v).expect(file));
        let seen = (0..500).any(|number| {
            let drawing = sheets(number);
            let (cpu, wanted) = in_portions(&drawing, 7);
            on_gpu(&all[number as usize % all.len()], &drawing, 7) != (wanted, cpu.veil)
        });
        assert!(seen, "nobody sees {wrong} in {file}");
    }
}
