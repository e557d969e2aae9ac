//! `twinlight render`: scene files -> pictures

use std::ops::Range;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

use twinlight::film::pass::Pass;
use twinlight::render::Backend;

use crate::call::Call;
use crate::frames::{Frames, frames};
use crate::job::{Failure, Job, Keep};
use crate::plan::{Names, beyond, plan};
use crate::progress;
use crate::stop::{Stop, time};

#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// Scene files (TOML), or models (OBJ), which get a camera, lights and a ground that fit them.
    #[arg(required = true, value_name = "SCENE")]
    scenes: Vec<PathBuf>,
    #[command(flatten)]
    pub(crate) job: Job,
    #[command(flatten)]
    pub(crate) keep: Keep,
    /// The picture: .png, .exr (linear, in full precision), .tga or .ppm, `-` for a PNG on stdout, or a folder. {scene}
    /// and {frame:4} or #### stand for the scene's name and the frame's number; several frames in one .png become an
    /// animated picture [default: {scene}.png, or {scene}-{frame:4}.png].
    #[arg(short, long, value_name = "FILE")]
    output: Option<String>,
    /// Which frames: 7, 1-240, 1..240, 1-240:2 or 1,5,10-20 [default: all of the animation].
    #[arg(long, value_parser = frames)]
    frames: Option<Frames>,
    /// A rectangle of the picture alone: its size and its upper left corner, as 320x200+64+32.
    #[arg(long, value_name = "WxH+X+Y", value_parser = rectangle)]
    pub(crate) crop: Option<[Range<u32>; 2]>,
    /// More than colors: layers of an .exr, and for other formats pictures beside the first, as room.depth.png.
    #[arg(long, value_name = "PASS,...", value_delimiter = ',')]
    pub(crate) passes: Vec<Pass>,
    /// Some of each pixel's samples alone, into a .part that `twinlight merge` puts together with the others: 0..64. It
    /// begins and ends at multiples of 64, or at the last sample; the ray tracer's alone.
    #[arg(long, value_name = "A..B", value_parser = samples)]
    pub(crate) sample_range: Option<Range<u32>>,
    /// As many samples as there is time for, one of every pixel at least: 90, 90s, 15m or 1.5h for each frame;
    /// --samples is the most of them. The ray tracer's alone [default: all samples, however long].
    #[arg(long, value_name = "TIME", value_parser = time, conflicts_with = "sample_range")]
    pub(crate) time: Option<Duration>,
    /// Until the error of a tile of 16 x 16 pixels, estimated from its samples, is below this share of full white; 0.01
    /// is fine. 16 samples at least; --samples is the most. The ray tracer's alone.
    #[arg(long, value_name = "ERROR", value_parser = noise, conflicts_with = "sample_range")]
    pub(crate) noise: Option<f32>,
    /// Where the work is done.
    #[arg(long, default_value = "auto")]
    pub(crate) backend: Backend,
    /// Make pictures that are there already again.
    #[arg(long)]
    pub(crate) again: bool,
    /// Say what would be made, and make nothing.
    #[arg(long)]
    pub(crate) dry_run: bool,
    /// Print an object of JSON for each picture: file, scene, frames, size, method, backend, seconds, samples, inputs
    /// (what it is known by), hash (BLAKE3 of the file), notes, broken (pixels that are not finite numbers), made; in a
    /// dry run, whether it is there.
    #[arg(long)]
    pub(crate) json: bool,
    /// How progress is told, on stderr.
    #[arg(long, default_value = "bar")]
    pub(crate) progress: progress::Kind,
    /// Stop after so long: 90, 90s, 15m or 1.5h.
    #[arg(long, value_name = "TIME", value_parser = time)]
    deadline: Option<Duration>,
}

fn samples(text: &str) -> Result<Range<u32>, String> {
    let parse = || {
        let (from, to) = text.split_once("..")?;
        let (from, to) = (from.parse().ok()?, to.parse().ok()?);
        (from < to).then_some(from..to)
    };
    parse().ok_or_else(|| "a sample range is written as 0..64".to_owned())
}

fn noise(text: &str) -> Result<f32, String> {
    let noise = text.parse().ok().filter(|noise: &f32| noise.is_finite() && *noise > 0.0);
    noise.ok_or_else(|| "an error is a number above 0, as 0.01".to_owned())
}

fn rectangle(text: &str) -> Result<[Range<u32>; 2], String> {
    let parse = || {
        let (size, corner) = text.split_once('+')?;
        let (width, height) = size.split_once('x')?;
        let (x, y) = corner.split_once('+')?;
        let side = |from: &str, length: &str| {
            let from: u32 = from.parse().ok()?;
            Some(from..from.checked_add(length.parse().ok().filter(|length| *length > 0)?)?)
        };
        Some([side(x, width)?, side(y, height)?])
    };
    parse().ok_or_else(|| "a rectangle is written as 320x200+64+32".to_owned())
}

pub(crate) fn run(arguments: &Arguments) -> Result<ExitCode, Failure> {
    if arguments.json && arguments.output.as_deref() == Some("-") {
        return Err(Failure::Usage("stdout is for the picture or for --json, not for both".to_owned()));
    }
    if !arguments.passes.is_empty()
        && (arguments.sample_range.is_some() || arguments.output.as_deref() == Some("-"))
    {
        return Err(Failure::Usage("passes go with whole pictures in files".to_owned()));
    }
    let mut passes = arguments.passes.iter();
    while let Some(pass) = passes.next() {
        if passes.as_slice().contains(pass) {
            return Err(Failure::Usage(format!("--passes names {} twice", pass.name())));
        }
    }
    let stop = Stop::new(arguments.deadline)?;
    // One wrong scene does not cost the others their pictures.
    let mut first = None;
    let mut fail = |failure: Failure| {
        eprintln!("error: {failure}");
        first.get_or_insert(failure.code());
    };
    let mut sources = Vec::new();
    for scene in &arguments.scenes {
        match arguments.job.input.open(scene) {
            Ok(source) => sources.push(source),
            Err(failure) if arguments.scenes.len() > 1 => fail(failure),
            Err(failure) => return Err(failure),
        }
    }
    let names = Names {
        output: arguments.output.as_deref(),
        frames: arguments.frames.as_ref(),
        samples: arguments.sample_range.as_ref(),
    };
    let pictures = plan(&sources, &names)?;
    for note in names.frames.iter().flat_map(|frames| beyond(&sources, frames)) {
        eprintln!("note: {note}");
    }
    let call = Call { arguments, sources: &sources, stop: &stop };
    if arguments.dry_run {
        for picture in &pictures {
            call.foretell(picture).unwrap_or_else(&mut fail);
        }
    } else {
        call.make_all(&pictures, &mut fail)?;
    }
    Ok(first.unwrap_or(ExitCode::SUCCESS))
}
