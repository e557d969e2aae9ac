//! the window: what was done in it -> wishes to the worker, and the worker's pictures

use std::path::Path;
use std::sync::mpsc::Receiver;
use std::sync::{Arc, PoisonError};

use eframe::egui;
use eframe::egui_wgpu::RenderState;
use twinlight::film::Saved;
use twinlight::gpu::Gpu;
use twinlight::gpu::wgsl::{FILES, Sources};
use twinlight::view::desk::Desk;
use twinlight::view::inspector::{Inspector, Question};
use twinlight::view::keys::Command;
use twinlight::view::overlay::Line;
use twinlight::view::worker::{Inside, Order, Report, Worker};

use super::lights::Lights;
use super::out::{self, Full};
use super::picture::Picture;
use super::shell::Left;
use super::stage::{Beside, Compared};
use super::watcher::Watcher;
use super::{Arguments, hand};
use crate::job::Failure;

/// The window.
pub(super) struct App {
    pub(super) arguments: Arguments,
    pub(super) state: RenderState,
    pub(super) gpu: Arc<Gpu>,
    pub(super) worker: Worker,
    pub(super) sources: Arc<Sources>,
    pub(super) watcher: Watcher,
    pub(super) inspector: Inspector,
    pub(super) desk: Option<Desk>,
    pub(super) picture: Picture,
    pub(super) report: Report,
    pub(super) compared: Option<Compared>,
    /// A scene that is being read, and whether it is the one that is there.
    pub(super) coming: Option<(bool, Receiver<Result<Desk, String>>)>,
    pub(super) full: Option<Full>,
    /// What went wrong, until something goes right.
    pub(super) error: Option<String>,
    /// What went right.
    pub(super) note: Option<String>,
    /// Pixels that there is room for.
    pub(super) room: [f32; 2],
    pub(super) changed: bool,
    pub(super) panels: bool,
    /// The search in the list of keys, while it is open.
    pub(super) help: Option<String>,
    /// What made a pixel, while that is wanted.
    pub(super) inspected: Option<Inspected>,
    /// What else is told of the picture.
    pub(super) inside: Inside,
    /// A picture to compare with.
    pub(super) saved: Option<Arc<Saved>>,
    pub(super) lights: Lights,
    /// For the window after this one.
    left: Left,
    title: String,
}

/// What made a pixel.
#[derive(Debug, Default)]
pub(super) struct Inspected {
    pub(super) pixel: [u32; 2],
    pub(super) text: String,
    /// Over the picture.
    pub(super) lines: Vec<Line>,
}

/// Where the kernels lie that can be tried out without building anew.
pub(super) const KERNELS: &str = "wgsl";

impl App {
    pub(super) fn new(
        cc: &eframe::CreationContext<'_>,
        arguments: &Arguments,
        left: Left,
    ) -> Result<Self, Failure> {
        let state = cc.wgpu_render_state.clone();
        let state = state.ok_or_else(|| Failure::Window("the window has no GPU device".to_owned()))?;
        let gpu = Arc::new(Gpu::share(state.adapter.clone(), state.device.clone(), state.queue.clone()));
        let ctx = &cc.egui_ctx;
        let wake = || -> Box<dyn Fn() + Send + Sync> {
            let ctx = ctx.clone();
            Box::new(move || ctx.request_repaint())
        };
        let mut app = Self {
            arguments: arguments.clone(),
            state,
            worker: Worker::new(Arc::clone(&gpu), wake()),
            gpu,
            sources: Arc::new(Sources::default()),
            watcher: Watcher::new(ctx),
            inspector: Inspector::new(wake()),
            desk: None,
            picture: Picture::default(),
            report: Report::default(),
            compared: None,
            coming: None,
            full: None,
            error: None,
            note: None,
            room: [0.0; 2],
            changed: false,
            panels: true,
            help: None,
            inspected: None,
            inside: Inside::default(),
            saved: None,
            lights: Lights::default(),
            left,
            title: String::new(),
        };
        if Path::new(KERNELS).join("film/develop.wgsl").is_file() {
            let files = FILES.iter().map(|(name, _)| Path::new(KERNELS).join(name).with_extension("wgsl"));
            app.watcher.about_kernels(files.collect());
        }
        if let Some(seconds) = arguments.lose_device_after {
            let (device, ctx) = (app.gpu.device().clone(), ctx.clone());
            std::thread::spawn(move || {
                std::thread::sleep(std::time::Duration::from_secs(seconds));
                device.destroy();
                ctx.request_repaint();
            });
        }
        if arguments.losses > 0 {
            let name = &app.gpu.adapter().name;
            app.note = Some(format!("{name} was lost; this is a new device, and nothing that you did is gone"));
        }
        if let Some(path) = arguments.scene.clone() {
            app.load(ctx, path, arguments.job.edits()?, false);
        }
        if let Some(path) = &arguments.beside {
            app.hold_against(ctx, path);
        }
        Ok(app)
    }

    pub(super) fn say(&mut self, what: Result<String, String>) {
        match what {
            Ok(note) => (self.note, self.error) = (Some(note), None),
            Err(error) => self.error = Some(error),
        }
    }

