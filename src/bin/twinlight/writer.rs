//! films -> files and lines of JSON, beside the rendering of the next ones

use std::path::PathBuf;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::JoinHandle;

use indicatif::ProgressBar;
use twinlight::film::{self, Film, Format, Moving, Transfer, replace};

use crate::claim::Claim;
use crate::job::{Failure, say};

/// A film, and what is to become of it.
#[derive(Debug)]
pub(crate) struct Made {
    pub(crate) film: Film,
    pub(crate) transfer: Transfer,
    /// Nothing for stdout.
    pub(crate) file: Option<PathBuf>,
    pub(crate) stamp: String,
    /// Pictures a second and how many there are, in an animated one.
    pub(crate) moving: Option<(f32, u32)>,
    /// What is told of it, once it is written.
    pub(crate) report: serde_json::Map<String, serde_json::Value>,
    pub(crate) sentence: String,
    /// Given back once it is written.
    pub(crate) claim: Option<Claim>,
}

/// A thread that writes. One film waits for it at most, so memory is bounded.
#[derive(Debug)]
pub(crate) struct Writer {
    films: SyncSender<Made>,
    thread: JoinHandle<Result<(), Failure>>,
}

impl Writer {
    /// Sentences go above the bar; objects of JSON, if they are wanted, to stdout.
    pub(crate) fn new(json: bool, bar: ProgressBar) -> Self {
        let (films, made) = sync_channel(0);
        Self { films, thread: std::thread::spawn(move || write(&made, json, &bar)) }
    }

    /// Hands a film on; false if the writer has failed, which [`Writer::end`] will tell.
    pub(crate) fn take(&self, made: Made) -> bool {
        self.films.send(made).is_ok()
    }

    /// Waits for all that was handed on.
    pub(crate) fn end(self) -> Result<(), Failure> {
        drop(self.films);
        let broken = || Failure::Stdout(std::io::Error::other("the writer has failed"));
        self.thread.join().unwrap_or_else(|_| Err(broken()))
    }
}

/// An animated picture that lacks some of its frames.
struct Begun {
    path: PathBuf,
    moving: Moving,
    frames: u32,
}

fn write(films: &Receiver<Made>, json: bool, bar: &ProgressBar) -> Result<(), Failure> {
    let mut begun: Option<Begun> = None;
    for made in films {
        let picture = made.film.to_rgb8(made.transfer);
        let path = made.file.clone().unwrap_or_else(|| "-".into());
        let wrong = |why: String| film::Error::Encode { path: path.clone(), why };
        let bytes = if let Some((rate, count)) = made.moving {
            // Of a picture that one of its frames has failed, no more frames come.
            let mut all = if let Some(all) = begun.take().filter(|all| all.path == path) {
                all
            } else {
                let size = picture.dimensions().into();
                let moving = Moving::new(size, count, rate, &made.stamp).map_err(wrong)?;
                Begun { path: path.clone(), moving, frames: 0 }
            };
            all.moving.push(&picture).map_err(wrong)?;
            all.frames += 1;
            if all.frames < count {
                begun = Some(all);
                continue;
            }
            all.moving.finish()
        } else {
            let format = made.file.as_ref().map_or(Ok(Format::Png), |file| Format::of(file))?;
            format.encode(&picture, &made.stamp)
        };
        let bytes = bytes.map_err(wrong)?;
        match &made.file {
            Some(file) => replace(file, &bytes)?,
            None => drop(say(&bytes)?),
        }
        bar.suspend(|| eprintln!("{}", made.sentence));
        if json {
            let mut report = made.report;
            report.insert("hash".to_owned(), blake3::hash(&bytes).to_hex().to_string().into());
            say(serde_json::Value::Object(report).to_string() + "\n")?;
        }
        drop(made.claim);
    }
    Ok(())
}
