//! Each kernel against its CPU twin on the same input, so that a failing test names the stage.

use twinlight::cpu::trace::CpuTrace;
use twinlight::gpu::GpuTrace;
use twinlight::gpu::wgsl::Sources;
use twinlight::math::Vec3;
use twinlight::tables::{NONE, Slice, Status, Tables};
use twinlight::trace::{Paths, Trace};

use super::bvh::{deep, scene_of};
use super::{gpu, on_cpu, random_scene, root, small, tables_of};

#[derive(Debug, Clone, Copy)]
enum Stage {
    Cast,
    Follow,
    Gather,
}

const ALL: [Stage; 3] = [Stage::Cast, Stage::Follow, Stage::Gather];

fn run<T: Trace>(stage: Stage, stages: &mut T, paths: &mut T::Paths, slice: &Slice) -> Result<(), T::Error> {
    match stage {
        Stage::Cast => stages.cast(paths, slice),
        Stage::Follow => stages.follow(paths, slice),
        Stage::Gather => stages.gather(paths, slice),
    }
}

/// One stage on the GPU, from host memory and back.
fn kernel(stage: Stage, sources: &Sources, tables: &Tables, input: &Paths, slice: &Slice) -> (Paths, Status) {
    let gpu = gpu();
    let mut stages = GpuTrace::new(&gpu, sources, tables).expect("kernels");
    let mut paths = stages.upload(input).expect("room");
    run(stage, &mut stages, &mut paths, slice).expect("a dispatch");
    stages.settle(&mut paths).expect("work that is done");
    (stages.download(&paths).expect("the paths"), stages.status())
}

fn twin(stage: Stage, tables: &Tables, input: &Paths, slice: &Slice) -> (Paths, Status) {
    let mut stages = CpuTrace::new(tables);
    let mut paths = input.clone();
    let Ok(()) = run(stage, &mut stages, &mut paths, slice);
    (paths, stages.status())
}

/// Follows a scene on the CPU; at every stage the kernel gets the twin's input and must give the twin's output.
pub(super) fn walk_along(tables: &Tables, budget: u32, rounds: u32, what: &str) {
    let count = 143;
    let slice = Slice { first: 40, count, samples: tables.samples, budget };
    let mut paths = Paths::new(40..40 + count, tables);
    for round in 0..rounds {
        for stage in ALL {
            let (expected, status) = twin(stage, tables, &paths, &slice);
            let (got, told) = kernel(stage, &Sources::default(), tables, &paths, &slice);
            for (i, (a, b)) in expected.paths.iter().zip(&got.paths).enumerate() {
                let same = bytemuck::bytes_of(a) == bytemuck::bytes_of(b);
                assert!(same, "{what}, round {round}, {stage:?}, path {i}:\ncpu {a:?}\ngpu {b:?}");
            }
            let [a, b] = [&expected, &got].map(|p| bytemuck::cast_slice::<_, u32>(&p.sums).to_vec());
            assert_eq!(a, b, "{what}, round {round}, {stage:?}, sums");
            let [a, b] = [&expected, &got].map(|p| bytemuck::cast_slice::<_, u32>(&p.squares).to_vec());
            assert_eq!(a, b, "{what}, round {round}, {stage:?}, squares");
            assert_eq!(expected.ids, got.ids, "{what}, round {round}, {stage:?}, ids");
            let [a, b] = [&expected, &got].map(|p| bytemuck::cast_slice::<_, u32>(&p.waiting).to_vec());
            assert_eq!(a, b, "{what}, round {round}, {stage:?}, stacks");
            for (i, path) in expected.paths.iter().enumerate() {
                // Above what a walk has put down, the twin's stack is scratch.
                let size = path.next.saturating_sub(tables.settings.planes + 1) as usize;
                let [a, b] = [&expected, &got].map(|p| &p.walks[i * tables.deep as usize..][..size]);
                assert_eq!(a, b, "{what}, round {round}, {stage:?}, walk {i}");
            }
            assert_eq!(status, told, "{what}, round {round}, {stage:?}, status");
            paths = expected;
        }
    }
}

#[test]
fn stages_of_shipped_scenes_are_the_same() {
    for name in ["room", "room-diffuse", "pyramid", "bust"] {
        let tables = tables_of(&small(&root().join(format!("scenes/{name}.toml")), [41, 27], 4));
        walk_along(&tables, 8000, 5, name);
        walk_along(&tables, 11, 12, name);
    }
}

#[test]
fn stages_of_a_deep_tree_are_the_same() {
    let mut scene = scene_of(&deep());
    scene.resize([41, 27]).expect("a small film fits");
    (scene.camera.position, scene.camera.look_at) = (Vec3::new(1.5, 0.7, 1.1), Vec3::ZERO);
    let tables = tables_of(&scene);
    let seen = on_cpu(&tables).ids().iter().filter(|id| **id != NONE).count();
    assert!(tables.deep > 20 && seen > 300, "{} deep, {seen} seen: that is no test", tables.deep);
    walk_along(&tables, 8000, 4, "a deep tree");
    walk_along(&tables, 11, 12, "a deep tree");
}

#[test]
fn stages_of_random_scenes_are_the_same() {
    for number in 100..112 {
        let tables = tables_of(&random_scene(number));
        walk_along(&tables, 8000, 2, &format!("random scene {number}"));
        walk_along(&tables, 4 + number % 40, 8, &format!("random scene {number}, small budget"));
    }
}
