//! `twinlight render`: scene files -> pictures

use std::ops::{ControlFlow, Range};
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

use twinlight::film::{Watch, stamp_of};
use twinlight::render::{Backend, Renderer, Work};
use twinlight::scene::{Method, Scene, Source};

use crate::claim::Claim;
use crate::frames::{Frames, frames};
use crate::job::{Failure, Job, say};
use crate::plan::{Names, Picture, plan};
use crate::progress::{self, Progress};
use crate::stop::{Stop, time};
use crate::writer::{Made, Writer};

#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// Scene files (TOML), or models (OBJ), which get a camera, lights and a ground that fit them.
    #[arg(required = true, value_name = "SCENE")]
    scenes: Vec<PathBuf>,
    #[command(flatten)]
    job: Job,
    /// The picture: .png, .tga or .ppm, `-` for a PNG on stdout, or a folder. {scene} and {frame:4} or #### stand for
    /// the scene's name and the frame's number; several frames in one .png become an animated picture [default:
    /// {scene}.png, or {scene}-{frame:4}.png].
    #[arg(short, long, value_name = "FILE")]
    output: Option<String>,
    /// Which frames: 7, 1-240, 1..240, 1-240:2 or 1,5,10-20 [default: all of the animation].
    #[arg(long, value_parser = frames)]
    frames: Option<Frames>,
    /// A rectangle of the picture alone: its size and its upper left corner, as 320x200+64+32.
    #[arg(long, value_name = "WxH+X+Y", value_parser = rectangle)]
    crop: Option<[Range<u32>; 2]>,
    /// Where the work is done.
    #[arg(long, default_value = "auto")]
    backend: Backend,
    /// Make pictures that are there already again.
    #[arg(long)]
    again: bool,
    /// Say what would be made, and make nothing.
    #[arg(long)]
    dry_run: bool,
    /// Print an object of JSON for each picture: file, scene, frames, size, method, backend, seconds, inputs (what it is
    /// known by), hash (BLAKE3 of the file), notes, made.
    #[arg(long)]
    json: bool,
    /// How progress is told, on stderr.
    #[arg(long, default_value = "bar")]
    progress: progress::Kind,
    /// Stop after so long: 90, 90s, 15m or 1.5h.
    #[arg(long, value_name = "TIME", value_parser = time)]
    deadline: Option<Duration>,
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
    let names = Names { output: arguments.output.as_deref(), frames: arguments.frames.as_ref() };
    let pictures = plan(&sources, &names)?;
    let call = Call { arguments, sources: &sources, stop };
    if arguments.dry_run {
        for picture in &pictures {
            call.foretell(picture).unwrap_or_else(&mut fail);
        }
    } else {
        call.make_all(&pictures, &mut fail)?;
    }
    Ok(first.unwrap_or(ExitCode::SUCCESS))
}

/// All that a call's pictures share.
struct Call<'a> {
    arguments: &'a Arguments,
    sources: &'a [Source],
    stop: Stop,
}

/// A frame that is ready to be made.
struct Ready {
    scene: Scene,
    method: Method,
    work: Work,
}

