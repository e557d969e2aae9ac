//! the window's parts: menus, panels, the picture, and what is said about it

use eframe::egui::{self, Ui};
use twinlight::gpu::Screen;
use twinlight::view::keys::{Command, KEYS, Key, search};

use super::app::{App, Inspected};
use super::stage::{strokes, tag};
use super::{hand, panels, times};

/// Whether a key's command stands in a menu.
type Among = fn(&Key) -> bool;

impl App {
    pub(super) fn show(&mut self, ui: &mut Ui) {
        egui::Panel::top("menus").show(ui, |ui| self.menus(ui));
        egui::Panel::bottom("status").show(ui, |ui| self.status(ui));
        if self.inspected.is_some() {
            egui::Panel::left("inspector").default_size(460.0).min_size(200.0).show(ui, |ui| self.inspector(ui));
        }
        if self.panels {
            egui::Panel::right("panels").default_size(250.0).show(ui, |ui| {
                egui::ScrollArea::vertical().show(ui, |ui| self.fields(ui));
            });
        }
        egui::CentralPanel::default().show(ui, |ui| self.stage(ui));
        let ctx = ui.ctx().clone();
        self.keys(&ctx);
        if self.inside.times {
            times::window(&ctx, &self.report.times, &mut self.inside.times);
        }
        if self.inside.lights {
            self.lights.window(&ctx, &mut self.inside.lights);
        }
    }

    fn menus(&mut self, ui: &mut Ui) {
        let menus: [(&str, Among); 3] = [
            ("Show", |key| matches!(key.command, Command::Show(_))),
            ("Look", |key| {
                use Command::{CopyCamera, FrameAll, From, PasteCamera, Redo, Reset, Undo};
                matches!(key.command, From(_) | FrameAll | Reset | Undo | Redo | CopyCamera | PasteCamera)
            }),
            ("Do", |key| {
                use Command::{Compare, CopyPicture, Difference, Help, Inspect, Panels, Reload, Render};
                use Command::{Lights, Save, Screenshot, SwitchMethod, SwitchSide, Times};
                let out = matches!(key.command, Save | Reload | Screenshot | CopyPicture | Render);
                out || matches!(
                    key.command,
                    SwitchMethod | SwitchSide | Compare | Difference | Inspect | Times | Lights | Panels | Help
                )
            }),
        ];
        let mut said = None;
        egui::MenuBar::new().ui(ui, |ui| {
            for (title, of) in menus {
                ui.menu_button(title, |ui| {
                    for key in KEYS.iter().filter(|key| of(key)) {
                        if ui.add(egui::Button::new(key.words).shortcut_text(key.chord)).clicked() {
                            said = Some(key.command);
                        }
                    }
                });
            }
            if let Some(desk) = &self.desk {
                let unsaved = if desk.unsaved() { " (changed)" } else { "" };
                ui.label(format!("{}{unsaved}", desk.path().display()));
            }
        });
        if let Some(command) = said {
            self.obey(&ui.ctx().clone(), command);
        }
    }

    fn fields(&mut self, ui: &mut Ui) {
        let Some(desk) = &mut self.desk else { return };
        let before = desk.draft().text().to_owned();
        if let Some(wrong) = panels::panels(ui, desk) {
            self.error = Some(wrong);
        } else if desk.draft().text() != before {
            (self.changed, self.error) = (true, None);
        }
    }

