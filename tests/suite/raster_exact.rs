//! The rasterizer decides the same on both sides, to the bit, and what it decides is right.

use bytemuck::Zeroable as _;
use twinlight::cpu::raster::CpuRaster;
use twinlight::cpu::raster::call::call;
use twinlight::cpu::raster::plan::{area, area_sign};
use twinlight::gpu::wgsl::Sources;
use twinlight::gpu::{Error, Gpu, GpuRaster, Room, Variant};
use twinlight::math::Vec3;
use twinlight::prepare::lens::{Pose, perspective};
use twinlight::raster::{Look as _, Raster, draw, marked};
use twinlight::tables::{Canvas, Drawing, Face, NO_DEPTH, NONE, ONE_SIDED, Paint, Piece, Vertex};

use super::raster_shrink::{shrink, text};
use super::{Dice, gpu};

/// How many drawings are compared.
const DRAWINGS: u32 = 10_000;

/// Triangles of every kind before an eye at the origin that looks along -z.
pub(super) fn random_drawing(number: u32) -> Drawing {
    let mut dice = Dice(number, 1);
    let size = [[33, 17], [64, 48], [1, 1], [100, 7], [48, 80]][dice.below(5)];
    let pose = Pose { eye: Vec3::ZERO, axes: [Vec3::X, Vec3::Y, Vec3::Z] };
    let far = [4.0, 1000.0][dice.below(2)];
    let mut lens = perspective(&pose, [1.0, 0.75], [0.1, far], size, [0.0; 2]);
    let spread = [0.02, 0.3, 3.0, 3000.0][dice.below(4)];
    let mut positions: Vec<Vec3> = Vec::new();
    for _ in 0..3 + dice.below(24) {
        let p = match dice.below(8) {
            // On the near plane, behind the eye, far off, on a grid, again.
            0 => Vec3::new(dice.within(-1.0, 1.0), dice.within(-1.0, 1.0), -0.1),
            1 => dice.point(2.0),
            2 => dice.point(1.0) * spread,
            // A pixel's very center.
            3 => {
                let at = |n: usize, side: u32| (n as f32 + 0.5) * 2.0 / side as f32 - 1.0;
                let few = |side: u32| (side / 2) as usize..side as usize;
                let [x, y] = size.map(|side| at(few(side).start + dice.below(few(side).len().min(4)), side));
                Vec3::new(x * 2.0, y * 1.5, -2.0)
            }
            4 if !positions.is_empty() => positions[dice.below(positions.len())] + dice.point(0.01),
            _ => dice.point(1.0) * Vec3::new(2.0, 2.0, 1.4) - Vec3::Z * 1.7,
        };
        positions.push(p);
    }
    let vertices: Vec<_> =
        positions.iter().map(|&position| Vertex { position, u: 0.0, normal: Vec3::Z, v: 0.0 }).collect();
    let mut corner = || dice.below(positions.len()) as u32;
    let mut faces: Vec<_> =
        (0..20).map(|i| Face { a: corner(), b: corner(), c: corner(), paint: i % 2 * ONE_SIDED }).collect();
    // Coincident faces: the lower number wins.
    faces.push(faces[3]);
    faces.push(Face { a: faces[5].b, b: faces[5].c, c: faces[5].a, paint: faces[5].paint });
    lens.cull = number % 2;
    lens.small = [16, 1, 64, 5][dice.below(4)];
    if number.is_multiple_of(3) {
        lens.slope = 200;
    } else if number.is_multiple_of(7) {
        // More than there is of depth.
        lens.slope = 1 << 15;
    }
    Drawing {
        eyes: vec![lens],
        most: u32::MAX,
        lenses: Vec::new(),
        canvas: Canvas::zeroed(),
        vertices,
        faces,
        paints: vec![Paint::zeroed()],
        lamps: Vec::new(),
        texels: vec![0; 256],
    }
}

pub(super) fn on_cpu(drawing: &Drawing) -> (CpuRaster<'_>, [Vec<u32>; 2]) {
    drawn_by(CpuRaster::new(drawing), drawing)
}

