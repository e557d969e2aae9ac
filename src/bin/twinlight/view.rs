//! `twinlight view`: a scene -> a window in which one looks at it

#[cfg(feature = "viewer")]
mod app;
#[cfg(feature = "viewer")]
mod hand;
#[cfg(feature = "viewer")]
mod lights;
#[cfg(feature = "viewer")]
mod news;
#[cfg(feature = "viewer")]
mod out;
#[cfg(feature = "viewer")]
mod panels;
#[cfg(feature = "viewer")]
mod picture;
#[cfg(feature = "viewer")]
mod shell;
#[cfg(feature = "viewer")]
mod show;
#[cfg(feature = "viewer")]
mod stage;
#[cfg(all(test, feature = "viewer-tests"))]
mod tests;
#[cfg(feature = "viewer")]
mod times;
#[cfg(feature = "viewer")]
mod watcher;

use std::path::PathBuf;
use std::process::ExitCode;

use twinlight::render::live::Side;

use crate::job::{Failure, Job, Keep};

#[derive(Debug, Clone, clap::Args)]
pub(crate) struct Arguments {
    /// The scene file (TOML), or a model (OBJ) that gets a camera, lights and a ground that fit it.
    pub(crate) scene: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) job: Job,
    #[command(flatten)]
    pub(crate) keep: Keep,
    /// Which backend renders; B changes it.
    #[arg(long, default_value = "gpu", overrides_with = "backend")]
    pub(crate) backend: Side,
    /// A saved picture that the scene's is compared with; one can be dropped on the window, too.
    #[arg(long, value_name = "PICTURE")]
    pub(crate) beside: Option<PathBuf>,
    /// Give the device up after so many seconds, once: how a test has a window lose it.
    #[arg(long, value_name = "SECONDS", hide = true)]
    pub(crate) lose_device_after: Option<u64>,
    /// How often the window before this one has lost its device.
    #[arg(long, value_name = "N", default_value_t = 0, hide = true)]
    pub(crate) losses: u32,
}

#[cfg(feature = "viewer")]
impl Arguments {
    fn reach(&self) -> twinlight::scene::Reach {
        self.keep.reach(&self.job.input)
    }
}

#[cfg(feature = "viewer")]
pub(crate) fn run(arguments: &Arguments) -> Result<ExitCode, Failure> {
    shell::run(arguments)
}

#[cfg(not(feature = "viewer"))]
pub(crate) fn run(_: &Arguments) -> Result<ExitCode, Failure> {
    let how = "cargo build --release --features viewer, or `cargo view SCENE` in Twinlight's folder";
    Err(Failure::Usage(format!("this build of Twinlight has no window; one that has is made by {how}")))
}
