//! What the commands share: a scene with its overrides, the backend's choice, progress, and the exit codes.

use std::io::Write as _;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};
use twinlight::film;
use twinlight::gpu::{self, Wanted};
use twinlight::render;
use twinlight::scene::value::{Depth, Samples, Side};
use twinlight::scene::{self, Method, Scene, Show};

/// A scene, and what of it the command line says otherwise.
#[derive(Debug, clap::Args)]
pub(crate) struct Job {
    /// The scene file (TOML), or a model (OBJ) that gets a camera, lights and a ground that fit it.
    pub(crate) scene: PathBuf,
    /// How to render [default: the scene's method].
    #[arg(long)]
    method: Option<Method>,
    /// The adapter whose name or driver contains this; `twinlight info` lists them.
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
    /// Width and height in pixels, as 800x600 [default: the scene's].
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<[u32; 2]>,
    /// Samples a pixel; a square number lies on an n x n grid: 16 is 4 x 4 [default: the scene's].
    #[arg(long, value_name = "N", value_parser = samples)]
    samples: Option<u32>,
    /// Rays in a row, the first one counted [default: the scene's].
    #[arg(long, value_name = "N", value_parser = depth)]
    depth: Option<u32>,
    /// What the rasterizer shows [default: the picture].
    #[arg(long, value_name = "WHAT")]
    show: Option<Show>,
}

impl Job {
    /// The scene as the command line wants it, and the method.
    pub(crate) fn load(&self) -> Result<(Scene, Method), Failure> {
        let mut scene = scene::load(&self.scene)?;
        if let Some(size) = self.size {
            scene.resize(size)?;
        }
        scene.trace.samples = self.samples.unwrap_or(scene.trace.samples);
        if let Some(samples) = self.samples {
            scene.raster.samples = samples.isqrt().min(16).pow(2);
        }
        scene.raster.show = self.show.unwrap_or_default();
        scene.trace.depth = self.depth.unwrap_or(scene.trace.depth);
        let method = self.method.unwrap_or(scene.method);
        Ok((scene, method))
    }

    /// The adapter that is asked for.
    pub(crate) fn wanted(&self) -> Wanted {
        self.adapter.clone().map_or(Wanted::Best, Wanted::Named)
    }

    /// `NAME.png`, or with a suffix `NAME-SUFFIX.png`, in the current folder.
    pub(crate) fn output(&self, asked: Option<&PathBuf>, suffix: &str) -> PathBuf {
        let stem = self.scene.file_stem().unwrap_or_default().to_string_lossy();
        asked.cloned().unwrap_or_else(|| format!("{stem}{suffix}.png").into())
    }
}

fn size(text: &str) -> Result<[u32; 2], String> {
    let side = |text: &str| Side::new(text.parse().ok()?).map(|side| side.0);
    let sides = text.split_once('x').and_then(|(w, h)| Some([side(w)?, side(h)?]));
    sides.ok_or_else(|| format!("write it as 800x600; {}", Side::RIGHT))
}

fn samples(text: &str) -> Result<u32, String> {
    text.parse().ok().and_then(Samples::new).map(|n| n.0).ok_or_else(|| Samples::RIGHT.to_owned())
}

fn depth(text: &str) -> Result<u32, String> {
    text.parse().ok().and_then(Depth::new).map(|n| n.0).ok_or_else(|| Depth::RIGHT.to_owned())
}

/// Why a command did not do what was asked; its exit code hangs on it.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Failure {
    #[error(transparent)]
    Scene(#[from] scene::Error),
    #[error(transparent)]
    Film(#[from] film::Error),
    #[error(transparent)]
    Render(#[from] render::Error),
    #[error(transparent)]
    Gpu(#[from] gpu::Error),
    #[error(transparent)]
    Sizes(#[from] film::compare::Sizes),
    #[error("cannot write to stdout: {0}")]
    Stdout(#[from] std::io::Error),
}

impl Failure {
    pub(crate) fn code(&self) -> ExitCode {
        ExitCode::from(match self {
            Self::Scene(scene::Error::Memory { .. }) | Self::Gpu(gpu::Error::NoRoom { .. }) => 6,
            Self::Scene(_) => 3,
            Self::Film(film::Error::Ending(_)) | Self::Render(render::Error::TooLarge(_)) | Self::Sizes(_) => 2,
            Self::Film(_) | Self::Stdout(_) => 4,
            Self::Render(render::Error::Gpu(_)) | Self::Gpu(_) => 5,
            Self::Render(render::Error::Stopped) => 130,
        })
    }
}

/// Prints to stdout; a reader that has gone away (`| head`) is no failure.
pub(crate) fn say(text: &str) -> Result<ExitCode, Failure> {
    match std::io::stdout().lock().write_all(text.as_bytes()) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => Err(error.into()),
        _ => Ok(ExitCode::SUCCESS),
    }
}

/// A bar with the time left, on a terminal; nothing on a pipe.
pub(crate) fn bar(what: &str) -> ProgressBar {
    let style = ProgressStyle::with_template("{msg} [{bar:30}] {percent}%, {eta} left");
    let bar = ProgressBar::new(1000).with_message(what.to_owned());
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()).progress_chars("=> "));
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}
