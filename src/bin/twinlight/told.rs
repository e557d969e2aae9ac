//! pictures that are made, or would be -> what is said of them: a sentence, and an object of JSON

use std::time::Duration;

use twinlight::render::{Made, Rendered};
use twinlight::scene::Method;

use crate::call::{Call, Ready};
use crate::plan::Picture;
use crate::progress::Progress;
use crate::writer::{Report, Told};

/// What is told of how a picture was made.
#[derive(Debug)]
pub(crate) struct Sum {
    by: String,
    took: Duration,
    notes: Vec<String>,
    /// Of a pixel, in the mean.
    samples: f64,
    broken: u32,
}

impl Sum {
    pub(crate) fn of(rendered: &Rendered) -> Self {
        let Rendered { film, by, took, notes } = rendered;
        Self {
            by: by.clone(),
            took: *took,
            notes: notes.clone(),
            samples: film.mean_samples(),
            broken: film.broken(),
        }
    }

    pub(crate) fn of_bands(Made { by, took, notes }: Made, samples: f64, broken: u32) -> Self {
        Self { by, took, notes, samples, broken }
    }
}

impl Call<'_> {
    /// What is told of a picture that was made.
    pub(crate) fn told(
        &self,
        picture: &Picture,
        ready: &Ready,
        stamp: &str,
        made: &Sum,
        progress: &Progress,
    ) -> Told {
        for note in &made.notes {
            progress.say(&format!("note: {note}"));
        }
        if made.broken > 0 {
            progress.say(&format!("warning: {} pixels are not finite numbers and are drawn black", made.broken));
        }
        let mut report = self.report(picture, ready, stamp);
        let seconds = made.took.as_secs_f64();
        let more = [
            ("backend", made.by.clone().into()),
            ("seconds", seconds.into()),
            ("samples", made.samples.into()),
            ("notes", made.notes.clone().into()),
            ("broken", made.broken.into()),
            ("made", true.into()),
        ];
        report.extend(more.map(|(name, value)| (name.to_owned(), value)));
        let (name, [width, height]) = (picture.name(), ready.work.size());
        let sentence = format!("{name}: {width}x{height} in {seconds:.2} s on {}", made.by);
        let told = self.arguments.time.is_some() || self.arguments.noise.is_some();
        let sentence = if told { format!("{sentence}, {} samples a pixel", made.samples) } else { sentence };
        Told { report, sentence }
    }

    /// What is told of every picture, made or not.
    pub(crate) fn report(&self, picture: &Picture, ready: &Ready, stamp: &str) -> Report {
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
            _ => Report::new(),
        }
    }
}
