//! Faults planted in kernels and tables: each must be seen by the comparison that the frames are held to.

use twinlight::film::compare::{Standard, compare};
use twinlight::gpu::Wanted;
use twinlight::gpu::wgsl::Sources;
use twinlight::render::{Backend, Renderer};
use twinlight::scene::Method;

use super::{on_cpu, on_gpu, root, small, tables_of};

/// File, what stands there, what is planted, and the scene that must show it.
const FAULTS: &[(&str, &str, &str, &str)] = &[
    ("trace/primary", "view.height - 1u - row", "row", "room"),
    ("trace/primary", "row * grid", "row", "room"),
    ("trace/cast", "slice.first + i", "slice.first + i + 1u", "room"),
    ("trace/meet", "dot(e, e) - r2", "dot(e, e) - r2 * 1.0001", "room"),
    ("trace/meet", "b > 0.0", "b < 0.0", "room"),
    ("trace/meet", "plane.point - ray.origin", "plane.point + ray.origin", "room"),
    ("trace/triangle", "e.z * c.z", "e.z * b.z", "pyramid"),
    ("trace/boxes", "enter <= leave", "enter * 1.01 <= leave", "bust"),
    ("trace/boxes", "back.y);\n    let near_z", "!back.y);\n    let near_z", "bust"),
    ("trace/walk", "held & ~met & (met - 1u)", "held & (met - 1u)", "bust"),
    ("trace/aim", "<< own_bits[1]", "<< own_bits[0]", "bust"),
    ("trace/walk", "t < walk.t ||", "t <= walk.t * 1.001 ||", "bust"),
    ("trace/aim", "d.x / d.z", "d.x * d.z", "bust"),
    ("trace/surface", "normal = -normal", "normal = normal", "pyramid"),
    ("trace/scatter", "material.index, inside == 1u", "material.index, inside == 0u", "pyramid"),
    ("trace/scatter", "root < 0.0", "root < 0.3", "pyramid"),
    ("trace/scatter", "1u - inside", "inside", "room"),
    ("trace/scatter", "select(free, -free, cosine < 0.0)", "free", "room-diffuse"),
    ("trace/tree", "branch.weight;", "branch.weight * 0.999999;", "room"),
    ("math/vector", "2.0 * dot(i, n)", "1.99999 * dot(i, n)", "room"),
    ("math/power", "0.69314718", "0.69314", "room"),
    ("math/random", "1664525u", "1664527u", "room-diffuse"),
    ("math/sphere", "1.0 - 2.0 * a", "1.0 - 1.9999 * a", "room-diffuse"),
    ("shade/phong", "SPECULAR == BLINN", "SPECULAR != BLINN", "room"),
    ("trace/few", "(*path).sample == 0u", "(*path).sample == 1u", "room"),
    ("trace/few", "(*path).depth + 1u", "(*path).depth", "room"),
    ("trace/unrolled", "t < found.t", "t <= found.t * 1.001", "room"),
    ("trace/unrolled", "ray.leaves == $iu)", "false)", "room"),
    ("trace/unrolled", "number == $iu", "number != $iu", "room"),
];

const FEW_FILES: [&str; 2] = ["trace/few", "trace/unrolled"];

#[test]
fn planted_faults_in_kernels_are_seen() {
    for (file, from, to, scene) in FAULTS {
        let text = Sources::default().get(file).unwrap_or_else(|| panic!("no file {file}")).into_owned();
        assert!(text.contains(from), "{file} no longer has {from:?}: plant another fault");
        let sources = Sources::default().with(file, text.replace(from, to));
        let mut tables = tables_of(&small(&root().join(format!("scenes/{scene}.toml")), [61, 43], 4));
        // The stage for few things is a kernel of its own.
        tables.few = FEW_FILES.contains(file);
        // A fault may also make the work never end or be cut: that is seen too.
        let seen = on_gpu(&sources, &tables)
            .map_or(true, |gpu| !compare(&on_cpu(&tables), &gpu, Standard::Exact).expect("one size").passes());
        assert!(seen, "{file}: {to:?} for {from:?} goes unnoticed");
    }
}

#[test]
fn a_gpu_that_fails_is_left_for_the_cpu_with_a_sentence() {
    let scene = small(&root().join("scenes/pyramid.toml"), [31, 17], 2);
    let text = Sources::default().get("trace/gather").expect("a file").replace("sums[i] +=", "sums[i] =");
    let broken = Sources::default().with("trace/gather", text);
    let render = |backend| {
        // A device of its own: this one is to be given up.
        let renderer = Renderer::open(backend, &Wanted::Software).unwrap_or_else(|e| panic!("{e}"));
        renderer.with_sources(broken.clone()).render(&scene, Method::Trace, &mut |_| ())
    };
    let _one_device_at_a_time = super::gpu();
    let rendered = render(Backend::Auto).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(rendered.by, "CPU");
    let [note] = &rendered.notes[..] else { panic!("{:?}", rendered.notes) };
    assert!(note.contains("has 1 of 2 samples") && note.ends_with("rendering on the CPU instead"), "{note}");
    assert!(rendered.film == on_cpu(&tables_of(&scene)));
    assert!(render(Backend::Gpu).is_err(), "where the GPU alone is allowed, there is no picture");
}

#[test]
fn shuffled_lists_are_seen() {
    let scene = small(&root().join("scenes/room.toml"), [61, 43], 1);
    let tables = tables_of(&scene);
    let expected = on_cpu(&tables);
    let mut shuffled = [tables.clone(), tables.clone(), tables.clone()];
    shuffled[0].spheres.swap(0, 1);
    shuffled[1].materials.swap(2, 4);
    shuffled[2].lights.swap(0, 1);
    shuffled[2].lights[0].power *= 1.01;
    for (i, tables) in shuffled.iter().enumerate() {
        let gpu = on_gpu(&Sources::default(), tables).expect("a film");
        assert!(!compare(&expected, &gpu, Standard::Exact).expect("one size").passes(), "shuffle {i}");
    }
}

#[test]
fn a_kernel_that_does_nothing_is_seen() {
    let text = Sources::default().get("trace/gather").expect("a file").replace("sums[i] +=", "sums[i] =");
    let sources = Sources::default().with("trace/gather", text);
    let mut tables = tables_of(&small(&root().join("scenes/room.toml"), [31, 17], 4));
    tables.few = false;
    let made = on_gpu(&sources, &tables);
    assert!(matches!(made, Err(twinlight::gpu::Error::Incomplete(_))), "{:?}", made.map(|_| "a film"));
}
