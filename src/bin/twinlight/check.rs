//! `twinlight check`: scene files -> whether every frame of them can be rendered

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use crate::job::{Failure, Input, say};

#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// Scene files (TOML), or models (OBJ).
    #[arg(required = true, value_name = "SCENE")]
    scenes: Vec<PathBuf>,
    #[command(flatten)]
    input: Input,
}

pub(crate) fn run(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let mut first = ExitCode::SUCCESS;
    for scene in &arguments.scenes {
        match check(scene, &arguments.input) {
            Ok(told) => drop(say(told)?),
            Err(failure) => {
                eprintln!("error: {failure}");
                if first == ExitCode::SUCCESS {
                    first = failure.code();
                }
            }
        }
    }
    Ok(first)
}

fn check(path: &Path, input: &Input) -> Result<String, Failure> {
    let source = input.open(path)?;
    let frames = source.frames().map_or(1, |(count, _)| count);
    let scene = source.scene(1)?;
    for frame in 2..=frames {
        source.scene(i64::from(frame))?;
    }
    let mut warned = std::collections::HashSet::new();
    for warning in scene.meshes.iter().flat_map(|mesh| &mesh.model.warnings) {
        let warning = warning.to_string();
        if warned.insert(warning.clone()) {
            eprintln!("warning: {warning}");
        }
    }
    let [width, height] = scene.film.size;
    let mut told = format!("{}: ok, {width}x{height}", path.display());
    let faces: usize = scene.meshes.iter().map(|mesh| mesh.model.triangles.len()).sum();
    for (count, what) in [
        (scene.spheres.len(), "spheres"),
        (scene.planes.len(), "planes"),
        (scene.triangles.len() + faces, "triangles"),
        (scene.lights.len(), "lights"),
    ] {
        if count > 0 {
            let what = if count == 1 { what.trim_end_matches('s') } else { what };
            let _ = write!(told, ", {count} {what}");
        }
    }
    if source.frames().is_some() {
        let _ = write!(told, ", {frames} frames");
    }
    Ok(told + "\n")
}
