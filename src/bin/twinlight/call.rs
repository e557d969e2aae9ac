//! a call's pictures, one after the other -> films on their way to files

use std::collections::BTreeSet;
use std::ops::{ControlFlow, Range};
use std::path::PathBuf;
use std::time::Duration;

use twinlight::film::ledger::{Ledger, Reader};
use twinlight::film::pass::Pass;
use twinlight::film::{self, Format, stamp_of};
use twinlight::prepare::bvh::Told;
use twinlight::render::{Good, Renderer, Work};
use twinlight::scene::{MOST_SAMPLES, Method, Scene, Source};
use twinlight::trace::BLOCK;

use crate::claim::Claim;
use crate::eye::Eye;
use crate::job::{Failure, say};
use crate::plan::Picture;
use crate::progress::Progress;
use crate::render::Arguments;
use crate::stop::Stop;
use crate::told::Sum;
use crate::writer::{Body, Made, STDOUT, Writer};

/// All that a call's pictures share.
pub(crate) struct Call<'a> {
    pub(crate) arguments: &'a Arguments,
    pub(crate) sources: &'a [Source],
    pub(crate) stop: &'a Stop,
}

/// A frame that is ready to be made.
pub(crate) struct Ready {
    pub(crate) scene: Scene,
    pub(crate) method: Method,
    pub(crate) work: Work,
}

impl Ready {
    /// Where runs of the picture are kept for a later try, if they can be.
    pub(crate) fn ledger(&self, claim: &Claim, stamp: &str) -> Option<Ledger> {
        let subject = self.work.subject(stamp)?;
        claim.file().and_then(|file| Ledger::open(file, &subject)).ok()
    }
}

