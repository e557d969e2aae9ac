//! the picture, as large as there is room, and another beside it

use std::sync::Arc;

use eframe::egui::{self, Color32};
use eframe::egui_wgpu::RenderState;
use twinlight::film::Saved;
use twinlight::film::compare::Standard;
use twinlight::gpu::{Gpu, Screen};
use twinlight::render::live::{Side, Wish};
use twinlight::scene::Method;
use twinlight::view::difference::difference;
use twinlight::view::overlay::{Line, Stroke};
use twinlight::view::worker::{Order, Report, Worker};

use super::picture::Picture;

/// What stands beside the picture.
#[derive(Debug, Clone, Default)]
pub(super) enum Beside {
    #[default]
    Nothing,
    /// The same by the other backend.
    Side,
    /// The same by the other method.
    Method,
    /// A picture that was saved.
    Saved(Arc<Saved>),
}

impl PartialEq for Beside {
    fn eq(&self, other: &Self) -> bool {
        std::mem::discriminant(self) == std::mem::discriminant(other)
    }
}

impl Beside {
    pub(super) fn next(self, saved: Option<&Arc<Saved>>) -> Self {
        match self {
            Self::Nothing => Self::Side,
            Self::Side => Self::Method,
            Self::Method => saved.map_or(Self::Nothing, |saved| Self::Saved(Arc::clone(saved))),
            Self::Saved(_) => Self::Nothing,
        }
    }

    /// The wish for what stands beside another.
    fn of(&self, wish: &Wish) -> Wish {
        let mut other = wish.clone();
        match self {
            Self::Side => other.side = if wish.side == Side::Gpu { Side::Cpu } else { Side::Gpu },
            Self::Method => {
                other.method = if wish.method == Method::Raster { Method::Trace } else { Method::Raster };
            }
            Self::Nothing | Self::Saved(_) => {}
        }
        other
    }

    fn names(&self, wish: &Wish) -> [String; 2] {
        if let Self::Saved(saved) = self {
            let [width, height] = saved.size();
            let file = saved.path().file_name().unwrap_or_default().to_string_lossy();
            let scaled = if saved.size() == wish.scene.film.size { "" } else { ", scaled" };
            return ["this".to_owned(), format!("{file}, {width} x {height}{scaled}")];
        }
        let name = |wish: &Wish| match self {
            Self::Method => format!("{:?}", wish.method),
            _ => format!("{:?}", wish.side).to_uppercase(),
        };
        [name(wish), name(&self.of(wish))]
    }
}

/// The other picture, and how the two are shown.
pub(super) struct Compared {
    pub(super) beside: Beside,
    worker: Worker,
    report: Report,
    picture: Picture,
    /// The saved picture with as many pixels as the other.
    saved: Option<([u32; 2], Vec<u32>, egui::TextureHandle)>,
    /// Where the one ends and the other begins.
    wipe: f32,
    /// Whether their difference is shown instead.
    pub(super) difference: bool,
    /// The difference of which two pictures it is, and what is said of it.
    found: Option<([u64; 2], egui::TextureHandle, String)>,
}

impl Compared {
    pub(super) fn new(gpu: &Arc<Gpu>, ctx: &egui::Context, beside: Beside) -> Self {
        let ctx = ctx.clone();
        let worker = Worker::new(Arc::clone(gpu), Box::new(move || ctx.request_repaint()));
        let (report, picture) = (Report::default(), Picture::default());
        Self { beside, worker, report, picture, saved: None, wipe: 0.5, difference: false, found: None }
    }

    /// What is said of the difference.
    #[cfg(test)]
    pub(super) fn words(&self) -> Option<&str> {
        self.found.as_ref().map(|(_, _, words)| words.as_str())
    }

    pub(super) fn ask(&self, order: &Order) {
        if matches!(self.beside, Beside::Saved(_)) {
            return;
        }
        self.worker.ask(Order { wish: self.beside.of(&order.wish), ..order.clone() });
    }

    pub(super) fn listen(&mut self, state: &RenderState) {
        self.report = self.worker.report();
        self.picture.take(state, self.report.screen.clone());
    }