pub(super) fn drawn_by<'a>(mut cpu: CpuRaster<'a>, drawing: &Drawing) -> (CpuRaster<'a>, [Vec<u32>; 2]) {
    let lens = &drawing.eyes[0];
    let Ok(mut image) = cpu.image(lens.pixels() as usize, true);
    let Ok(()) = draw(&mut cpu, lens, &mut image);
    let Ok(()) = marked(&mut cpu, lens, &mut image);
    let Ok(()) = cpu.sift(lens, &image);
    let (depths, ids) = image.seen();
    (cpu, [depths, ids])
}

/// What a GPU draws, with each stage's output beside the CPU's.
pub(super) fn on_gpu(kernels: &GpuRaster<'_>, drawing: &Drawing, room: usize) -> Result<[Vec<u32>; 2], Error> {
    let lens = &drawing.eyes[0];
    let mut stages = kernels.again(drawing, Room { late: room, pieces: room, entries: room, ..Room::default() })?;
    stages.portions.fixed = Some(1 + room as u32 % 4);
    let mut image = stages.image(lens.pixels() as usize, true)?;
    stages.clear(&mut image)?;
    draw(&mut stages, lens, &mut image)?;
    marked(&mut stages, lens, &mut image)?;
    let (depths, ids) = stages.seen(&image)?;
    Ok([depths, ids])
}

/// Every variant of the kernels that the adapter has, the one in use first.
pub(super) fn variants(gpu: &Gpu) -> [Variant; 5] {
    let best = Variant::of(gpu);
    assert!(best.wide && best.subgroups, "lavapipe has both: {best:?}");
    [
        best,
        Variant::PORTABLE,
        Variant { wide: false, ..best },
        Variant { subgroups: false, rows: 4, ..best },
        Variant { subgroups: true, rows: 1, ..Variant::PORTABLE },
    ]
}

fn sorted<T: bytemuck::Pod>(all: &[T]) -> Vec<Vec<u32>> {
    let mut all: Vec<_> = all.iter().map(|one| bytemuck::cast_slice(std::slice::from_ref(one)).to_vec()).collect();
    all.sort_unstable();
    all
}

#[test]
fn raster_stages_are_the_same() {
    let gpu = gpu();
    let kernels = GpuRaster::new(&gpu, &Sources::default(), &random_drawing(0)).expect("kernels");
    for number in 0..40 {
        let drawing = random_drawing(number);
        let lens = &drawing.eyes[0];
        let (cpu, _) = on_cpu(&drawing);
        let mut stages = kernels.again(&drawing, Room::default()).expect("buffers");
        let mut image = stages.image(lens.pixels() as usize, true).expect("an image");
        stages.project(lens).expect("project");
        stages.split(lens, &mut image, false, 0..stages.faces()).expect("split");
        let told = stages.told().expect("told");
        assert_eq!(stages.corners().expect("corners"), cpu.corners, "project, drawing {number}");
        let late = gpu.read(&stages.late).expect("late");
        let torn = &late[late.len() - told.late[1] as usize..];
        assert_eq!(
            sorted(&[&late[..told.late[0] as usize], torn].concat()),
            sorted(&cpu.late),
            "split, drawing {number}"
        );
        stages.cut(lens).expect("cut");
        let told = stages.told().expect("told");
        let pieces = gpu.read(&stages.pieces).expect("pieces");
        let pieces = &pieces[..told.pieces as usize];
        assert_eq!(sorted(pieces), sorted(&cpu.pieces), "cut, drawing {number}");
        stages.count(lens).expect("count");
        stages.told().expect("told");
        assert_eq!(gpu.read(&stages.counts).expect("counts"), cpu.counts, "count, drawing {number}");
        stages.scan(lens).expect("scan");
        let told = stages.told().expect("told");
        assert_eq!(gpu.read(&stages.starts).expect("starts"), cpu.starts, "scan, drawing {number}");
        let busy = gpu.read(&stages.busy).expect("busy");
        assert_eq!(sorted(&busy[..told.busy as usize]), sorted(&cpu.busy), "busy tiles, drawing {number}");
        assert_eq!((told.entries, told.longest), (cpu.tally.entries, cpu.tally.longest));
        let calls = gpu.read(stages.calls()).expect("calls");
        assert_eq!(calls, call(&told, [late.len() as u32, pieces.len() as u32]), "call, drawing {number}");
        stages.fill(lens).expect("fill");
        stages.told().expect("told");
        let entries = gpu.read(&stages.entries).expect("entries");
        for (tile, ends) in cpu.starts.windows(2).enumerate() {
            let range = ends[0] as usize..ends[1] as usize;
            let list = |entries: &[u32], pieces: &[Piece]| {
                sorted(&entries[range.clone()].iter().map(|&i| pieces[i as usize]).collect::<Vec<_>>())
            };
            assert_eq!(
                list(&entries, pieces),
                list(&cpu.entries, &cpu.pieces),
                "fill, list {tile}, drawing {number}"
            );
        }
        // What is drawn twice stays what it is.
        draw(&mut stages, lens, &mut image).expect("cover");
        stages.sift(lens, &image).expect("sift");
        let told = stages.told().expect("told");
        let runs = gpu.read(&stages.runs).expect("runs");
        let [shown, bare] = [&runs[..told.shown as usize], &runs[runs.len() - told.bare as usize..]];
        assert_eq!([sorted(shown), sorted(bare)], [0, 1].map(|i| sorted(&cpu.runs[i])), "sift, drawing {number}");
        let calls = gpu.read(stages.calls()).expect("calls");
        assert_eq!(calls[4..], call(&told, [0; 2])[4..], "call after sift, drawing {number}");
    }
}

