//! A film is drawn in windows, of regions if it is large; neither can be seen in it.

use std::ops::{ControlFlow, Range};

use twinlight::cpu::raster::CpuRaster;
use twinlight::film::{Film, Watch};
use twinlight::gpu::GpuRaster;
use twinlight::gpu::wgsl::Sources;
use twinlight::math::Vec3;
use twinlight::prepare::draw;
use twinlight::raster::{bands, frame, part};
use twinlight::scene::{Method, Show};
use twinlight::tables::{Drawing, NONE, REGION};

use super::raster_exact::{drawn_by, on_cpu as drawn, random_drawing};
use super::raster_frames::painted;
use super::raster_lace::laced;
use super::{Dice, gpu, on_cpu, random_scene, tables_of};

fn whole(drawing: &Drawing) -> Film {
    let Ok(film) = frame(&mut CpuRaster::new(drawing), drawing, &mut |_| ());
    film
}

fn piece(drawing: &Drawing, rectangle: &[Range<u32>; 2]) -> Film {
    let Ok(film) = part(&mut CpuRaster::new(drawing), drawing, rectangle, &mut |_| ());
    film
}

/// The sum and the id of every pixel, row by row, within a rectangle.
fn pixels(film: &Film, [columns, rows]: &[Range<u32>; 2]) -> Vec<([u32; 3], u32)> {
    let all = rows.clone().flat_map(|y| columns.clone().map(move |x| y * film.width() + x));
    all.map(|p| (film.color(p).to_array().map(f32::to_bits), film.id(p))).collect()
}

fn all(film: &Film) -> [Range<u32>; 2] {
    [0..film.width(), 0..film.height()]
}

#[test]
fn windows_do_not_show_on_both_sides() {
    let gpu = gpu();
    for number in 0..8 {
        let drawing = draw(&painted(number));
        let wanted = whole(&drawing);
        for most in [200, 70, 13] {
            let drawing = Drawing { most, ..drawing.clone() };
            assert!(drawing.windows(&all(&wanted)).len() > 2);
            assert!(whole(&drawing) == wanted, "scene {number} in windows of {most} pixels on the CPU");
            let mut stages = GpuRaster::new(&gpu, &Sources::default(), &drawing).expect("kernels");
            let found = frame(&mut stages, &drawing, &mut |_| ()).expect("a film");
            assert!(found == wanted, "scene {number} in windows of {most} pixels on the GPU");
        }
    }
}

#[test]
fn a_rectangle_is_what_it_is_in_the_whole() {
    for number in 0..20 {
        let drawing = Drawing { most: [u32::MAX, 50][number as usize % 2], ..draw(&painted(number)) };
        let film = whole(&drawing);
        for rectangle in [[0..film.width(), 3..4], [5..6, 0..film.height()], [7..29, 2..21]] {
            let found = piece(&drawing, &rectangle);
            assert_eq!([found.width(), found.height()], [0, 1].map(|i| rectangle[i].len() as u32));
            assert!(pixels(&found, &all(&found)) == pixels(&film, &rectangle), "scene {number}: {rectangle:?}");
        }
    }
}

/// A band of a rectangle is one window, however narrow the rectangle: what the whole film's windows are is no matter.
#[test]
fn windows_are_cut_from_the_rectangle() {
    let gpu = gpu();
    for number in 0..4 {
        let drawing = draw(&painted(number));
        let film = whole(&drawing);
        for (columns, rows) in [(7..27, 2), (3..9, 9), (30..31, 23), (0..31, 5)] {
            let drawing = Drawing { most: columns.len() as u32 * rows, ..drawing.clone() };
            let band = [columns.clone(), 0..rows];
            assert_eq!(drawing.windows(&band).len(), 1, "{band:?}");
            let rectangle = [columns, 0..23];
            let wanted = pixels(&film, &rectangle);
            let found = piece(&drawing, &rectangle);
            assert!(pixels(&found, &all(&found)) == wanted, "scene {number}: {band:?} on the CPU");
            let mut stages = GpuRaster::new(&gpu, &Sources::default(), &drawing).expect("kernels");
            let found = part(&mut stages, &drawing, &rectangle, &mut |_| ()).expect("a film");
            assert!(pixels(&found, &all(&found)) == wanted, "scene {number}: {band:?} on the GPU");
        }
    }
    assert_eq!(gpu.complaint(), None, "wgpu complained");
}

