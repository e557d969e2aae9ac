//! `twinlight explain`: a scene and a pixel -> everything that made the pixel

use std::path::PathBuf;
use std::process::ExitCode;

use twinlight::explain::Explainer;

use crate::job::{Failure, Job, say};

/// Names of fields, as a script asks for them; `tests/suite/cli_explain.rs` holds it to what is printed.
pub(crate) const SHAPE: &str = "\
Examples:
  twinlight explain scenes/bust.toml --pixel 400,300
  twinlight explain scenes/room.toml --pixel 250,330 --samples 1 | less
  twinlight explain scenes/bust.toml --pixel 400,300 --json | jq '.samples[0].seen.weights'

The object of --json, all vectors as lists, null where there is nothing, samples by their method:
  { pixel size method linear rgb8 spec samples
  raster { at color seen { thing { id object triangle group material } corners
    on_film { places edges weights } clip weights z depth point uv
    maps { diffuse specular exponent normal } albedo specular exponent
    tangents smooth normal view ambient
    lights { light intensity toward share power phong diffuse specular
      shadow { lens clip texel { column row depth open asked } map side stored bias caster } } } }
  trace { at color rays { way parent depth inside weight origin direction background
    meets { thing kind t point normal maps tangents shading color specular local exponent random
      lights { light toward phong color before arrives blocker }
      ways { way direction weight followed } } } } }";

#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// The scene file (TOML), or a model (OBJ) that gets a camera, lights and a ground that fit it.
    scene: PathBuf,
    /// Column and row, from 0,0 in the upper left corner.
    #[arg(long, value_name = "X,Y", value_parser = pixel)]
    pixel: [u32; 2],
    #[command(flatten)]
    job: Job,
    /// Which frame of an animation.
    #[arg(long, default_value_t = 1)]
    frame: i64,
    /// Print it as an object of JSON.
    #[arg(long)]
    json: bool,
}

fn pixel(text: &str) -> Result<[u32; 2], String> {
    let parse = || {
        let (x, y) = text.split_once(',')?;
        Some([x.trim().parse().ok()?, y.trim().parse().ok()?])
    };
    parse().ok_or_else(|| "a pixel is written as 400,300".to_owned())
}

pub(crate) fn run(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let source = arguments.job.input.open(&arguments.scene)?;
    let (scene, method) = arguments.job.scene(&source, arguments.frame)?;
    let told = Explainer::new(&scene, method, &arguments.job.input.reach())?.pixel(arguments.pixel)?;
    if arguments.json {
        let json = serde_json::to_string(&told).map_err(std::io::Error::other)?;
        return say(json + "\n");
    }
    say(told.to_string())
}