#[test]
fn raster_decides_the_same() {
    let gpu = gpu();
    let none = random_drawing(0);
    let all = variants(&gpu).map(|v| GpuRaster::of(&gpu, &Sources::default(), &none, v).expect("kernels"));
    let mut drawn = 0;
    for number in 0..DRAWINGS {
        let drawing = random_drawing(number);
        let room = [1024, 1, 3][number as usize % 3];
        let kernels = &all[number as usize % all.len()];
        let found = on_gpu(kernels, &drawing, room).unwrap_or_else(|e| panic!("{number}: {e}"));
        let (_, wanted) = on_cpu(&drawing);
        if found != wanted {
            let fails = |d: &Drawing| on_gpu(kernels, d, room).is_ok_and(|found| found != on_cpu(d).1);
            panic!("drawing {number} differs, and so does this one:\n{}", text(&shrink(&drawing, fails)));
        }
        drawn += wanted[1].iter().filter(|id| **id != NONE).count();
        assert!(wanted[0].iter().zip(&wanted[1]).all(|(d, id)| (*d == NO_DEPTH) == (*id == NONE)));
    }
    assert_eq!(gpu.complaint(), None);
    assert!(drawn > 50_000, "the drawings are empty: {drawn}");
}

#[test]
fn order_and_division_do_not_show() {
    for number in 0..300 {
        let drawing = random_drawing(number);
        let (_, wanted) = on_cpu(&drawing);
        for small in [1, 5, 16, 64] {
            let mut other = drawing.clone();
            other.eyes[0].small = small;
            assert_eq!(on_cpu(&other).1[1], wanted[1], "drawing {number} with {small}");
        }
        // Other numbers for the same faces, drawn in another order.
        let mut turned = drawing.clone();
        turned.faces.reverse();
        let last = drawing.faces.len() as u32 - 1;
        let (_, found) = on_cpu(&turned);
        assert_eq!(found[0], wanted[0], "depths of drawing {number} in reverse");
        for (f, w) in found[1].iter().zip(&wanted[1]) {
            assert_eq!(*f == NONE, *w == NONE);
            assert!(*f == NONE || last - f >= *w, "the lower number wins");
        }
    }
}

