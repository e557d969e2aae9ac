//! No way in which the work is divided shows in the picture: sizes of workgroups, parts that are bound at once, room.

use twinlight::gpu::wgsl::{FILES, Sources};
use twinlight::gpu::{GpuRaster, Room, Variant};
use twinlight::raster::{Look as _, Raster as _, draw};
use twinlight::tables::{Drawing, Face, Vertex};

use super::gpu;
use super::raster_exact::{on_cpu, random_drawing};

/// Depths and ids, with so much room.
pub(super) fn drawn(kernels: &GpuRaster<'_>, drawing: &Drawing, room: Room) -> [Vec<u32>; 2] {
    let lens = &drawing.eyes[0];
    let mut stages = kernels.again(drawing, room).expect("buffers");
    let mut image = stages.image(lens.pixels() as usize, true).expect("an image");
    stages.clear(&mut image).expect("clear");
    draw(&mut stages, lens, &mut image).expect("a drawing");
    stages.mark(lens, &mut image).expect("mark");
    stages.seen(&image).expect("depths and ids").into()
}

/// Every raster kernel in workgroups of another size.
fn in_groups_of(size: u32) -> Sources {
    let text = |name: &str| Sources::default().get(name).expect("a file").into_owned();
    let slice = text("tables/slice");
    let group = "const GROUP: u32 = 64u;";
    assert!(slice.contains(group), "{slice}");
    let mut sources =
        Sources::default().with("tables/slice", slice.replace(group, &format!("const GROUP: u32 = {size}u;")));
    let mut changed = 0;
    for (name, kernel) in
        FILES.iter().filter(|(name, text)| name.starts_with("raster/") && text.contains("size(64)"))
    {
        sources = sources.with(name, kernel.replace("size(64)", &format!("size({size})")));
        changed += 1;
    }
    assert!(changed >= 6, "{changed} kernels");
    let lanes = |n: u32| text("raster/scan").replace("256", &n.to_string()).replace("255", &(n - 1).to_string());
    sources.with("raster/scan", lanes(size))
}

#[test]
fn the_size_of_workgroups_does_not_show() {
    let gpu = gpu();
    let best = Variant::of(&gpu);
    for (size, rows) in [(1, 1), (8, 2), (32, 4), (128, 8), (256, 16)] {
        for variant in [Variant { rows, ..best }, Variant { rows, ..Variant::PORTABLE }] {
            let kernels = GpuRaster::of(&gpu, &in_groups_of(size), &random_drawing(0), variant).expect("kernels");
            for number in 0..40 {
                let drawing = random_drawing(number);
                let found = drawn(&kernels, &drawing, Room::default());
                assert!(found == on_cpu(&drawing).1, "drawing {number} in groups of {size}, {variant:?}");
            }
        }
    }
}

/// Bindings that hold no more than a few faces, and each list in turn with room for one thing alone.
#[test]
fn parts_and_room_do_not_show() {
    let gpu = gpu();
    let bytes = |faces: usize| (faces * size_of::<Face>()).max(3 * size_of::<Vertex>()) as u64;
    let rooms = [
        Room { binding: bytes(1), ..Room::default() },
        Room { binding: bytes(7), ..Room::default() },
        Room { late: 1, ..Room::default() },
        Room { pieces: 1, ..Room::default() },
        Room { entries: 1, ..Room::default() },
        Room { late: 2, pieces: 3, entries: 5, binding: bytes(9) },
    ];
    for variant in [Variant::of(&gpu), Variant::PORTABLE] {
        let kernels = GpuRaster::of(&gpu, &Sources::default(), &random_drawing(0), variant).expect("kernels");
        for number in 0..60 {
            let drawing = random_drawing(number);
            for room in rooms {
                let found = drawn(&kernels, &drawing, room);
                assert!(found == on_cpu(&drawing).1, "drawing {number} with {room:?}, {variant:?}");
            }
        }
    }
}

/// A list longer than one dispatch draws is drawn in rounds.
#[test]
fn long_lists_are_drawn_to_their_end() {
    let gpu = gpu();
    let text = Sources::default().get("tables/lens").expect("a file").into_owned();
    let most = "const MOST_ENTRIES: u32 = 16384u;";
    assert!(text.contains(most));
    // As if all but the first sixteenth of a round were cut. What is nearest is in the middle: no thread begins with it.
    let short = Sources::default().with("tables/lens", text.replace(most, "const MOST_ENTRIES: u32 = 1024u;"));
    let mut drawing = (0..100).map(random_drawing).find(|d| d.eyes[0].width == 64).expect("one of five");
    (drawing.vertices, drawing.faces) = (Vec::new(), Vec::new());
    drawing.eyes[0].small = 1;
    let position = |x: f32, y: f32, z: f32| glam::Vec3::new(x * z, y * z, -z);
    for i in 0..20_000_u32 {
        let z = 3.9 - ((i + 10_000) % 20_000) as f32 * 1e-4;
        for (x, y) in [(-3.0, -3.0), (3.0, -3.0), (0.0, 3.0)] {
            drawing.vertices.push(Vertex { position: position(x, y, z), u: 0.0, normal: glam::Vec3::Z, v: 0.0 });
        }
        let a = 3 * i;
        drawing.faces.push(Face { a, b: a + 1, c: a + 2, paint: 0 });
    }
    let wanted = on_cpu(&drawing).1;
    assert!(wanted[1].iter().any(|id| (9_000..10_000).contains(id)), "those are seen: {:?}", drawing.eyes[0]);
    for variant in [Variant::of(&gpu), Variant::PORTABLE] {
        let whole = GpuRaster::of(&gpu, &Sources::default(), &drawing, variant).expect("kernels");
        assert!(drawn(&whole, &drawing, Room::default()) == wanted, "{variant:?}");
    }
    let cut = GpuRaster::new(&gpu, &short, &drawing).expect("kernels");
    assert!(drawn(&cut, &drawing, Room::default()) != wanted, "rounds that are too short are seen");
}

/// Workgroups of another size than is counted with, and parts that do not know their place, are seen.
#[test]
fn wrong_divisions_are_seen() {
    let gpu = gpu();
    let faults = [
        ("tables/slice", "GROUP: u32 = 64u", "GROUP: u32 = 128u"),
        ("raster/split", "draw(s, part.first + i)", "draw(s, i)"),
        ("raster/split", "late[at] = part.first + i", "late[at] = i"),
        ("raster/call", "select(0u, (whole + GROUP - 1u) / GROUP, fits)", "(whole + GROUP - 1u) / GROUP"),
    ];
    let rooms = [Room { binding: 200, ..Room::default() }, Room { late: 1, ..Room::default() }, Room::default()];
    for (file, right, wrong) in faults {
        let text = Sources::default().get(file).expect("a file").into_owned();
        assert!(text.contains(right), "{file} has no {right}");
        let sources = Sources::default().with(file, text.replace(right, wrong));
        let kernels = GpuRaster::new(&gpu, &sources, &random_drawing(0)).expect("kernels");
        let seen = (0..200).map(random_drawing).any(|mut drawing| {
            // The faces that count come last, so that they are in another workgroup than the first.
            let none = Face { a: 0, b: 0, c: 0, paint: 0 };
            drawing.faces = [vec![none; 100], drawing.faces].concat();
            rooms.iter().any(|room| drawn(&kernels, &drawing, *room) != on_cpu(&drawing).1)
        });
        assert!(seen, "nobody sees {wrong} in {file}");
    }
}
