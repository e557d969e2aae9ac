//! films -> files and lines of JSON, beside the rendering of the next ones

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::JoinHandle;

use indicatif::ProgressBar;
use twinlight::film::pass::{Layer, Pass};
use twinlight::film::{self, Band, Film, Format, Growing, Moving, Transfer, exr, replace};

use crate::claim::Claim;
use crate::job::{Failure, say};

/// The name of stdout.
pub(crate) const STDOUT: &str = "-";

/// What is printed of a picture as JSON.
pub(crate) type Report = serde_json::Map<String, serde_json::Value>;

/// What is told of a picture, once it is written.
#[derive(Debug)]
pub(crate) struct Told {
    pub(crate) report: Report,
    pub(crate) sentence: String,
}

/// What was made, and what is to become of it.
#[derive(Debug)]
pub(crate) struct Made {
    pub(crate) body: Body,
    /// Of a picture that is whole.
    pub(crate) told: Option<Told>,
    /// Given back once all is written.
    pub(crate) claim: Option<Claim>,
}

/// What was made.
#[derive(Debug)]
pub(crate) enum Body {
    /// A part of a picture's samples.
    Part { file: PathBuf, bytes: Vec<u8> },
    Frame {
        film: Box<Film>,
        transfer: Transfer,
        layers: Vec<Layer>,
        /// Each with what it is known by, and the pass that it shows.
        files: Vec<(PathBuf, String, Option<Pass>)>,
        /// Pictures a second and how many there are, in an animated one.
        moving: Option<(f32, u32)>,
    },
    /// Some rows of a picture of this size; the first ones begin the file.
    Band { band: Box<Band>, transfer: Transfer, file: PathBuf, stamp: String, size: [u32; 2] },
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

fn write(all: &Receiver<Made>, json: bool, bar: &ProgressBar) -> Result<(), Failure> {
    let mut begun: Option<Begun> = None;
    let mut bands: Option<Growing> = None;
    for made in all {
        let files = match made.body {
            Body::Part { file, bytes } => vec![(file, bytes)],
            Body::Band { band, transfer, file, stamp, size } => {
                let begun = if band.top == 0 { Some(Growing::begin(&file, size, &stamp)?) } else { bands.take() };
                let Some(mut begun) = begun else { continue };
                begun.push(&band.film.to_rgb8(transfer))?;
                if band.top + band.film.height() < size[1] {
                    bands = Some(begun);
                } else {
                    let hash = begun.finish()?;
                    end(made.told, hash, json, bar)?;
                    made.claim.into_iter().for_each(Claim::done);
                }
                continue;
            }
            Body::Frame { film, transfer, files, moving: Some((rate, count)), .. } => {
                let Some((path, stamp, _)) = files.into_iter().next() else { continue };
                let wrong = |why: String| film::Error::Encode { path: path.clone(), why };
                let picture = film.to_rgb8(transfer);
                // Of a picture that one of its frames has failed, no more frames come.
                let mut all = if let Some(all) = begun.take().filter(|all| all.path == path) {
                    all
                } else {
                    let size = picture.dimensions().into();
                    let moving = Moving::new(size, count, rate, &stamp).map_err(wrong)?;
                    Begun { path: path.clone(), moving, frames: 0 }
                };
                all.moving.push(&picture).map_err(wrong)?;
                all.frames += 1;
                if all.frames < count {
                    begun = Some(all);
                    continue;
                }
                vec![(path.clone(), all.moving.finish().map_err(wrong)?)]
            }
            Body::Frame { film, transfer, layers, files, moving: None } => {
                let encoded = files.into_iter().map(|(path, stamp, pass)| {
                    let bytes = encode(&film, transfer, &layers, &path, &stamp, pass)?;
                    Ok((path, bytes))
                });
                encoded.collect::<Result<Vec<_>, Failure>>()?
            }
        };
        for (file, bytes) in &files {
            if file.as_os_str() == STDOUT {
                say(bytes)?;
            } else {
                replace(file, bytes)?;
            }
        }
        let hash = files.first().map_or_else(|| blake3::hash(b""), |(_, bytes)| blake3::hash(bytes));
        end(made.told, hash, json, bar)?;
        made.claim.into_iter().for_each(Claim::done);
    }
    Ok(())
}

/// Tells of a picture that is whole.
fn end(told: Option<Told>, hash: blake3::Hash, json: bool, bar: &ProgressBar) -> Result<(), Failure> {
    let Some(Told { mut report, sentence }) = told else { return Ok(()) };
    bar.suspend(|| eprintln!("{sentence}"));
    if json {
        report.insert("hash".to_owned(), hash.to_hex().to_string().into());
        say(serde_json::Value::Object(report).to_string() + "\n")?;
    }
    Ok(())
}

fn encode(
    film: &Film,
    transfer: Transfer,
    layers: &[Layer],
    path: &Path,
    stamp: &str,
    pass: Option<Pass>,
) -> Result<Vec<u8>, Failure> {
    let format = if path.as_os_str() == STDOUT { Format::Png } else { Format::of(path)? };
    let encoded = match pass.and_then(|pass| layers.iter().find(|layer| layer.pass == pass)) {
        _ if format == Format::Exr => exr::encode(film, layers, stamp),
        Some(layer) => format.encode(&layer.picture(film.width(), film.height(), transfer), stamp),
        None => format.encode(&film.to_rgb8(transfer), stamp),
    };
    Ok(encoded.map_err(|why| film::Error::Encode { path: path.to_owned(), why })?)
}
