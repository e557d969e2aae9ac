//! The stage for scenes of few things, held to the three stages and to its kernel, to the bit.

use twinlight::cpu::trace::CpuTrace;
use twinlight::gpu::GpuTrace;
use twinlight::gpu::wgsl::Sources;
use twinlight::math::Vec3;
use twinlight::scene::{Behavior, Material, Plane, Scene};
use twinlight::tables::{FEW, Slice, Tables};
use twinlight::trace::{Paths, Trace as _, frame};

use super::{gpu, on_cpu, on_gpu, random_scene, root, small, tables_of};

/// Scenes of few things: shipped ones, and random ones without triangles. Odd sizes, so that neither groups nor
/// lanes are full.
fn few() -> Vec<(String, Tables)> {
    let shipped = [("room", 4), ("room", 3), ("room-diffuse", 4), ("room-diffuse", 3)];
    let shipped =
        shipped.map(|(name, n)| (name.to_owned(), small(&root().join(format!("scenes/{name}.toml")), [83, 59], n)));
    let random = (0..30).map(|number| {
        let scene = Scene { triangles: Vec::new(), ..random_scene(number) };
        (format!("random scene {number}"), scene)
    });
    let all = shipped.into_iter().chain(random).map(|(name, scene)| (name, tables_of(&scene)));
    let few: Vec<_> = all.filter(|(_, tables)| tables.few).collect();
    assert!(few.len() >= 20, "only {} scenes of few things", few.len());
    few
}

fn by_three_stages(tables: &Tables) -> Tables {
    Tables { few: false, ..tables.clone() }
}

#[test]
fn eight_at_once_are_the_three_stages() {
    for (name, tables) in few() {
        assert!(on_cpu(&tables) == on_cpu(&by_three_stages(&tables)), "{name}");
    }
}

#[test]
fn the_kernel_makes_the_film_of_the_three_kernels() {
    for (name, tables) in few() {
        let [few, three] = [tables.clone(), by_three_stages(&tables)]
            .map(|tables| on_gpu(&Sources::default(), &tables).unwrap_or_else(|e| panic!("{name}: {e}")));
        assert!(few == three, "{name}");
        assert!(few == on_cpu(&tables), "{name}");
    }
}

#[test]
fn scenes_of_many_things_are_not_few() {
    let mut scene = random_scene(1);
    scene.triangles.clear();
    scene.planes.clear();
    scene.lights.truncate(1);
    scene.spheres = vec![scene.spheres[0].clone(); FEW];
    assert!(tables_of(&scene).few);
    scene.spheres.push(scene.spheres[0].clone());
    assert!(!tables_of(&scene).few);
    assert!(!tables_of(&random_scene(2)).few, "triangles are many");
}

#[test]
fn the_kernel_is_the_twin_slice_by_slice() {
    let gpu = gpu();
    for (name, tables) in few().into_iter().take(8) {
        let samples = tables.samples;
        let count = tables.view.width * tables.view.height;
        let mut cpu = CpuTrace::new(&tables);
        let mut kernel = GpuTrace::new(&gpu, &Sources::default(), &tables).expect("kernels");
        for budget in [2, 5, 9, 200] {
            let slice = Slice { first: 0, count, samples, budget };
            let mut paths = Paths::new(0..count, &tables);
            let mut done = 0;
            let mut slices = 0;
            while done < count {
                let mut there = kernel.upload(&paths).expect("room");
                kernel.few(&mut there, &slice).expect("recorded");
                let pixels = kernel.settle(&mut there).expect("done");
                let Ok(()) = cpu.few(&mut paths, &slice);
                assert_eq!(kernel.status(), cpu.status(), "{name}, budget {budget}, slice {slices}");
                let Ok(twin) = cpu.settle(&mut paths);
                assert_eq!(pixels, twin);
                let back = kernel.download(&there).expect("read");
                assert!(bytes(&back) == bytes(&paths), "{name}, budget {budget}, slice {slices}");
                done += pixels;
                slices += 1;
                assert!(slices < 1000, "it never ends");
            }
        }
    }
}

fn bytes(paths: &Paths) -> [&[u8]; 4] {
    [
        bytemuck::cast_slice(&paths.paths),
        bytemuck::cast_slice(&paths.waiting),
        bytemuck::cast_slice(&paths.sums),
        bytemuck::cast_slice(&paths.ids),
    ]
}

/// Between panes of glass each ray becomes two, down to the last of so many; of those that look down none meets any, if
/// the panes lie above.
fn panes(depth: u32, above: bool) -> Tables {
    let mut scene = random_scene(1);
    scene.resize([9, 7]).expect("a small film");
    (scene.trace.samples, scene.trace.depth, scene.trace.cutoff) = (2, depth, 0.0);
    let glass = Material { behavior: Behavior::Glass, reflect: 0.9, refract: 0.9, ..scene.materials[0].clone() };
    scene.materials = vec![glass];
    scene.triangles.clear();
    scene.spheres.clear();
    let forward = Vec3::NEG_Z;
    let (forward, from) = if above { (Vec3::Y, 1.0) } else { (forward, 0.0) };
    (scene.camera.position, scene.camera.look_at) = (Vec3::ZERO, Vec3::NEG_Z);
    scene.camera.up = Vec3::Y;
    scene.planes = [-1.0, -0.75, -0.5, -0.25, 0.25, 0.5, 0.75, 1.0]
        .map(|far| Plane {
            point: forward * (far + 1.25 * from),
            normal: (-forward).normalize(),
            material: 0,
            tile: 1.0,
        })
        .to_vec();
    tables_of(&scene)
}

#[test]
fn trees_of_more_rays_than_a_slice_takes_are_put_down() {
    let tables = panes(16, false);
    assert!(tables.few);
    let mut asked = 0;
    let mut count = |_: f64| asked += 1;
    let Ok(film) = frame(&mut CpuTrace::new(&tables), &tables, &mut count);
    assert!(asked > 4, "a tree of thousands of rays was not to be stopped: asked {asked} times");
    assert!(film == on_gpu(&Sources::default(), &tables).expect("a film"));
    let three = by_three_stages(&tables);
    let mut asked = 0;
    let mut count = |_: f64| asked += 1;
    let Ok(other) = frame(&mut CpuTrace::new(&three), &three, &mut count);
    assert!(asked > 8, "asked {asked} times");
    assert!(film == other);
    let lit = (0..film.pixels()).filter(|&p| film.color(p).max_element() > 0.0).count();
    assert!(lit > 30, "{lit} pixels have light");
}

#[test]
fn what_is_done_is_counted_once() {
    let tables = panes(16, true);
    assert!(tables.few);
    let film = on_cpu(&tables);
    assert!(film == on_gpu(&Sources::default(), &tables).expect("a film"));
    let samples = |pixel| film.samples(pixel) == tables.samples as f32;
    assert!((0..film.pixels()).all(samples), "pixels that end at once end the others");
}
