//! how far the work is -> a bar, lines of JSON, or nothing

use std::ops::ControlFlow;
use std::sync::Mutex;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

use crate::stop::Stop;

/// How progress is told, on stderr.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, clap::ValueEnum)]
pub(crate) enum Kind {
    /// A bar with the time left, on a terminal; nothing on a pipe.
    #[default]
    Bar,
    /// Lines of JSON: picture, its number, of how many, and the fraction of all that is done; `building` in its place is
    /// the fraction of the picture's tree, if that takes longer than a moment.
    Json,
    /// Nothing.
    None,
}

/// The progress of a call.
#[derive(Debug)]
pub(crate) struct Progress {
    kind: Kind,
    bar: ProgressBar,
    pictures: usize,
    number: usize,
    name: String,
    told: Option<Instant>,
}

/// What takes longer than this is told.
const MOMENT: Duration = Duration::from_millis(500);
const EVERY: Duration = Duration::from_millis(200);

impl Progress {
    pub(crate) fn new(kind: Kind, pictures: usize) -> Self {
        let bar = if kind == Kind::Bar { bar("rendering") } else { ProgressBar::hidden() };
        Self { kind, bar, pictures: pictures.max(1), number: 0, name: String::new(), told: None }
    }

    /// The next picture begins.
    pub(crate) fn begin(&mut self, number: usize, name: &str) {
        (self.number, self.name) = (number, name.to_owned());
        if self.pictures > 1 {
            self.bar.set_message(format!("{name} ({} of {})", number + 1, self.pictures));
        }
        self.told = None;
        self.done(0.0);
    }

    /// So much of the picture is done.
    pub(crate) fn done(&mut self, fraction: f64) {
        let all = (self.number as f64 + fraction) / self.pictures as f64;
        self.bar.set_prefix("");
        self.bar.set_position((all * 1000.0) as u64);
        if self.kind == Kind::Json && (due(&mut self.told) || fraction >= 1.0) {
            let line = serde_json::json!({
                "picture": self.name, "number": self.number + 1, "of": self.pictures, "done": all
            });
            eprintln!("{line}");
        }
    }

    /// For who builds a tree: tells how much of it is there once that takes longer than a moment, and when to stop.
    pub(crate) fn building<'a>(&self, stop: &'a Stop) -> impl Fn(f64) -> ControlFlow<()> + Sync + use<'a> {
        let (bar, begun, told) = (self.bar.clone(), Instant::now(), Mutex::new(None));
        let picture = (self.kind == Kind::Json).then(|| (self.name.clone(), self.number + 1, self.pictures));
        move |share| {
            if begun.elapsed() > MOMENT {
                bar.set_prefix(format!(" (building the tree: {:.0} %)", share * 100.0));
                // Whoever finds it locked is being told.
                if let (Some((name, number, of)), Ok(mut told)) = (&picture, told.try_lock())
                    && due(&mut told)
                {
                    let line =
                        serde_json::json!({ "picture": name, "number": number, "of": of, "building": share });
                    eprintln!("{line}");
                }
            }
            if stop.why().is_some() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        }
    }

    /// A line of words, above the bar.
    pub(crate) fn say(&self, line: &str) {
        self.bar.suspend(|| eprintln!("{line}"));
    }

    /// Does something that writes to stderr, without the bar.
    pub(crate) fn suspend(&self, write: impl FnOnce()) {
        self.bar.suspend(write);
    }

    /// The bar, for who writes from another thread.
    pub(crate) fn bar(&self) -> ProgressBar {
        self.bar.clone()
    }

    pub(crate) fn end(&self) {
        self.bar.finish_and_clear();
    }
}

/// Whether it is time to tell something again; then it is told now.
fn due(told: &mut Option<Instant>) -> bool {
    let due = told.is_none_or(|told| told.elapsed() >= EVERY);
    if due {
        *told = Some(Instant::now());
    }
    due
}

/// A bar with the time left, on a terminal; nothing on a pipe.
pub(crate) fn bar(what: &str) -> ProgressBar {
    let style = ProgressStyle::with_template("{msg}{prefix} [{bar:30}] {percent}%, {eta} left");
    let bar = ProgressBar::new(1000).with_message(what.to_owned());
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()).progress_chars("=> "));
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}
