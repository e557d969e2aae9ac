//! `twinlight compare`: a scene file -> both backends' films, and where they differ

use std::fmt::Write as _;
use std::path::PathBuf;
use std::process::ExitCode;

use twinlight::film::compare::{Comparison, Standard, compare, side_by_side};
use twinlight::film::{Format, write_whole};
use twinlight::gpu::Gpu;
use twinlight::render::{Backend, Renderer, Work};
use twinlight::scene::{Behavior, Scene};

use crate::job::{Failure, Job, Keep, say};
use crate::progress::bar;

#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// The scene file (TOML), or a model (OBJ) that gets a camera, lights and a ground that fit it.
    scene: PathBuf,
    #[command(flatten)]
    job: Job,
    #[command(flatten)]
    keep: Keep,
    /// The picture `cpu | gpu | difference` [default: the scene's name and -compare.png, in the current folder].
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// What the difference is multiplied by in the picture.
    #[arg(long, value_name = "N", default_value_t = 16.0)]
    gain: f32,
}

pub(crate) fn run(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let stem = arguments.scene.file_stem().unwrap_or_default().to_string_lossy();
    let output = arguments.output.clone().unwrap_or_else(|| format!("{stem}-compare.png").into());
    if Format::of(&output)? == Format::Exr {
        return Err(Failure::Usage("a comparison is a picture of 8 bits: .png, .tga or .ppm".to_owned()));
    }
    let source = arguments.job.input.open(&arguments.scene)?;
    let (scene, method) = arguments.job.scene(&source, 1)?;
    let mut on_gpu = Renderer::open(Backend::Gpu, &arguments.job.wanted())?;
    let standard = on_gpu.gpu().map_or(Standard::Exact, |gpu| standard(gpu, &scene));
    let mut on_cpu = Renderer::open(Backend::Cpu, &arguments.job.wanted())?;

    let work = Work::within(&scene, method, &arguments.keep.reach(&arguments.job.input))?;
    let mut films = Vec::new();
    for (renderer, what) in [(&mut on_cpu, "CPU"), (&mut on_gpu, "GPU")] {
        let bar = bar(what);
        let rendered = renderer.make(&work, &mut |done: f64| bar.set_position((done * 1000.0) as u64));
        bar.finish_and_clear();
        let rendered = rendered?;
        if films.is_empty() {
            rendered.notes.iter().for_each(|note| eprintln!("note: {note}"));
        }
        eprintln!("{what}: {:.2} s on {}", rendered.took.as_secs_f64(), rendered.by);
        films.push(rendered.film);
    }
    let [cpu, gpu] = &films[..] else { return Ok(ExitCode::FAILURE) };

    let comparison = compare(cpu, gpu, standard)?;
    write_whole(&output, &side_by_side(cpu, gpu, scene.film.transfer, arguments.gain)?)?;
    eprintln!("{}: cpu | gpu | difference x {}", output.display(), arguments.gain);
    say(table(&comparison, standard))?;
    Ok(if comparison.passes() { ExitCode::SUCCESS } else { ExitCode::from(1) })
}

fn standard(gpu: &Gpu, scene: &Scene) -> Standard {
    if gpu.exact() {
        Standard::Exact
    } else if scene.materials.iter().any(|m| m.behavior == Behavior::Diffuse) {
        Standard::Random
    } else {
        Standard::Near
    }
}

fn table(comparison: &Comparison, standard: Standard) -> String {
    let mut text = format!("standard: {standard:?}\n");
    for row in &comparison.rows {
        let verdict = if row.passes() { "ok" } else { "FAILED" };
        let tolerance = &row.tolerance;
        let _ = writeln!(
            text,
            "{} | {:<58} | {:>10.4} of at most {:<6} | {verdict}",
            tolerance.tier,
            tolerance.what.words(),
            row.found,
            tolerance.most
        );
    }
    let [x, y] = comparison.worst;
    let _ = writeln!(
        text,
        "largest difference {:.6} at pixel {x},{y}; mean {:.8}",
        comparison.largest, comparison.mean
    );
    text
}