    /// The picture, as large as there is room, and what is done on it.
    fn stage(&mut self, ui: &mut Ui) {
        let pixels = ui.ctx().pixels_per_point();
        let area = ui.available_rect_before_wrap();
        let room = [area.width() * pixels, area.height() * pixels];
        let Some(desk) = &mut self.desk else {
            let words = if self.error.is_some() { "" } else { "Drop a scene or a model here" };
            ui.centered_and_justified(|ui| ui.label(words));
            return;
        };
        let wish = desk.wish(room);
        let size = wish.scene.film.size.map(|side| side as f32 / pixels);
        let rect = egui::Rect::from_center_size(area.center(), size.into());
        let response = ui.allocate_rect(rect, egui::Sense::click_and_drag());
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "the picture"));
        let moves = hand::moves(ui, &response);
        let resting = ui.input(|input| !input.pointer.any_down() && input.smooth_scroll_delta().y == 0.0);
        self.changed |= !moves.is_empty() || room != self.room || (resting && desk.held());
        for hand in moves {
            desk.hand(hand);
        }
        if resting {
            desk.let_go();
        }
        self.room = room;
        self.picture.draw(ui.painter(), rect);
        if let Some(compared) = &mut self.compared {
            compared.draw(ui, rect, &wish, &self.report, &self.gpu);
        }
        if let Some(error) = &self.report.error {
            // Over the last good picture.
            tag(ui, rect.left_top(), egui::Align2::LEFT_TOP, error);
        }
        let under = |at: egui::Pos2| {
            let share = (at - rect.min) / rect.size();
            [share.x * wish.scene.film.size[0] as f32, share.y * wish.scene.film.size[1] as f32].map(|at| at as u32)
        };
        if response.double_clicked()
            && let Some(at) = response.interact_pointer_pos()
        {
            self.question(under(at), true);
        }
        if let Some(inspected) = &self.inspected {
            strokes(ui, rect, &inspected.lines);
        }
        if let (Some(Inspected { pixel, .. }), Some(at)) = (&self.inspected, response.hover_pos())
            && *pixel != under(at)
        {
            self.question(under(at), false);
            if let Some(inspected) = &mut self.inspected {
                inspected.pixel = under(at);
            }
        }
        if std::mem::take(&mut self.changed) {
            self.ask();
        }
    }

    fn inspector(&self, ui: &mut Ui) {
        let Some(Inspected { text, .. }) = &self.inspected else { return };
        egui::ScrollArea::both().auto_shrink(false).show(ui, |ui| {
            ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Extend);
            let words = if text.is_empty() { "what made the pixel under the cursor" } else { text };
            ui.label(egui::RichText::new(words).monospace().size(11.0));
        });
    }

    fn status(&mut self, ui: &mut Ui) {
        ui.horizontal(|ui| {
            if let Some(desk) = &self.desk {
                ui.label(format!("{:?} on the {}", desk.method(), format!("{:?}", desk.side()).to_uppercase()));
            }
            let progress = self.report.progress;
            let [width, height] =
                self.picture.screen().map_or([0; 2], |screen: &std::sync::Arc<Screen>| screen.size());
            ui.label(format!("{width} x {height}"));
            ui.label(format!("{} of {} samples", progress.has, progress.target));
            ui.label(format!("{:.0} ms", self.report.took.as_secs_f32() * 1e3));
            ui.label(match self.report.building {
                Some(share) => format!("building the tree: {:.0} %", share * 100.0),
                None if self.report.busy => "at work".to_owned(),
                None => "done".to_owned(),
            });
            if let Some(full) = &self.full {
                ui.add(egui::ProgressBar::new(full.fraction()).desired_width(160.0).show_percentage());
                if ui.button("cancel").clicked() {
                    full.cancel();
                }
            }
            if let Some(note) = &self.note {
                ui.label(note);
            }
        });
        if let Some(error) = &self.error {
            ui.colored_label(ui.visuals().error_fg_color, egui::RichText::new(error).monospace());
        }
    }

    fn keys(&mut self, ctx: &egui::Context) {
        let Some(text) = &mut self.help else { return };
        let mut open = true;
        egui::Window::new("Keys").open(&mut open).show(ctx, |ui| {
            let label = ui.label("search");
            ui.text_edit_singleline(text).labelled_by(label.id).request_focus();
            egui::ScrollArea::vertical().max_height(400.0).show(ui, |ui| {
                egui::Grid::new("keys").striped(true).show(ui, |ui| {
                    for (keys, words) in search(text) {
                        ui.monospace(keys);
                        ui.label(words);
                        ui.end_row();
                    }
                });
            });
        });
        if !open || ctx.input(|input| input.key_pressed(egui::Key::Escape)) {
            self.help = None;
        }
    }
}
