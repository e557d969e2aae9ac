//! Faces whose pictures cut holes into them: the same on both sides, and the holes are where the pictures say.

use twinlight::cpu::raster::snap::to_clip;
use twinlight::film::compare::{Standard, compare};
use twinlight::gpu::wgsl::Sources;
use twinlight::gpu::{GpuRaster, Room};
use twinlight::math::Vec2;
use twinlight::scene::load;
use twinlight::tables::{BILINEAR, CUT_OUT, Drawing, MIPMAP, Map, NEAREST, NO_DEPTH, NONE, ONE_SIDED};

use super::raster_exact::{on_cpu, on_gpu, random_drawing, variants};
use super::raster_ways::drawn;
use super::{Dice, gpu, scene_on_cpu, scene_on_gpu};

const SIZE: [u32; 2] = [7, 5];

/// A random drawing whose faces are cut out, all but each third, by a picture of noise.
pub(super) fn laced(number: u32) -> Drawing {
    let mut dice = Dice(number, 17);
    let mut drawing = random_drawing(number);
    for vertex in &mut drawing.vertices {
        (vertex.u, vertex.v) = (dice.within(-2.0, 2.0), dice.within(-2.0, 2.0));
    }
    for (face, i) in drawing.faces.iter_mut().zip(0..) {
        face.paint |= if i % 3 == 0 { 0 } else { CUT_OUT };
    }
    drawing.canvas.filtering = [NEAREST, BILINEAR, MIPMAP][dice.below(3)];
    let first = drawing.texels.len() as u32;
    drawing.texels.extend((0..SIZE[0] * SIZE[1]).map(|_| dice.bits()));
    let [scale, shift] = [3.0, 1.0].map(|reach| dice.point(reach).truncate());
    let [width, height] = SIZE;
    drawing.paints[0].opacity_map = Map { first, width, height, levels: 1, scale, shift };
    drawing
}

/// The opacity of a face at a pixel, in f64 and by intersection with the line of sight; `None` where it is next to a
/// half, or next to a texel's edge.
fn opacity(drawing: &Drawing, id: usize, pixel: usize) -> Option<f64> {
    let lens = &drawing.eyes[0];
    let [width, height] = [lens.width, lens.height].map(|side| side as usize);
    let x = (pixel % width) as f64 + 0.5;
    let y = (pixel / width) as f64 + 0.5;
    let line = [x * 2.0 / width as f64 - 1.0, 1.0 - y * 2.0 / height as f64];
    let face = drawing.faces[id];
    let corners = [face.a, face.b, face.c].map(|i| drawing.vertices[i as usize]);
    let flat = corners.map(|vertex| {
        let c = to_clip(lens, vertex.position).as_dvec4();
        [c.x - line[0] * c.w, c.y - line[1] * c.w]
    });
    let across = |p: [f64; 2], q: [f64; 2]| p[0] * q[1] - p[1] * q[0];
    let areas = [across(flat[1], flat[2]), across(flat[2], flat[0]), across(flat[0], flat[1])];
    let sum: f64 = areas.iter().sum();
    let sure = areas.iter().all(|area| area / sum > 1e-3 && sum.abs() > 1e-9);
    let uv = |of: [f32; 3]| of.iter().zip(areas).map(|(of, area)| f64::from(*of) * area / sum).sum::<f64>();
    let uv = [uv(corners.map(|v| v.u)), uv(corners.map(|v| v.v))];
    let map = drawing.paints[0].opacity_map;
    let (scale, shift): (Vec2, Vec2) = (map.scale, map.shift);
    let at =
        [0, 1].map(|i| (uv[i] * f64::from(scale[i]) + f64::from(shift[i])).rem_euclid(1.0) * f64::from(SIZE[i]));
    let alpha = |x: i64, y: i64| {
        let [column, row] = [x.rem_euclid(i64::from(SIZE[0])), y.rem_euclid(i64::from(SIZE[1]))];
        let row = i64::from(SIZE[1]) - 1 - row;
        let word = drawing.texels[map.first as usize + (row * i64::from(SIZE[0]) + column) as usize];
        f64::from(word >> 24) / 255.0
    };
    let clear = |sure: bool, value: f64| sure.then_some(value);
    if drawing.canvas.filtering == NEAREST {
        let inside = at.iter().all(|at| (at - at.round()).abs() > 1e-3);
        return clear(sure && inside, alpha(at[0] as i64, at[1] as i64));
    }
    let [x, y] = at.map(|at| at - 0.5);
    let (column, row) = (x.floor() as i64, y.floor() as i64);
    let mixed = |p: f64, q: f64, share: f64| p + (q - p) * share;
    let low = mixed(alpha(column, row), alpha(column + 1, row), x - x.floor());
    let high = mixed(alpha(column, row + 1), alpha(column + 1, row + 1), x - x.floor());
    let value = mixed(low, high, y - y.floor());
    clear(sure && (value - 0.5).abs() > 1e-2, value)
}

#[test]
fn cut_out_faces_are_the_same() {
    let gpu = gpu();
    let none = random_drawing(0);
    let all = variants(&gpu).map(|v| GpuRaster::of(&gpu, &Sources::default(), &none, v).expect("kernels"));
    let mut through = 0;
    for number in 0..1000 {
        let drawing = laced(number);
        let kernels = &all[number as usize % all.len()];
        let found = on_gpu(kernels, &drawing, [1024, 1, 3][number as usize % 3]).expect("a drawing");
        let (_, wanted) = on_cpu(&drawing);
        assert!(found == wanted, "drawing {number}");
        if number % 10 == 0 {
            let few = Room { binding: 256, ..Room::default() };
            assert!(drawn(kernels, &drawing, few) == wanted, "drawing {number} in parts");
        }
        let mut whole = drawing.clone();
        for face in &mut whole.faces {
            face.paint &= !CUT_OUT;
        }
        let (_, whole) = on_cpu(&whole);
        through += whole[1].iter().zip(&wanted[1]).filter(|(whole, cut)| whole != cut).count();
    }
    assert!(through > 20_000, "only {through} pixels show what lies behind a hole");
}

