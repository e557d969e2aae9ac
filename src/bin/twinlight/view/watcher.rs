//! the system's word that files have changed -> what is to be read again

use std::path::PathBuf;
use std::sync::mpsc::{Receiver, channel};
use std::time::Instant;

use eframe::egui;
use notify::{RecommendedWatcher, RecursiveMode, Watcher as _};
use twinlight::view::watch::Changes;

/// Watches the files of a scene, and the kernels' if they are at hand.
pub(super) struct Watcher {
    /// Nothing where the system cannot watch: then F5 does it.
    eyes: Option<RecommendedWatcher>,
    events: Receiver<Vec<PathBuf>>,
    pub(super) scene: Changes,
    pub(super) kernels: Changes,
}

impl Watcher {
    pub(super) fn new(ctx: &egui::Context) -> Self {
        let (tell, events) = channel();
        let ctx = ctx.clone();
        let eyes = notify::recommended_watcher(move |event: notify::Result<notify::Event>| {
            if let Ok(event) = event
                && !event.kind.is_access()
            {
                // The window may be gone.
                let _ = tell.send(event.paths);
                ctx.request_repaint();
            }
        });
        Self { eyes: eyes.ok(), events, scene: Changes::default(), kernels: Changes::default() }
    }

    /// The files of a scene, from now on.
    pub(super) fn about_scene(&mut self, files: Vec<PathBuf>) {
        self.scene.about(files);
        self.look();
    }

    /// The files of kernels, from now on.
    pub(super) fn about_kernels(&mut self, files: Vec<PathBuf>) {
        self.kernels.about(files);
        self.look();
    }

    fn look(&mut self) {
        let Some(eyes) = &mut self.eyes else { return };
        for folder in self.scene.folders().union(&self.kernels.folders()) {
            // Asked for twice it is watched once; a folder that is gone has nothing to tell.
            let _ = eyes.watch(folder, RecursiveMode::NonRecursive);
        }
    }

    /// Takes in what has happened; asks to be called again while a file may not be whole yet.
    pub(super) fn listen(&mut self, ctx: &egui::Context) {
        let now = Instant::now();
        for files in self.events.try_iter() {
            let files: Vec<_> = files.into_iter().map(|file| file.canonicalize().unwrap_or(file)).collect();
            self.scene.notice(&files, now);
            self.kernels.notice(&files, now);
        }
        if self.scene.pending() || self.kernels.pending() {
            ctx.request_repaint_after(std::time::Duration::from_millis(50));
        }
    }
}