impl Call<'_> {
    fn ready(&self, picture: &Picture, frame: i64) -> Result<Ready, Failure> {
        let (scene, method) = self.arguments.job.scene(&self.sources[picture.scene], frame)?;
        let work = Work::new(&scene, method)?;
        let work = match &self.arguments.crop {
            Some([columns, rows]) => work.crop(columns.clone(), rows.clone())?,
            None => work,
        };
        Ok(Ready { scene, method, work })
    }

    /// What the picture is known by, with its first frame.
    fn stamp(&self, picture: &Picture, class: &str) -> Result<(String, Ready), Failure> {
        let first = self.ready(picture, picture.frames[0])?;
        if let [_] = picture.frames[..] {
            return Ok((format!("{} {class}", first.work.digest()), first));
        }
        let mut all = blake3::Hasher::new();
        for &frame in &picture.frames {
            all.update(self.ready(picture, frame)?.work.digest().to_string().as_bytes());
        }
        Ok((format!("{} {class}", all.finalize().to_hex()), first))
    }

    fn is_made(&self, picture: &Picture, stamp: &str) -> bool {
        let there = picture.file.as_ref().and_then(|file| stamp_of(file));
        !self.arguments.again && there.is_some_and(|there| there == stamp)
    }

    fn foretell(&self, picture: &Picture) -> Result<(), Failure> {
        let (stamp, ready) = self.stamp(picture, "")?;
        let (name, [width, height]) = (picture.name(), ready.work.size());
        let there = picture.file.as_ref().and_then(|file| stamp_of(file));
        // Who would make it is not known without opening the GPU.
        let made = !self.arguments.again && there.is_some_and(|there| there.starts_with(&stamp));
        if self.arguments.json {
            let mut report = self.report(picture, &ready, &stamp);
            report.insert("made".to_owned(), made.into());
            say(serde_json::Value::Object(report).to_string() + "\n")?;
        } else {
            let verdict = if made { "is there" } else { "would be made" };
            say(format!("{name}: {width}x{height}, {verdict}\n"))?;
        }
        Ok(())
    }

    fn make_all(&self, pictures: &[Picture], fail: &mut dyn FnMut(Failure)) -> Result<(), Failure> {
        let arguments = self.arguments;
        let mut renderer = Renderer::open(arguments.backend, &arguments.job.wanted())?;
        let mut progress = Progress::new(arguments.progress, pictures.len());
        let writer = Writer::new(arguments.json, progress.bar());
        let mut left: Vec<usize> = (0..pictures.len()).collect();
        let mut result = Ok(());
        // Pictures that other processes are at are looked for again, since those may be killed.
        while !left.is_empty() && result.is_ok() {
            let before = left.len();
            left.retain(|&number| {
                if result.is_err() {
                    return true;
                }
                progress.begin(number, &pictures[number].name());
                match self.make(&pictures[number], &mut renderer, &mut progress, &writer) {
                    Ok(done) => return !done,
                    Err(failure) if failure.is_of_one_scene() => progress.suspend(|| fail(failure)),
                    Err(failure) => result = Err(failure),
                }
                false
            });
            if left.len() == before && result.is_ok() {
                std::thread::sleep(Duration::from_millis(100));
            }
            result = result.and_then(|()| self.stop.why().filter(|_| !left.is_empty()).map_or(Ok(()), Err));
        }
        progress.end();
        // What was handed to the writer is finished, whatever happened since; its own failure explains all others.
        writer.end().and(result)
    }

    /// Makes a picture; false if another process is at it.
    fn make(
        &self,
        picture: &Picture,
        renderer: &mut Renderer,
        progress: &mut Progress,
        writer: &Writer,
    ) -> Result<bool, Failure> {
        let mut claim = None;
        if let Some(file) = &picture.file {
            claim =
                Claim::take(file).map_err(|source| twinlight::film::Error::Write { path: file.clone(), source })?;
            if claim.is_none() {
                return Ok(false);
            }
        }
        let (stamp, first) = self.stamp(picture, &renderer.class())?;
        if self.is_made(picture, &stamp) {
            if self.arguments.json {
                say(serde_json::Value::Object(self.report(picture, &first, &stamp)).to_string() + "\n")?;
            }
            progress.say(&format!("{}: is there already", picture.name()));
            return Ok(true);
        }
        let moving = self.sources[picture.scene].frames().map_or(24.0, |(_, rate)| rate);
        let count = picture.frames.len();
        let moving = (count > 1).then_some((moving, count as u32));
        let mut first = Some(first);
        for (number, &frame) in picture.frames.iter().enumerate() {
            let ready = match first.take() {
                Some(ready) => ready,
                None => self.ready(picture, frame)?,
            };
            let mut watch = Eye { stop: &self.stop, progress, number, count };
            let rendered = renderer.make(&ready.work, &mut watch);
            let rendered = rendered.map_err(|error| self.stop.why().unwrap_or(error.into()))?;
            for note in &rendered.notes {
                progress.say(&format!("note: {note}"));
            }
            let broken = rendered.film.broken();
            if broken > 0 {
                progress.say(&format!("warning: {broken} pixels are not finite numbers and are drawn black"));
            }
            let mut report = self.report(picture, &ready, &stamp);
            let seconds = rendered.took.as_secs_f64();
            let more = [
                ("backend", rendered.by.clone().into()),
                ("seconds", seconds.into()),
                ("notes", rendered.notes.clone().into()),
                ("broken", broken.into()),
                ("made", true.into()),
            ];
            report.extend(more.map(|(name, value)| (name.to_owned(), value)));
            let (name, [width, height]) = (picture.name(), ready.work.size());
            let of = if count > 1 { format!(", {count} frames, the last") } else { String::new() };
            let sentence = format!("{name}: {width}x{height}{of} in {seconds:.2} s on {}", rendered.by);
            let file = picture.file.clone();
            let (film, transfer, stamp) = (rendered.film, ready.scene.film.transfer, stamp.clone());
            let claim = if number + 1 == count { claim.take() } else { None };
            if !writer.take(Made { film, transfer, file, stamp, moving, report, sentence, claim }) {
                break;
            }
        }
        Ok(true)
    }

    /// What is told of every picture, made or not.
    fn report(&self, picture: &Picture, ready: &Ready, stamp: &str) -> serde_json::Map<String, serde_json::Value> {
        let method = if ready.method == Method::Trace { "trace" } else { "raster" };
        let about = serde_json::json!({
            "file": picture.name(),
            "scene": self.sources[picture.scene].path().display().to_string(),
            "frames": picture.frames,
            "size": ready.work.size(),
            "method": method,
            "inputs": stamp.split(' ').next(),
            "made": false,
        });
        match about {
            serde_json::Value::Object(about) => about,
            _ => serde_json::Map::new(),
        }
    }
}

/// Looks on while a frame is made.
struct Eye<'a> {
    stop: &'a Stop,
    progress: &'a mut Progress,
    number: usize,
    count: usize,
}

impl Watch for Eye<'_> {
    fn done(&mut self, fraction: f64) -> ControlFlow<()> {
        self.progress.done((self.number as f64 + fraction) / self.count as f64);
        if self.stop.why().is_some() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}
