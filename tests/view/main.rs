//! What the preview knows and does, without its window.

mod by_hand;
mod inside;
mod live;

use std::path::Path;
use std::sync::{LazyLock, Mutex, MutexGuard, PoisonError};

use twinlight::gpu::{Gpu, Wanted};
use twinlight::scene::{self, Scene};

static GPU: LazyLock<Mutex<Gpu>> = LazyLock::new(|| {
    let gpu = Gpu::open(&Wanted::Software).unwrap_or_else(|e| panic!("{e}; tests/run installs one"));
    Mutex::new(gpu)
});

/// The one device. Its complaints belong to whoever holds it, so one test holds it at a time.
fn gpu() -> MutexGuard<'static, Gpu> {
    GPU.lock().unwrap_or_else(PoisonError::into_inner)
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// A shipped scene, small enough to be rendered often.
fn small(name: &str, size: [u32; 2], samples: u32) -> Scene {
    let mut scene = scene::load(&root().join(format!("scenes/{name}.toml"))).unwrap_or_else(|e| panic!("{e}"));
    scene.resize(size).expect("a small film fits");
    scene.trace.samples = samples;
    scene.raster.samples = samples.isqrt().pow(2);
    scene.raster.shadow_size = 256;
    scene
}

#[cfg(not(feature = "viewer"))]
#[test]
fn a_build_without_a_window_says_how_to_get_one() {
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_twinlight"));
    let out = command.args(["view", "scenes/room.toml"]).output().expect("twinlight");
    let words = String::from_utf8_lossy(&out.stderr);
    assert_eq!(out.status.code(), Some(2), "{words}");
    assert!(words.contains("--features viewer") && words.contains("cargo view SCENE"), "{words}");
}