impl Call<'_> {
    fn ready(&self, picture: &Picture, frame: i64, told: &Told<'_>) -> Result<Ready, Failure> {
        let (mut scene, method) = self.arguments.job.scene(&self.sources[picture.scene], frame)?;
        let good = Good { time: self.arguments.time, noise: self.arguments.noise };
        if good != Good::default() && self.arguments.job.samples.is_none() {
            scene.trace.samples = MOST_SAMPLES;
        }
        let Arguments { job, keep, dry_run, .. } = self.arguments;
        // What only says what would be made keeps nothing.
        let reach = if *dry_run { job.input.reach() } else { keep.reach(&job.input) };
        let work = Work::watched(&scene, method, &reach, told).map_err(|error| self.stopped(error))?;
        let work = work.until(good)?.having(&self.arguments.passes)?;
        let work = match &self.arguments.crop {
            Some([columns, rows]) => work.crop(columns.clone(), rows.clone())?,
            None => work,
        };
        Ok(Ready { scene, method, work })
    }

    /// What the picture is known by, with its first frame.
    fn stamp(&self, picture: &Picture, class: &str, told: &Told<'_>) -> Result<(String, Ready), Failure> {
        let first = self.ready(picture, picture.frames[0], told)?;
        if let [_] = picture.frames[..] {
            return Ok((format!("{} {class}", first.work.digest()), first));
        }
        let mut all = blake3::Hasher::new();
        for &frame in &picture.frames {
            all.update(self.ready(picture, frame, told)?.work.digest().to_string().as_bytes());
        }
        Ok((format!("{} {class}", all.finalize().to_hex()), first))
    }

    /// The files of a picture, and what each of them is known by.
    fn files(&self, picture: &Picture, stamp: &str) -> Vec<(PathBuf, String, Option<Pass>)> {
        let Some(file) = &picture.file else { return vec![(STDOUT.into(), stamp.to_owned(), None)] };
        let passes = &self.arguments.passes;
        let names = |passes: &[Pass]| passes.iter().flat_map(|pass| [" +", pass.name()]).collect::<String>();
        if matches!(Format::of(file), Ok(Format::Exr)) {
            return vec![(file.clone(), format!("{stamp}{}", names(passes)), None)];
        }
        let ending = file.extension().unwrap_or_default().to_string_lossy();
        let beside = passes.iter().map(|&pass| {
            (
                file.with_extension(format!("{}.{ending}", pass.name())),
                stamp.to_owned() + &names(&[pass]),
                Some(pass),
            )
        });
        std::iter::once((file.clone(), stamp.to_owned(), None)).chain(beside).collect()
    }

    fn is_made(&self, picture: &Picture, stamp: &str, ready: &Ready) -> bool {
        let files = self.files(picture, stamp);
        let there = |(file, stamp, _): &(PathBuf, String, _)| {
            if let Some(range) = &self.arguments.sample_range {
                let subject = ready.work.subject(stamp);
                let subject = subject.map(|all| film::ledger::Subject { from: range.start, to: range.end, ..all });
                let there = std::fs::File::open(file).ok().and_then(Reader::new);
                return there.is_some_and(|there| Some(there.subject()) == subject.as_ref());
            }
            // Of a dry run it is not known who will make it.
            stamp_of(file)
                .is_some_and(|there| there == *stamp || (stamp.ends_with(' ') && there.starts_with(stamp)))
        };
        !self.arguments.again && picture.file.is_some() && files.iter().all(there)
    }

    /// Says what would become of a picture.
    pub(crate) fn foretell(&self, picture: &Picture) -> Result<(), Failure> {
        let (stamp, ready) = self.stamp(picture, "", &|_| ControlFlow::Continue(()))?;
        let (name, [width, height]) = (picture.name(), ready.work.size());
        let made = self.is_made(picture, &stamp, &ready);
        if self.arguments.json {
            let mut report = self.report(picture, &ready, &stamp);
            report.insert("there".to_owned(), made.into());
            say(serde_json::Value::Object(report).to_string() + "\n")?;
        } else {
            let verdict = if made { "is there" } else { "would be made" };
            say(format!("{name}: {width}x{height}, {verdict}\n"))?;
        }
        Ok(())
    }

    /// Makes all pictures; `fail` is told of those that one scene has spoiled.
    pub(crate) fn make_all(&self, pictures: &[Picture], fail: &mut dyn FnMut(Failure)) -> Result<(), Failure> {
        let arguments = self.arguments;
        let mut renderer = Renderer::open(arguments.backend, &arguments.job.wanted())?;
        let folders: BTreeSet<_> = pictures.iter().filter_map(|p| p.file.as_deref()).map(film::folder_of).collect();
        folders.into_iter().for_each(film::sweep);
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
            claim = Claim::take(file).map_err(|source| film::Error::Write { path: file.clone(), source })?;
            if claim.is_none() {
                return Ok(false);
            }
        }
        let told = progress.building(self.stop);
        let (stamp, first) = self.stamp(picture, &renderer.class(), &told)?;
        if self.is_made(picture, &stamp, &first) {
            if self.arguments.json {
                say(serde_json::Value::Object(self.report(picture, &first, &stamp)).to_string() + "\n")?;
            }
            progress.say(&format!("{}: is there already", picture.name()));
            claim.into_iter().for_each(Claim::done);
            return Ok(true);
        }
        if let Some(range) = &self.arguments.sample_range {
            self.part(picture, range, first, &stamp, claim, renderer, progress, writer)?;
            return Ok(true);
        }
        if let Some(rows) = self.band(picture, &first) {
            self.in_bands(picture, rows, first, &stamp, claim, renderer, progress, writer)?;
            return Ok(true);
        }
        self.fits(picture, &first)?;
        let rate = self.sources[picture.scene].frames().map_or(24.0, |(_, rate)| rate);
        let count = picture.frames.len();
        let moving = (count > 1).then_some((rate, count as u32));
        if moving.is_some() && !self.arguments.passes.is_empty() {
            return Err(Failure::Usage(
                "an animated picture has no passes; put {frame:4} into the name".to_owned(),
            ));
        }
        let mut first = Some(first);
        for (number, &frame) in picture.frames.iter().enumerate() {
            let ready = match first.take() {
                Some(ready) => ready,
                None => self.ready(picture, frame, &progress.building(self.stop))?,
            };
            let mut eye = Eye::new(self.stop, progress, number, count);
            // Of a frame that is drawn at once nothing is kept.
            if let (Some(claim), Method::Trace, None) = (&claim, ready.method, moving) {
                eye.ledger = ready.ledger(claim, &stamp);
            }
            let made = renderer.make(&ready.work, &mut eye);
            // Of a frame that is whole nothing needs to be kept, and its picture needs the room.
            if made.is_err() {
                eye.flush();
            }
            let rendered = made.map_err(|error| self.stopped(error))?;
            let layers = renderer.layers(&ready.work, &rendered.film, &self.arguments.passes, &mut eye);
            let layers = layers.map_err(|error| self.stopped(error))?;
            let stamp = restamped(&stamp, renderer);
            let mut told = self.told(picture, &ready, &stamp, &Sum::of(&rendered), progress);
            if count > 1 {
                told.sentence = format!("{} ({count} frames; this is the last one's time)", told.sentence);
            }
            let files = self.files(picture, &stamp);
            let film = Box::new(rendered.film);
            let body = Body::Frame { film, transfer: ready.scene.film.transfer, layers, files, moving };
            let claim = if number + 1 == count { claim.take() } else { None };
            if !writer.take(Made { body, told: Some(told), claim }) {
                break;
            }
        }
        Ok(true)
    }

    /// Makes some of a picture's samples, block by block, so that merging can add them in their order.
    #[expect(clippy::too_many_arguments, reason = "they are one picture's, and used here alone")]
    fn part(
        &self,
        picture: &Picture,
        range: &Range<u32>,
        ready: Ready,
        stamp: &str,
        claim: Option<Claim>,
        renderer: &mut Renderer,
        progress: &mut Progress,
        writer: &Writer,
    ) -> Result<(), Failure> {
        // The first part's sums can be added to as they are; those of the others are kept apart.
        let step = if range.start == 0 { range.end } else { BLOCK };
        let blocks: Vec<_> = (range.start..range.end)
            .step_by(step as usize)
            .map(|start| start..range.end.min(start.saturating_add(step)))
            .collect();
        let mut work = ready.work.samples(range.clone())?;
        let subject = work.subject(stamp).ok_or(twinlight::render::Error::Samples(0))?;
        let mut runs = Vec::new();
        let mut last = None;
        for (number, block) in blocks.iter().enumerate() {
            work = work.samples(block.clone())?;
            let mut eye = Eye::new(self.stop, progress, number, blocks.len());
            eye.runs = Some(Vec::new());
            let rendered = renderer.make(&work, &mut eye).map_err(|error| self.stopped(error))?;
            runs.extend(eye.runs.unwrap_or_default().into_iter().filter(|run| run.samples == *block));
            last = Some(rendered);
        }
        let Some(rendered) = last else { return Ok(()) };
        if restamped(stamp, renderer) != stamp {
            // The GPU gave up midway: parts of two kinds would not fit together.
            return Err(Failure::Usage("the GPU failed; make this part again with --backend cpu".to_owned()));
        }
        let bytes = film::ledger::written(&subject, &runs);
        let ready = Ready { work, ..ready };
        let told = Some(self.told(picture, &ready, stamp, &Sum::of(&rendered), progress));
        let file = picture.file.clone().unwrap_or_default();
        writer.take(Made { body: Body::Part { file, bytes }, told, claim });
        Ok(())
    }

    /// Why work was not done: the signal or the deadline, if there was one.
    pub(crate) fn stopped(&self, error: twinlight::render::Error) -> Failure {
        self.stop.why().unwrap_or(error.into())
    }
}

/// The stamp by who has done the work: a GPU that fails is left for the CPU.
pub(crate) fn restamped(stamp: &str, renderer: &Renderer) -> String {
    format!("{} {}", stamp.split(' ').next().unwrap_or_default(), renderer.class())
}