    pub(super) fn obey(&mut self, ctx: &egui::Context, command: Command) {
        match command {
            Command::Help => self.help = if self.help.is_some() { None } else { Some(String::new()) },
            Command::Panels => self.panels = !self.panels,
            Command::Reload => self.reload(ctx),
            Command::Inspect => {
                self.inspected = if self.inspected.is_some() { None } else { Some(Inspected::default()) };
            }
            Command::Cancel => {
                if let Some(full) = &self.full {
                    full.cancel();
                } else if self.help.take().is_none() && self.inspected.take().is_none() {
                    self.compared = None;
                }
            }
            Command::Times => (self.inside.times, self.changed) = (!self.inside.times, true),
            Command::Lights => (self.inside.lights, self.changed) = (!self.inside.lights, true),
            Command::Compare => {
                let beside = self.compared.as_ref().map_or(Beside::Nothing, |compared| compared.beside.clone());
                self.compare(ctx, beside.next(self.saved.as_ref()));
            }
            Command::Difference => {
                if let Some(compared) = &mut self.compared {
                    compared.difference = !compared.difference;
                }
            }
            command => self.obey_about_scene(ctx, command),
        }
    }

    fn obey_about_scene(&mut self, ctx: &egui::Context, command: Command) {
        let Some(desk) = &mut self.desk else { return };
        match command {
            Command::Save => {
                let saved = desk.save().map(|file| format!("{} is saved", file.display()));
                self.say(saved);
            }
            Command::CopyCamera => {
                ctx.copy_text(desk.camera_toml());
                self.say(Ok("the camera is in the clipboard".to_owned()));
            }
            Command::PasteCamera => {
                let pasted = ctx.input(|input| {
                    let mut texts = input.raw.events.iter().filter_map(|event| match event {
                        egui::Event::Paste(text) => Some(text.clone()),
                        _ => None,
                    });
                    texts.next_back()
                });
                let pasted = pasted.map_or(Ok(()), |text| desk.paste_camera(&text));
                self.changed = true;
                self.say(pasted.map(|()| "the camera comes from the clipboard".to_owned()));
            }
            Command::Screenshot | Command::CopyPicture => {
                let Some(screen) = self.picture.screen() else { return };
                let done = match command {
                    Command::Screenshot => out::screenshot(desk, &self.gpu, screen),
                    _ => out::copy(ctx, &self.gpu, screen),
                };
                self.say(done);
            }
            Command::Render if self.full.is_none() => {
                self.full = Some(Full::new(ctx, desk, self.arguments.job.wanted(), self.arguments.reach()));
            }
            command => {
                desk.obey(command);
                self.changed = true;
            }
        }
    }

    pub(super) fn compare(&mut self, ctx: &egui::Context, beside: Beside) {
        self.compared = (beside != Beside::Nothing).then(|| Compared::new(&self.gpu, ctx, beside));
        self.changed = true;
    }

    /// The device is lost, and with it all that this window shows: another one goes on.
    fn leave(&mut self) {
        let mut left = self.left.lock().unwrap_or_else(PoisonError::into_inner);
        let desk = self.desk.take().and_then(|desk| desk.words(&[]).ok());
        let mut words = desk.or_else(|| Some(vec![self.arguments.scene.as_ref()?.to_string_lossy().into_owned()]));
        let machine = [self.arguments.job.about_machine(), self.arguments.keep.as_arguments()];
        words.get_or_insert_default().extend(machine.concat());
        *left = left.take().or(words);
    }

    /// Asks for the picture as it is to be now.
    pub(super) fn ask(&mut self) {
        let Some(desk) = &self.desk else { return };
        let reach = self.arguments.reach();
        let order =
            Order { wish: desk.wish(self.room), sources: Arc::clone(&self.sources), reach, inside: self.inside };
        if let Some(compared) = &self.compared {
            compared.ask(&order);
        }
        self.worker.ask(order);
    }

    /// The window's title says what is seen, and whether it is still being made.
    fn entitle(&mut self, ctx: &egui::Context) {
        let name =
            self.desk.as_ref().and_then(|desk| desk.path().file_name()).unwrap_or_default().to_string_lossy();
        let work = if self.report.busy || self.coming.is_some() { " (at work)" } else { "" };
        let title = format!("{name} - Twinlight{work}");
        if title != self.title {
            ctx.send_viewport_cmd(egui::ViewportCommand::Title(title.clone()));
            self.title = title;
        }
    }

    /// Asks about a pixel.
    pub(super) fn question(&self, pixel: [u32; 2], point: bool) {
        let Some(desk) = &self.desk else { return };
        let (wish, reach) = (desk.wish(self.room), self.arguments.reach());
        self.inspector.ask(Question { scene: wish.scene, method: wish.method, pixel, reach, point });
    }
}

impl Drop for App {
    /// The device may be lost between a frame's beginning and its end: then egui's painter panics.
    fn drop(&mut self) {
        if std::thread::panicking() || self.gpu.is_lost() {
            self.leave();
        }
    }
}

impl eframe::App for App {
    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        let ctx = ui.ctx().clone();
        if self.gpu.is_lost() {
            self.leave();
            ctx.send_viewport_cmd(egui::ViewportCommand::Close);
            return;
        }
        self.listen(&ctx);
        for command in hand::commands(&ctx) {
            self.obey(&ctx, command);
        }
        self.show(ui);
        self.entitle(&ctx);
    }
}