    /// Draws the other picture right of the wipe, or the difference over all.
    pub(super) fn draw(&mut self, ui: &mut egui::Ui, rect: egui::Rect, wish: &Wish, own: &Report, gpu: &Gpu) {
        if let Beside::Saved(saved) = &self.beside {
            let size = wish.scene.film.size;
            if self.saved.as_ref().is_none_or(|(known, ..)| *known != size) {
                let words = saved.words(size);
                let texture = texture(ui.ctx(), "saved", size, &words);
                self.saved = Some((size, words, texture));
            }
        }
        let alone = ui.input(|input| input.key_down(egui::Key::Space));
        if self.difference {
            self.find(ui.ctx(), own, gpu);
            if let Some((_, texture, words)) = &self.found {
                ui.painter().image(texture.id(), rect, WHOLE, Color32::WHITE);
                tag(ui, rect.left_top(), egui::Align2::LEFT_TOP, words);
            }
            return;
        }
        let at = if alone { rect.left() } else { rect.left() + rect.width() * self.wipe };
        let right = egui::Rect::from_min_max(egui::pos2(at, rect.top()), rect.max);
        let painter = ui.painter().with_clip_rect(right.intersect(ui.clip_rect()));
        match &self.saved {
            Some((_, _, texture)) => {
                painter.image(texture.id(), rect, WHOLE, Color32::WHITE);
            }
            None => self.picture.draw(&painter, rect),
        }
        if let Some(error) = &self.report.error {
            tag(ui, right.center_top(), egui::Align2::CENTER_TOP, error);
        }
        let [one, other] = self.beside.names(wish);
        tag(ui, rect.right_top(), egui::Align2::RIGHT_TOP, &other);
        if alone {
            return;
        }
        tag(ui, rect.left_top(), egui::Align2::LEFT_TOP, &one);
        let handle = egui::Rect::from_center_size(egui::pos2(at, rect.center().y), egui::vec2(12.0, rect.height()));
        let grip = ui.interact(handle, ui.scope_id().with("wipe"), egui::Sense::drag());
        grip.widget_info(|| {
            egui::WidgetInfo::labeled(egui::Role::Slider, true, "where one picture ends and the other begins")
        });
        self.wipe = (self.wipe + grip.drag_delta().x / rect.width()).clamp(0.0, 1.0);
        ui.painter().vline(at, rect.y_range(), egui::Stroke::new(2.0, Color32::WHITE));
        if grip.hovered() || grip.dragged() {
            ui.ctx().set_cursor_icon(egui::CursorIcon::ResizeHorizontal);
        }
    }

    fn find(&mut self, ctx: &egui::Context, own: &Report, gpu: &Gpu) {
        let pictures = [own.pictures, self.report.pictures];
        if own.busy || self.report.busy || self.found.as_ref().is_some_and(|(of, ..)| *of == pictures) {
            return;
        }
        let Some(one) = &own.screen else { return };
        let read = |screen: &Screen| screen.read(gpu).unwrap_or_default();
        let other = match (&self.saved, &self.report.screen) {
            (Some((_, words, _)), _) => words.clone(),
            (None, Some(screen)) => read(screen),
            (None, None) => return,
        };
        let standard = if gpu.exact() && self.beside == Beside::Side { Standard::Exact } else { Standard::Near };
        let Some(found) = difference(one.size(), &read(one), &other, standard) else { return };
        let verdict = if found.passes { "within" } else { "over" };
        let words = format!(
            "{} pixels differ, by at most {} of 255: {verdict} the tolerance ({standard:?}); shown 16 times as strong",
            found.pixels, found.largest
        );
        let texture = texture(ctx, "difference", one.size(), &found.words);
        self.found = Some((pictures, texture, words));
    }
}

/// All of a texture.
const WHOLE: egui::Rect = egui::Rect { min: egui::Pos2::ZERO, max: egui::pos2(1.0, 1.0) };

/// A picture from host memory.
fn texture(ctx: &egui::Context, name: &str, size: [u32; 2], words: &[u32]) -> egui::TextureHandle {
    let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
    let image = egui::ColorImage::from_rgba_unmultiplied(size.map(|side| side as usize), &bytes);
    ctx.load_texture(name, image, egui::TextureOptions::NEAREST)
}

/// Lines over a picture.
pub(super) fn strokes(ui: &egui::Ui, rect: egui::Rect, lines: &[Line]) {
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    for line in lines {
        let color = match line.stroke {
            Stroke::Edge => Color32::WHITE,
            Stroke::Reflected => Color32::from_rgb(90, 200, 255),
            Stroke::Refracted => Color32::from_rgb(120, 255, 140),
            Stroke::Lit => Color32::from_rgb(255, 220, 90),
            Stroke::Blocked => Color32::from_rgb(200, 60, 50),
        };
        let ends = line.ends.map(|end| rect.min + rect.size() * egui::vec2(end.x, end.y));
        painter.line_segment(ends, egui::Stroke::new(1.5, color));
    }
}

/// Words on a picture.
pub(super) fn tag(ui: &egui::Ui, at: egui::Pos2, align: egui::Align2, words: &str) {
    let font = egui::FontId::proportional(13.0);
    let galley = ui.painter().layout(words.to_owned(), font, Color32::WHITE, 600.0);
    let rect = align.anchor_size(at, galley.size() + egui::vec2(12.0, 6.0));
    ui.painter().rect_filled(rect, 3.0, Color32::from_black_alpha(170));
    ui.painter().galley(rect.min + egui::vec2(6.0, 3.0), galley, Color32::WHITE);
}
