//! Tables as textures, which the kernels of hardware read: a software adapter's own way is another.

use twinlight::film::compare::{Standard, compare};
use twinlight::gpu::wgsl::Sources;
use twinlight::gpu::{Gpu, GpuRaster, GpuTrace, Wanted};
use twinlight::prepare::draw;
use twinlight::scene::Method;
use twinlight::{raster, trace};

use super::{root, scene_on_cpu, small, tables_of};

/// Whether a scene by a method is what it is on the CPU, with the kernels of `sources`.
fn alike(gpu: &Gpu, sources: &Sources, name: &str, method: Method) -> bool {
    let mut scene = small(&root().join(format!("scenes/{name}.toml")), [61, 43], 1);
    scene.method = method;
    let film = if method == Method::Trace {
        let tables = tables_of(&scene);
        let mut stages = GpuTrace::new(gpu, sources, &tables).expect("kernels");
        trace::frame(&mut stages, &tables, &mut |_| ()).expect("a picture")
    } else {
        let drawing = draw(&scene);
        let mut stages = GpuRaster::new(gpu, sources, &drawing).expect("kernels");
        raster::frame(&mut stages, &drawing, &mut |_| ()).expect("a picture")
    };
    assert_eq!(gpu.complaint(), None, "wgpu complained");
    compare(&scene_on_cpu(&scene), &film, Standard::Exact).expect("one size").passes()
}

#[test]
fn tables_as_textures_make_the_same_pictures() {
    let gpu = Gpu::open(&Wanted::Software).expect("an adapter").without_images();
    let all =
        [("bust", Method::Raster), ("bust", Method::Trace), ("dahlia", Method::Raster), ("dahlia", Method::Trace)];
    for (name, method) in all {
        assert!(alike(&gpu, &Sources::default(), name, method), "{name} {method:?}");
    }
    // Only what textures are read by is broken.
    let text = Sources::default().get("tables/texel").expect("the file").into_owned();
    let right = "vec2u(i % ROW, i / ROW), 0)";
    assert!(text.contains(right), "plant another fault");
    let broken = Sources::default().with("tables/texel", text.replace(right, "vec2u(i % ROW, 0u), 0)"));
    for method in [Method::Raster, Method::Trace] {
        assert!(!alike(&gpu, &broken, "bust", method), "a texture's rows are not looked at, and nobody sees it");
    }
}
