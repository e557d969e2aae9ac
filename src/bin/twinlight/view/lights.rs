//! what the lights see -> pictures beside the picture

use std::sync::Arc;

use eframe::egui;
use twinlight::render::live::LightMap;

/// The maps that are shown.
#[derive(Default)]
pub(super) struct Lights {
    maps: Arc<Vec<LightMap>>,
    textures: Vec<egui::TextureHandle>,
}

impl Lights {
    /// Shows these from now on.
    pub(super) fn take(&mut self, ctx: &egui::Context, maps: &Arc<Vec<LightMap>>) {
        if Arc::ptr_eq(&self.maps, maps) {
            return;
        }
        let texture = |map: &LightMap| {
            let image = egui::ColorImage::from_gray(map.shown.map(|side| side as usize), &map.grays);
            ctx.load_texture(&map.name, image, egui::TextureOptions::LINEAR)
        };
        self.textures = maps.iter().map(texture).collect();
        self.maps = Arc::clone(maps);
    }

    /// The maps in a window of their own; `open` says whether it stays.
    pub(super) fn window(&self, ctx: &egui::Context, open: &mut bool) {
        egui::Window::new("What the lights see").open(open).default_pos([480.0, 60.0]).show(ctx, |ui| {
            if self.maps.is_empty() {
                ui.label("nothing: the ray tracer asks each light anew, and has no shadow maps");
                return;
            }
            ui.label("near is bright, and where nothing is, black");
            egui::ScrollArea::vertical().max_height(420.0).show(ui, |ui| {
                for (map, texture) in self.maps.iter().zip(&self.textures) {
                    let [width, height] = map.size;
                    ui.label(format!("{}, {width} x {height}", map.name));
                    let image =
                        egui::Image::new(texture).max_width(256.0).alt_text(format!("what {} sees", map.name));
                    ui.add(image);
                }
            });
        });
    }
}
