//! what is seen -> files and the clipboard; a full-size render beside the window

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering::Relaxed};
use std::sync::mpsc::{Receiver, channel};

use eframe::egui;
use twinlight::film::{self, Watch, picture_of};
use twinlight::gpu::{Gpu, Screen, Wanted};
use twinlight::render::Work;
use twinlight::render::live::{Side, Wish};
use twinlight::render::{Backend, Error, Renderer};
use twinlight::scene::Reach;
use twinlight::view::desk::Desk;

/// The first name of the scene's with a number that no file has yet.
fn free(stem: &str) -> PathBuf {
    let named = |number: u32| PathBuf::from(format!("{stem}-{number}.png"));
    (1..=u32::MAX).map(named).find(|file| !file.exists()).unwrap_or_default()
}

fn stem(desk: &Desk) -> String {
    desk.path().file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

/// Writes the picture that is seen, and beside it the command that makes it; what was written.
pub(super) fn screenshot(desk: &Desk, gpu: &Gpu, screen: &Screen) -> Result<String, String> {
    let file = free(&stem(desk));
    let words = screen.read(gpu).map_err(|error| error.to_string())?;
    film::write_whole(&file, &picture_of(screen.size(), &words)).map_err(|error| error.to_string())?;
    let script = file.with_extension("sh");
    let command = desk.command(screen.size(), &file)?;
    let text = format!("#!/bin/sh\n# Makes {}.\n{command} --again\n", file.display());
    film::replace(&script, text.as_bytes()).map_err(|error| error.to_string())?;
    Ok(format!("{} is written; {} has the command that makes it", file.display(), script.display()))
}

/// Puts the picture that is seen into the clipboard.
pub(super) fn copy(ctx: &egui::Context, gpu: &Gpu, screen: &Screen) -> Result<String, String> {
    let words = screen.read(gpu).map_err(|error| error.to_string())?;
    let size = screen.size().map(|side| side as usize);
    let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
    ctx.copy_image(egui::ColorImage::from_rgba_unmultiplied(size, &bytes));
    Ok("the picture is in the clipboard".to_owned())
}

/// A render at the film's own size, beside the window.
pub(super) struct Full {
    thousandths: Arc<AtomicU32>,
    stop: Arc<AtomicBool>,
    end: Receiver<Result<String, String>>,
}

struct Told {
    thousandths: Arc<AtomicU32>,
    stop: Arc<AtomicBool>,
    ctx: egui::Context,
}

impl Watch for Told {
    fn done(&mut self, fraction: f64) -> ControlFlow<()> {
        self.thousandths.store((fraction * 1000.0) as u32, Relaxed);
        self.ctx.request_repaint();
        if self.stop.load(Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

impl Full {
    pub(super) fn new(ctx: &egui::Context, desk: &Desk, wanted: Wanted, reach: Reach) -> Self {
        let (thousandths, stop) = (Arc::new(AtomicU32::new(0)), Arc::new(AtomicBool::new(false)));
        let (tell, end) = channel();
        let mut told = Told { thousandths: Arc::clone(&thousandths), stop: Arc::clone(&stop), ctx: ctx.clone() };
        // With as much room as it wants, the film has its own size.
        let Wish { mut scene, method, side, .. } = desk.wish([f32::MAX; 2]);
        scene.film.size = desk.scene().film.size;
        let file = free(&format!("{}-full", stem(desk)));
        std::thread::spawn(move || {
            let backend = if side == Side::Gpu { Backend::Auto } else { Backend::Cpu };
            let made = (|| {
                let mut renderer = Renderer::open(backend, &wanted)?;
                renderer.make(&Work::within(&scene, method, &reach)?, &mut told)
            })();
            let written = match made {
                Ok(made) => write(&file, &made.film, scene.film.transfer),
                Err(Error::Stopped) => Ok("the render is cancelled".to_owned()),
                Err(error) => Err(error.to_string()),
            };
            // The window may be gone.
            let _ = tell.send(written);
            told.ctx.request_repaint();
        });
        Self { thousandths, stop, end }
    }

    /// How far it is, from 0 to 1.
    pub(super) fn fraction(&self) -> f32 {
        self.thousandths.load(Relaxed) as f32 / 1000.0
    }

    pub(super) fn cancel(&self) {
        self.stop.store(true, Relaxed);
    }

    /// How it ended, once it has.
    pub(super) fn end(&self) -> Option<Result<String, String>> {
        self.end.try_recv().ok()
    }
}

fn write(file: &Path, film: &film::Film, transfer: film::Transfer) -> Result<String, String> {
    film::write_whole(file, &film.to_rgb8(transfer)).map_err(|error| error.to_string())?;
    Ok(format!("{} is written, {} x {}", file.display(), film.width(), film.height()))
}
