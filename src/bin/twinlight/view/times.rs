//! the times of the stages -> a small chart

use eframe::egui;
use twinlight::gpu::StageTime;

/// The chart in a window of its own; `open` says whether it stays.
pub(super) fn window(ctx: &egui::Context, times: &[StageTime], open: &mut bool) {
    egui::Window::new("Stages on the GPU").open(open).default_pos([20.0, 60.0]).show(ctx, |ui| {
        let ms = |time: &StageTime| time.took.as_secs_f32() * 1e3;
        let all: f32 = times.iter().map(ms).sum();
        if times.is_empty() {
            ui.label("none: the picture comes from the CPU, or the adapter has no clock for them");
            return;
        }
        egui::Grid::new("stages").num_columns(4).show(ui, |ui| {
            for time in times {
                ui.monospace(&time.name);
                ui.label(format!("{} x", time.passes));
                ui.label(format!("{:.2} ms", ms(time)));
                let share = ms(time) / all.max(f32::MIN_POSITIVE);
                ui.add(egui::ProgressBar::new(share).desired_width(160.0).text(format!("{:.0} %", share * 100.0)));
                ui.end_row();
            }
        });
        ui.label(format!("{all:.2} ms together"));
    });
}
