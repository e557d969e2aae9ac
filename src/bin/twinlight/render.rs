//! `twinlight render`: a scene file -> a picture

use std::path::PathBuf;
use std::process::ExitCode;

use twinlight::film::{Format, write_whole};
use twinlight::render::{Backend, Renderer};

use crate::job::{Failure, Job, bar};

#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    job: Job,
    /// The picture: .png, .tga or .ppm [default: the scene's name and .png, in the current folder].
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Where the work is done.
    #[arg(long, default_value = "auto")]
    backend: Backend,
}

pub(crate) fn run(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let output = arguments.job.output(arguments.output.as_ref(), "");
    // Before the work: a name that cannot be written should not cost a picture.
    Format::of(&output)?;
    let (scene, method) = arguments.job.load()?;
    let mut renderer = Renderer::open(arguments.backend, &arguments.job.wanted())?;
    let bar = bar("rendering");
    let rendered = renderer.render(&scene, method, &mut |done: f64| bar.set_position((done * 1000.0) as u64));
    bar.finish_and_clear();
    let rendered = rendered?;
    for note in &rendered.notes {
        eprintln!("note: {note}");
    }
    let film = &rendered.film;
    if film.broken() > 0 {
        eprintln!("warning: {} pixels are not finite numbers and are drawn black", film.broken());
    }
    write_whole(&output, &film.to_rgb8(scene.film.transfer))?;
    let took = rendered.took.as_secs_f64();
    let [width, height] = scene.film.size;
    eprintln!("{}: {width}x{height} in {took:.2} s on {}", output.display(), rendered.by);
    Ok(ExitCode::SUCCESS)
}
