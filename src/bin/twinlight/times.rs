//! `twinlight times`: a scene file -> how long each stage takes on the GPU

use std::fmt::Write as _;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

use twinlight::gpu::StageTime;
use twinlight::render::{Backend, Renderer, Work};

use crate::job::{Failure, Job, say};

#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// The scene file (TOML), or a model (OBJ) that gets a camera, lights and a ground that fit it.
    scene: PathBuf,
    #[command(flatten)]
    job: Job,
    /// Print an object of JSON: adapter, seconds, and of each stage its name, passes and seconds.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let source = arguments.job.input.open(&arguments.scene)?;
    let (scene, method) = arguments.job.scene(&source, 1)?;
    let work = Work::within(&scene, method, &arguments.job.input.reach())?;
    let mut renderer = Renderer::open(Backend::Gpu, &arguments.job.wanted())?;
    // Drivers compile kernels when they run first.
    renderer.make(&work, &mut |_: f64| ())?;
    if !renderer.gpu().is_some_and(|gpu| gpu.measure(true)) {
        return Err(Failure::Usage("this adapter has no clock for its stages (timestamp queries)".to_owned()));
    }
    let rendered = renderer.make(&work, &mut |_: f64| ())?;
    let times = renderer.gpu().map(twinlight::gpu::Gpu::times).unwrap_or_default();
    if arguments.json {
        let stage = |time: &StageTime| serde_json::json!({ "stage": time.name, "passes": time.passes, "seconds": time.took.as_secs_f64() });
        let stages: Vec<_> = times.iter().map(stage).collect();
        let seconds = rendered.took.as_secs_f64();
        say(format!("{}\n", serde_json::json!({ "adapter": rendered.by, "seconds": seconds, "stages": stages })))?;
    } else {
        say(table(&times, rendered.took, &rendered.by))?;
    }
    Ok(ExitCode::SUCCESS)
}

fn table(times: &[StageTime], took: Duration, by: &str) -> String {
    let all: Duration = times.iter().map(|time| time.took).sum();
    let ms = |took: Duration| took.as_secs_f64() * 1e3;
    let mut text = format!("{:<18} {:>6} {:>10} {:>6}\n", "stage", "passes", "ms", "");
    for time in times {
        let share = time.took.as_secs_f64() / all.as_secs_f64().max(f64::MIN_POSITIVE);
        let _ = writeln!(
            text,
            "{:<18} {:>6} {:>10.3} {:>4.0} % {}",
            time.name,
            time.passes,
            ms(time.took),
            share * 100.0,
            "#".repeat((share * 40.0).round() as usize)
        );
    }
    let _ = writeln!(text, "{:<18} {:>6} {:>10.3}", "together", "", ms(all));
    let _ = writeln!(text, "{:<18} {:>6} {:>10.3}  on {by}", "the whole picture", "", ms(took));
    text
}
