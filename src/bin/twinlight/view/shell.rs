//! a window on a device that Twinlight's kernels share

use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind, set_hook, take_hook};
use std::process::{Command, ExitCode};
use std::sync::{Arc, Mutex, PoisonError};

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

/// What a window leaves whose device is lost: the arguments with which another one shows the same.
pub(super) type Left = Arc<Mutex<Option<Vec<String>>>>;

/// A device that is lost so often in one sitting is not asked again: the CPU makes the pictures.
const TRUSTED: u32 = 2;
/// And a window that loses it as often as this is not opened again.
const ENOUGH: u32 = 8;

pub(super) fn run(arguments: &Arguments) -> Result<ExitCode, Failure> {
    if cfg!(target_os = "linux")
        && ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"].map(std::env::var_os) == [const { None }; 3]
    {
        let why = "there is no display: neither DISPLAY nor WAYLAND_DISPLAY is set";
        return Err(Failure::Window(why.to_owned()));
    }
    // What egui's painter says of a lost device is no news: the next window says it.
    let usual = take_hook();
    set_hook(Box::new(move |panic| {
        if !panic.location().is_some_and(|at| at.file().contains("egui-wgpu")) {
            usual(panic);
        }
    }));
    let options = NativeOptions {
        viewport: egui::ViewportBuilder::default().with_title("Twinlight").with_inner_size([1200.0, 800.0]),
        renderer: Renderer::Wgpu,
        wgpu_options: WgpuConfiguration { wgpu_setup: setup(arguments.job.wanted()), ..Default::default() },
        ..Default::default()
    };
    let left = Left::default();
    let app = {
        let (arguments, left) = (arguments.clone(), Arc::clone(&left));
        move |cc: &eframe::CreationContext<'_>| -> Result<Box<dyn eframe::App>, _> {
            Ok(Box::new(App::new(cc, &arguments, left)?))
        }
    };
    // The painter panics over a device that is lost; the scene has left the window by then.
    let ended = catch_unwind(AssertUnwindSafe(|| eframe::run_native("twinlight", options, Box::new(app))));
    let left = left.lock().unwrap_or_else(PoisonError::into_inner).take();
    match (left, ended) {
        (Some(words), _) => again(words, arguments.losses + 1),
        (None, Ok(ended)) => ended.map(|()| ExitCode::SUCCESS).map_err(|error| Failure::Window(error.to_string())),
        (None, Err(panic)) => resume_unwind(panic),
    }
}

/// A fresh process for a fresh device: what a driver leaves behind in this one is not to be trusted.
fn again(mut words: Vec<String>, losses: u32) -> Result<ExitCode, Failure> {
    if losses >= ENOUGH {
        return Err(Failure::Window(format!("its GPU was lost {losses} times")));
    }
    if losses >= TRUSTED {
        words.extend(["--backend", "cpu"].map(str::to_owned));
    }
    let failed = |error: std::io::Error| Failure::Window(error.to_string());
    let mut command = Command::new(std::env::current_exe().map_err(failed)?);
    command.arg("view").args(words).args(["--losses", &losses.to_string()]);
    #[cfg(unix)]
    {
        Err(failed(std::os::unix::process::CommandExt::exec(&mut command)))
    }
    #[cfg(not(unix))]
    {
        let code = command.status().map_err(failed)?.code().and_then(|code| u8::try_from(code).ok());
        Ok(code.map_or(ExitCode::FAILURE, ExitCode::from))
    }
}