/// Each face alone, drawn whole, with the holes cut by other arithmetic.
#[test]
fn holes_are_where_the_pictures_say() {
    let (mut kept, mut cut) = (0, 0);
    for number in 0..150 {
        let drawing = laced(number);
        for (id, face) in drawing.faces.iter().enumerate().filter(|(_, face)| face.paint & CUT_OUT != 0) {
            let alone =
                |paint| Drawing { faces: vec![twinlight::tables::Face { paint, ..*face }], ..drawing.clone() };
            let (_, [whole, _]) = on_cpu(&alone(face.paint & ONE_SIDED));
            let (_, [seen, ids]) = on_cpu(&alone(face.paint));
            for pixel in (0..whole.len()).filter(|&pixel| whole[pixel] != NO_DEPTH) {
                let Some(opacity) = opacity(&drawing, id, pixel) else { continue };
                let there = seen[pixel] != NO_DEPTH;
                assert_eq!(there, opacity >= 0.5, "drawing {number}, face {id}, pixel {pixel}: {opacity}");
                assert_eq!((seen[pixel], ids[pixel]), if there { (whole[pixel], 0) } else { (NO_DEPTH, NONE) });
                *if there { &mut kept } else { &mut cut } += 1;
            }
        }
    }
    assert!(kept > 10_000 && cut > 10_000, "{kept} kept, {cut} cut");
}

#[test]
fn planted_faults_in_holes_are_seen() {
    let faults = [
        ("raster/lace", "now.y > best.y", "now.y < best.y"),
        ("raster/lace", "+ pixel) + 0.5", "+ pixel) + 0.4"),
        ("raster/lace", "k < whole + some", "k < some"),
        ("raster/speck", "select(SMALL, LATE, LACE)", "SMALL"),
        ("raster/speck", "!= 0u) == LACE", "!= 0u) != LACE"),
        ("shade/texture", "texel_of(level, x, y) >> 24u", "texel_of(level, x, y) & 255u"),
        ("shade/texture", "mixed(low, high, up) >= 0.5", "mixed(low, high, up) >= 0.45"),
    ];
    let gpu = gpu();
    for (file, right, wrong) in faults {
        let text = Sources::default().get(file).expect("the file").into_owned();
        assert!(text.contains(right), "{file} has no {right}");
        let sources = Sources::default().with(file, text.replace(right, wrong));
        let all = variants(&gpu).map(|v| GpuRaster::of(&gpu, &sources, &laced(0), v).expect(file));
        let seen = (0..200).any(|number| {
            let drawing = laced(number);
            let kernels = &all[number as usize % all.len()];
            on_gpu(kernels, &drawing, 1024).is_ok_and(|found| found != on_cpu(&drawing).1)
        });
        assert!(seen, "nobody sees {wrong} in {file}");
    }
}

/// A model of one square with a hole in its middle, through which one sees the ground, and light falls onto it.
#[test]
fn a_models_opacity_map_cuts_holes() {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, text: &[u8]| std::fs::write(folder.path().join(name), text).expect("a file");
    let hole = |x: u32, y: u32| if (3..5).contains(&x) && (3..5).contains(&y) { 0_u8 } else { 255 };
    let gray: Vec<u8> = (0..64).map(|i| hole(i % 8, i / 8)).collect();
    let header = [0, 0, 3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 8, 0, 8, 0, 8, 0];
    write("hole.tga", &[header.as_slice(), &gray].concat());
    write("square.mtl", b"newmtl lace\nKd 1 0 0\nmap_d hole.tga\n");
    let obj = "mtllib square.mtl\nv -1 0.5 0\nv 1 0.5 0\nv 1 0.5 -2\nv -1 0.5 -2\nv 0 0 -1\nv 0 0 -1.01\nv 0.01 0 -1\n\
               vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl lace\nf 1/1 2/2 3/3 4/4\n";
    write("square.obj", obj.as_bytes());
    let scene = r#"
method = "raster"
[camera]
position = [0, 4, -1]
look_at = [0, 0, -1]
up = [0, 0, -1]
fov = 40
[film]
size = [81, 81]
[raster]
shadow_size = 512
[[material]]
name = "ground"
color = [0, 1, 0]
[[light.directional]]
toward = [0, 1, 0]
[[object.plane]]
point = [0, 0, 0]
normal = [0, 1, 0]
material = "ground"
[[object.mesh]]
path = "square.obj"
"#;
    write("scene.toml", scene.as_bytes());
    let scene = load(&folder.path().join("scene.toml")).unwrap_or_else(|e| panic!("{e}"));
    let cpu = scene_on_cpu(&scene);
    let gpu = scene_on_gpu(&Sources::default(), &scene).expect("a film");
    assert!(compare(&cpu, &gpu, Standard::Exact).expect("one size").passes());
    let color = |x: u32, y: u32| cpu.color(y * 81 + x);
    let [middle, face] = [color(40, 40), color(30, 30)];
    assert!(middle.y > 0.9 && middle.x == 0.0, "the hole shows the lit ground: {middle}");
    assert!(face.x > 0.9 && face.y == 0.0, "the face beside it is there: {face}");
}
