//! Faults planted in the rasterizer's kernels are seen.

use twinlight::gpu::wgsl::Sources;
use twinlight::gpu::{Error, GpuRaster};

use super::gpu;
use super::raster_exact::{on_cpu, on_gpu, random_drawing, variants};

/// Each by a comparison of depths and ids.
#[test]
fn planted_faults_are_seen() {
    let faults = [
        ("raster/plan", "a > 0 || (a == 0 && b > 0)", "a >= 0"),
        ("raster/plan", "select(-1, 0, owned(a, b))", "0"),
        ("raster/speck", "select(-1, 0, owned(a, b))", "0"),
        ("raster/plan", "high < -4194304", "high < -20"),
        ("raster/plan", "vec2i(127)", "vec2i(128)"),
        ("raster/clip", "meet(next, here, plane)", "meet(here, next, plane)"),
        ("raster/pixels", "(near == old.near) & (vec4u(id) > old.id)", "(near == old.near)"),
        ("raster/pixels", "vec4u(p.yw, q.yw)", "vec4u(p.yw, q.wy)"),
        ("raster/pixels", "quad.near[$i] = p_$i.x", "quad.near[$i] = p_0.x"),
        ("raster/pixels", "at += n.y * STRIDE", "at += n.x * STRIDE"),
        ("raster/reach", "(min(r.a, vec3i(0)) + min(r.b, vec3i(0)))", "(max(r.a, vec3i(0)) + min(r.b, vec3i(0)))"),
        ("raster/mark", "NONE - id", "id"),
        ("raster/facet", "turn > 0", "turn < 0"),
        ("raster/speck", "turn > 0", "turn < 0"),
        ("raster/speck", "min(left.x, 7)", "min(left.x, 6)"),
        ("raster/speck", "y > last", "y >= last"),
        ("raster/speck", "block.x + 8 > s.last.x", "block.x + 9 > s.last.x"),
        ("raster/split", "u64(NONE - id)", "u64(id)"),
        ("raster/cover", "batch + k >= next", "batch + k + 1u >= next"),
        ("raster/cut", "row <= under.w", "row < under.w"),
        ("raster/fill", "starts[list]", "starts[list ^ 1u]"),
        ("raster/scan", "start + whole", "start"),
        ("raster/snap", "c.w - c.z", "c.w"),
    ];
    let gpu = gpu();
    for (file, right, wrong) in faults {
        let text = Sources::default().get(file).expect("the file").into_owned();
        assert!(text.contains(right), "{file} has no {right}");
        let sources = Sources::default().with(file, text.replace(right, wrong));
        let all = variants(&gpu).map(|v| GpuRaster::of(&gpu, &sources, &random_drawing(0), v).expect(file));
        let seen = (0..200).any(|number| {
            let drawing = random_drawing(number);
            let kernels = &all[number as usize % all.len()];
            on_gpu(kernels, &drawing, 1024).is_ok_and(|found| found != on_cpu(&drawing).1)
        });
        assert!(seen, "nobody sees {wrong} in {file}");
    }
}

/// Work that is told as done and was not: the kernels that count for a proof count no more.
#[test]
fn work_that_was_not_done_is_seen() {
    let gpu = gpu();
    let drawing = (0..100).map(random_drawing).find(|d| !on_cpu(d).0.busy.is_empty()).expect("a busy tile");
    let counts = "atomicAdd(&tally.groups, 1u);";
    for file in ["raster/call", "raster/cover"] {
        let text = Sources::default().get(file).expect("the file").into_owned();
        assert!(text.contains(counts), "{file} has no {counts}");
        let sources = Sources::default().with(file, text.replace(counts, "atomicAdd(&tally.groups, 0u);"));
        let kernels = GpuRaster::new(&gpu, &sources, &random_drawing(0)).expect(file);
        let made = on_gpu(&kernels, &drawing, 1024);
        assert!(matches!(made, Err(Error::Incomplete(_))), "{file}: {:?}", made.map(|_| "a drawing"));
    }
}
