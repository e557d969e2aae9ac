//! what comes from elsewhere -> the window: scenes, changed and dropped files, pictures, answers

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::channel;

use eframe::egui;
use twinlight::film::{Saved, is_picture};
use twinlight::gpu::wgsl::Sources;
use twinlight::view::desk::Desk;
use twinlight::view::inspector::Answer;
use twinlight::view::keys::Command;

use super::app::{App, Inspected, KERNELS};
use super::out::Full;
use super::stage::Beside;

impl App {
    /// Reads a scene beside the window.
    pub(super) fn load(&mut self, ctx: &egui::Context, path: PathBuf, edits: Vec<(String, String)>, again: bool) {
        let (tell, told) = channel();
        let (reach, ctx) = (self.arguments.reach(), ctx.clone());
        std::thread::spawn(move || {
            let read = Desk::open(&path, &edits, &reach).map_err(|error| error.to_string());
            // The window may be gone.
            let _ = tell.send(read);
            ctx.request_repaint();
        });
        self.coming = Some((again, told));
    }

    /// Reads the scene again; what was put in by hand stays.
    pub(super) fn reload(&mut self, ctx: &egui::Context) {
        if let Some(desk) = &self.desk {
            let (path, edits) = (desk.path().to_owned(), desk.draft().edits().to_vec());
            self.load(ctx, path, edits, true);
        } else if let Some(path) = self.arguments.scene.clone() {
            let edits = self.arguments.job.edits().unwrap_or_default();
            self.load(ctx, path, edits, false);
        }
    }

    /// Takes in what has come from elsewhere: scenes, changed files, dropped files, pictures, answers.
    pub(super) fn listen(&mut self, ctx: &egui::Context) {
        self.watcher.listen(ctx);
        if self.watcher.scene.settled(std::time::Instant::now()) {
            self.reload(ctx);
        }
        if self.watcher.kernels.settled(std::time::Instant::now()) {
            match Sources::of_folder(Path::new(KERNELS)) {
                Ok(sources) => {
                    self.sources = Arc::new(sources);
                    self.changed = true;
                }
                Err(error) => self.error = Some(format!("{KERNELS}: {error}")),
            }
        }
        let dropped = ctx.input(|input| input.raw.dropped_files.first().map(|file| file.path().to_owned()));
        match dropped {
            Some(path) if is_picture(&path) => self.hold_against(ctx, &path),
            Some(path) => self.load(ctx, path, Vec::new(), false),
            None => {}
        }
        if let Some((again, Ok(read))) = self.coming.as_ref().map(|(again, told)| (*again, told.try_recv())) {
            self.coming = None;
            self.arrive(read, again);
        }
        while let Some(answer) = self.inspector.answer() {
            match answer {
                Answer::Text(pixel, text, lines) if self.inspected.is_some() => {
                    self.inspected = Some(Inspected { pixel, text, lines });
                }
                Answer::Point(Ok(Some(point))) => {
                    if let Some(desk) = &mut self.desk {
                        desk.set_pivot(point);
                        self.changed = true;
                    }
                }
                Answer::Point(Err(why)) => self.error = Some(why),
                _ => {}
            }
        }
        if let Some(end) = self.full.as_ref().and_then(Full::end) {
            self.full = None;
            self.say(end);
        }
        let report = self.worker.report();
        if report.notes != self.report.notes {
            report.notes.iter().for_each(|note| eprintln!("note: {note}"));
        }
        self.report = report;
        self.picture.take(&self.state, self.report.screen.clone());
        self.lights.take(ctx, &self.report.lights);
        if let Some(compared) = &mut self.compared {
            compared.listen(&self.state);
        }
    }

    /// Looks after the files of the scene that is there.
    pub(super) fn watch(&mut self) {
        if let Some(desk) = &self.desk {
            self.watcher.about_scene(desk.files());
        }
    }

    fn arrive(&mut self, read: Result<Desk, String>, again: bool) {
        match read {
            Ok(read) => {
                self.error = None;
                self.changed = true;
                let (method, show) = self.arguments.job.asked();
                match &mut self.desk {
                    Some(desk) if again => {
                        if desk.renew(read) {
                            let why = "the file has changed: what was done before that cannot be undone";
                            self.note = Some(why.to_owned());
                        }
                    }
                    desk => {
                        let mut read = read.with(method, self.arguments.backend);
                        if self.arguments.losses > 0 {
                            read = read.with_unsaved_edits();
                        }
                        if let Some(show) = show {
                            read.obey(Command::Show(show));
                        }
                        *desk = Some(read);
                    }
                }
                self.watch();
            }
            Err(error) => self.error = Some(error),
        }
    }

    /// Compares with a picture that was saved.
    pub(super) fn hold_against(&mut self, ctx: &egui::Context, path: &Path) {
        match Saved::open(path) {
            Ok(saved) => {
                let saved = Arc::new(saved);
                self.saved = Some(Arc::clone(&saved));
                self.compare(ctx, Beside::Saved(saved));
            }
            Err(error) => self.error = Some(error),
        }
    }
}