/// Every pixel against every triangle, in 128 bits and from the definition.
#[test]
fn brute_force_covers_the_same() {
    for number in 0..400 {
        let drawing = random_drawing(number);
        let lens = &drawing.eyes[0];
        let (cpu, [_, ids]) = on_cpu(&drawing);
        let corner = |vertex: u32| cpu.corners[vertex as usize];
        let whole = drawing.faces.iter().filter(|f| [f.a, f.b, f.c].iter().all(|&i| corner(i).code == 0));
        let triangles: Vec<_> = whole
            .filter_map(|f| {
                let [p, q, r] = [f.a, f.b, f.c].map(|i| corner(i).at);
                let turn = area_sign(area(p, q, r));
                let hidden = lens.cull == 1 && f.paint & ONE_SIDED != 0 && turn > 0;
                (turn != 0 && !hidden).then_some(if turn > 0 { [p, q, r] } else { [p, r, q] })
            })
            .chain(cpu.pieces.iter().map(|p| [p.a, p.b, p.c]))
            .collect();
        for (pixel, id) in (0..lens.pixels()).zip(&ids) {
            let at = [i128::from(pixel % lens.width) * 256 + 128, i128::from(pixel / lens.width) * 256 + 128];
            let covered = triangles.iter().any(|t| {
                (0..3).all(|i| {
                    let (p, q) = (t[i], t[(i + 1) % 3]);
                    let (a, b) = (i128::from(p.y - q.y), i128::from(q.x - p.x));
                    let e = a * (at[0] - i128::from(p.x)) + b * (at[1] - i128::from(p.y));
                    e > 0 || (e == 0 && (a > 0 || (a == 0 && b > 0)))
                })
            });
            assert_eq!(covered, *id != NONE, "drawing {number}, pixel {pixel}");
        }
    }
}

/// A closed sheet of triangles covers every pixel once, though its corners are anywhere and some are clipped.
#[test]
fn sheets_have_no_gap_and_no_double_hit() {
    for number in 0..60 {
        let mut dice = Dice(number, 2);
        let pose = Pose { eye: Vec3::ZERO, axes: [Vec3::X, Vec3::Y, Vec3::Z] };
        let mut lens = perspective(&pose, [1.0, 1.0], [0.1, 100.0], [96, 96], [0.0; 2]);
        lens.small = [1, 16][number as usize % 2];
        // Tilted so that a part of it lies before the near plane; its rim is far off the film.
        let tilt = dice.within(-0.8, 0.8);
        let side = 6;
        let vertices: Vec<_> = (0..side * side)
            .map(|i| {
                let rim = |k: u32| if k == 0 || k == side - 1 { 500.0 } else { 3.0 };
                let (column, row) = (i % side, i / side);
                let x = (column as f32 - 2.5) * rim(column) + dice.within(-1.0, 1.0);
                let y = (row as f32 - 2.5) * rim(row) + dice.within(-1.0, 1.0);
                let position = Vec3::new(x, y, -4.0 + tilt * y.clamp(-40.0, 40.0));
                Vertex { position, u: 0.0, normal: Vec3::Z, v: 0.0 }
            })
            .collect();
        let mut faces = Vec::new();
        for i in (0..side * side).filter(|i| i % side < side - 1 && i / side < side - 1) {
            faces.push(Face { a: i, b: i + 1, c: i + side, paint: 0 });
            faces.push(Face { a: i + 1, b: i + side + 1, c: i + side, paint: 0 });
        }
        let mut drawing = Drawing { eyes: vec![lens], vertices, faces: Vec::new(), ..random_drawing(0) };
        let mut hits = vec![0_u32; lens.pixels() as usize];
        for face in &faces {
            drawing.faces = vec![*face];
            for (hit, id) in hits.iter_mut().zip(&on_cpu(&drawing).1[1]) {
                *hit += u32::from(*id != NONE);
            }
        }
        assert!(hits.iter().all(|h| *h <= 1), "drawing {number}: a pixel is hit twice");
        drawing.faces = faces;
        // Rows of pixels are covered from one end to the other, where the sheet is before the near plane's line.
        if tilt.abs() < 0.1 {
            assert!(hits.iter().all(|h| *h == 1), "drawing {number} has a gap");
        }
    }
}

#[test]
fn area_is_exact() {
    let mut dice = Dice(5, 5);
    for _ in 0..100_000 {
        let reach = 1 << (1 + dice.below(21));
        let mut point = || {
            let mut part = || (dice.bits() % (2 * reach + 1)) as i32 - reach as i32;
            glam::IVec3::new(part(), part(), 0)
        };
        let (p, q, r) = (point(), point(), point());
        let parts = area(p, q, r).as_i64vec3();
        let [u, v] = [(q - p).as_i64vec3(), (r - p).as_i64vec3()];
        assert_eq!((parts.x << 24) + (parts.y << 12) + parts.z, u.x * v.y - u.y * v.x);
        assert_eq!(i64::from(area_sign(area(p, q, r))), (u.x * v.y - u.y * v.x).signum());
    }
}
