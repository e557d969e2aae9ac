//! a window on a device that Twinlight's kernels share

use std::process::ExitCode;
use std::sync::Arc;

use eframe::egui_wgpu::{WgpuConfiguration, WgpuSetup, WgpuSetupCreateNew};
use eframe::{NativeOptions, Renderer, egui};
use twinlight::gpu::{Adapter, Wanted, descriptor};

use super::Arguments;
use super::app::App;
use crate::job::Failure;

/// How a device is opened that a window and kernels share.
pub(super) fn setup(wanted: Wanted) -> WgpuSetup {
    let mut setup = WgpuSetupCreateNew::without_display_handle();
    setup.device_descriptor = Arc::new(descriptor);
    setup.native_adapter_selector = Some(Arc::new(move |all, surface| {
        let fits = |adapter: &&_| surface.is_none_or(|surface| Adapter::shows(adapter, surface));
        let best = Adapter::best(all.iter().filter(fits).cloned(), &wanted);
        best.ok_or_else(|| "no GPU and no software Vulkan adapter can show a window".to_owned())
    }));
    WgpuSetup::CreateNew(setup)
}

pub(super) fn run(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let options = NativeOptions {
        viewport: egui::ViewportBuilder::default().with_title("Twinlight").with_inner_size([1200.0, 800.0]),
        renderer: Renderer::Wgpu,
        wgpu_options: WgpuConfiguration { wgpu_setup: setup(arguments.job.wanted()), ..Default::default() },
        ..Default::default()
    };
    let arguments = arguments.clone();
    let opened =
        eframe::run_native("twinlight", options, Box::new(move |cc| Ok(Box::new(App::new(cc, &arguments)?))));
    opened.map_err(|error| Failure::Window(error.to_string()))?;
    Ok(ExitCode::SUCCESS)
}
