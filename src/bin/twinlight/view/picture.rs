//! a screen -> egui's picture of it

use std::sync::Arc;

use eframe::egui::{self, TextureId};
use eframe::egui_wgpu::RenderState;
use eframe::egui_wgpu::wgpu::FilterMode;
use twinlight::gpu::Screen;

/// The texture that egui shows, and whose it is.
#[derive(Debug, Default)]
pub(super) struct Picture {
    shown: Option<(TextureId, Arc<Screen>)>,
}

impl Picture {
    /// Shows a screen from now on.
    pub(super) fn take(&mut self, state: &RenderState, screen: Option<Arc<Screen>>) {
        let Some(screen) = screen else { return };
        if self.shown.as_ref().is_some_and(|(_, shown)| Arc::ptr_eq(shown, &screen)) {
            return;
        }
        let mut renderer = state.renderer.write();
        let id = match self.shown.take() {
            Some((id, _)) => {
                let (device, view) = (&state.device, screen.view());
                renderer.update_egui_texture_from_wgpu_texture(device, view, FilterMode::Nearest, id);
                id
            }
            None => renderer.register_native_texture(&state.device, screen.view(), FilterMode::Nearest),
        };
        self.shown = Some((id, screen));
    }

    /// What is shown.
    pub(super) fn screen(&self) -> Option<&Arc<Screen>> {
        self.shown.as_ref().map(|(_, screen)| screen)
    }

    /// Draws it into a rectangle.
    pub(super) fn draw(&self, painter: &egui::Painter, rect: egui::Rect) {
        if let Some((id, _)) = &self.shown {
            let whole = egui::Rect::from_min_max(egui::Pos2::ZERO, egui::pos2(1.0, 1.0));
            painter.image(*id, rect, whole, egui::Color32::WHITE);
        }
    }
}