/// The ray tracer knows of no regions, and sees the same on both sides of their seam.
#[test]
fn regions_do_not_show() {
    let seam = REGION..REGION + 300;
    let mut scene = random_scene(3);
    scene.method = Method::Raster;
    scene.resize([2 * REGION, 24]).expect("it fits");
    scene.camera.aspect = Some(2.0);
    (scene.spheres, scene.planes) = (Vec::new(), Vec::new());
    (scene.camera.position, scene.camera.look_at) = (Vec3::Z * 9.0, Vec3::ZERO);
    let mut dice = Dice(1, 17);
    for triangle in &mut scene.triangles {
        triangle.vertices = [(); 3].map(|()| dice.point(1.0) * Vec3::new(9.0, 5.0, 3.0));
    }
    (scene.trace.samples, scene.raster.samples, scene.raster.shadow_size) = (1, 1, 128);
    let drawing = draw(&scene);
    assert_eq!((drawing.eyes.len(), drawing.film()), (2, scene.film.size));
    let drawn = whole(&drawing);
    let traced = on_cpu(&tables_of(&scene));
    let width = drawn.width();
    for columns in [seam.start - 300..seam.start, seam] {
        let all = (0..24).flat_map(|y| columns.clone().map(move |x| y * width + x));
        // The tracer's first sample lies at the pixel's corner, half a pixel off.
        let near = |p: u32| [p, p + 1, p - 1, p + width, p.wrapping_sub(width)];
        let met = |p: u32| near(p).iter().any(|&q| q < traced.pixels() && traced.id(q) == drawn.id(p));
        let differ = all.clone().filter(|&p| !met(p)).count();
        let seen = all.filter(|&p| drawn.id(p) != NONE).count();
        assert!(seen > 2000, "an empty picture proves nothing: {seen}");
        assert!(differ * 30 < seen, "{differ} of {seen}");
    }
    let stages_of = |most| {
        let drawing = Drawing { most, ..drawing.clone() };
        let gpu = gpu();
        let mut stages = GpuRaster::new(&gpu, &Sources::default(), &drawing).expect("kernels");
        frame(&mut stages, &drawing, &mut |_| ()).expect("a film")
    };
    assert!(stages_of(1 << 16) == drawn && stages_of(u32::MAX) == drawn);
}

/// A window that begins a pixel late, and a region whose middle is a pixel off, are seen by the comparisons above.
#[test]
fn shifted_windows_are_seen() {
    let gpu = gpu();
    let faults = [
        ("raster/snap", "% REGION) * 256", "% REGION) * 255"),
        ("raster/shade", "let start = vec2u(lens.left, lens.top) % REGION", "let start = vec2u(0u) + lens.zero"),
    ];
    for (file, right, wrong) in faults {
        let text = Sources::default().get(file).expect("the file").into_owned();
        assert!(text.contains(right), "{file} has no {right}");
        let sources = Sources::default().with(file, text.replace(right, wrong));
        let seen = (0..4).any(|number| {
            let drawing = Drawing { most: 200, ..draw(&painted(number)) };
            let mut stages = GpuRaster::new(&gpu, &sources, &drawing).expect("kernels");
            frame(&mut stages, &drawing, &mut |_| ()).expect("a film") != whole(&drawing)
        });
        assert!(seen, "nobody sees {wrong} in {file}");
    }
}

#[test]
fn portions_of_faces_do_not_show() {
    let mut several = 0;
    for number in 0..400 {
        let drawing = if number % 2 == 0 { random_drawing(number) } else { laced(number) };
        let (cpu, wanted) = drawn(&drawing);
        several += usize::from(cpu.late.len() > 1);
        for at_once in [1, 9000] {
            let mut stages = CpuRaster::new(&drawing);
            stages.at_once = at_once;
            let (_, found) = drawn_by(stages, &drawing);
            assert!(found == wanted, "drawing {number}, {at_once} bytes of faces at once");
        }
    }
    assert!(several > 200, "{several} have faces for several portions");
    for number in 0..20 {
        let mut scene = painted(number);
        scene.raster.show = Show::Tiles;
        let drawing = draw(&scene);
        let mut stages = CpuRaster::new(&drawing);
        stages.at_once = 1;
        let Ok(film) = frame(&mut stages, &drawing, &mut |_| ());
        assert!(film == whole(&drawing), "faces in the tiles of scene {number}");
    }
}

/// Stops when it is asked for the second time.
struct Second(u32);

impl Watch for Second {
    fn done(&mut self, fraction: f64) -> ControlFlow<()> {
        assert!(fraction < 1.0, "it is done");
        self.0 += 1;
        if self.0 == 2 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

#[test]
fn a_lens_is_stopped_between_portions() {
    let drawings = (0..40).map(|number| {
        let mut drawing = draw(&painted(number));
        drawing.take_one_sample();
        drawing
    });
    let many = |drawing: &Drawing| drawn(drawing).0.late.len() > 3;
    let mut drawing = drawings.into_iter().find(many).expect("a drawing of some large faces");
    drawing.lenses.clear();
    drawing.lamps.iter_mut().for_each(|lamp| lamp.lens = NONE);
    let mut stages = CpuRaster::new(&drawing);
    stages.at_once = 1;
    let mut second = Second(0);
    let rectangle = drawing.film().map(|side| 0..side);
    let Ok(()) = bands(&mut stages, &drawing, &rectangle, u32::MAX, &mut second, &mut |_| panic!("a film"));
    assert_eq!(second.0, 2, "asked within the only lens");
    // Nothing is left over for the next frame.
    stages.at_once = usize::MAX;
    let Ok(film) = frame(&mut stages, &drawing, &mut |_| ());
    assert!(film == whole(&drawing));
}
