//! The other half of the twins: adapter, device and kernels. The only place that knows wgpu and naga.

mod adapter;
mod buffer;
mod error;
mod kernel;
mod looks;
mod meter;
mod pace;
mod raster;
mod screen;
mod texels;
mod trace;
pub mod wgsl;

pub use adapter::{Adapter, Wanted, adapters, descriptor};
pub use buffer::Buffer;
pub use error::Error;
pub use kernel::{Binding, Kernel, parse};
pub use meter::StageTime;
pub use raster::{GpuImage, GpuRaster, Room, Variant};
pub use screen::Screen;
pub use texels::Texels;
pub use trace::{GpuPaths, GpuSums, GpuTrace, fit};

use adapter::IMAGES;
use meter::Meter;
use std::collections::HashMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// How long a wait for the device may take: a liveness guard, not a budget. Slices are cut to a quarter of a
/// second; the rest is for a machine that does a hundred other things.
const PATIENCE: Duration = Duration::from_mins(1);

/// Kernels that are remembered.
const MOST_KERNELS: usize = 64;

/// One device and its queue. A process needs one.
#[derive(Debug)]
pub struct Gpu {
    device: wgpu::Device,
    queue: wgpu::Queue,
    adapter: Adapter,
    lost: Arc<AtomicBool>,
    complaint: Arc<Mutex<Option<String>>>,
    /// By their joined source.
    kernels: Mutex<HashMap<String, Kernel>>,
    meter: Option<Meter>,
    images: bool,
}

impl Gpu {
    /// Opens the adapter that is asked for.
    ///
    /// # Errors
    /// [`Error::NoAdapter`] if there is none such, [`Error::Device`] if it gives no device.
    pub fn open(wanted: &Wanted) -> Result<Self, Error> {
        let all = adapters();
        let names = all.iter().map(|a| a.name.clone()).collect();
        let adapter = all.into_iter().find(|a| a.is(wanted));
        let adapter = adapter.ok_or(Error::NoAdapter { wanted: wanted.clone(), names })?;
        let descriptor = descriptor(&adapter.raw);
        let asked = catch_unwind(AssertUnwindSafe(|| pollster::block_on(adapter.raw.request_device(&descriptor))));
        let (device, queue) = match asked {
            Ok(Ok(pair)) => pair,
            Ok(Err(error)) => return Err(Error::Device(error.to_string())),
            Err(_) => return Err(Error::Device("its driver failed while it was opened".to_owned())),
        };
        Ok(Self::with(adapter, device, queue))
    }

    /// A device that somebody else has opened, with [`descriptor`], for what shares it: a window.
    #[must_use]
    pub fn share(adapter: wgpu::Adapter, device: wgpu::Device, queue: wgpu::Queue) -> Self {
        Self::with(Adapter::new(adapter), device, queue)
    }

    fn with(adapter: Adapter, device: wgpu::Device, queue: wgpu::Queue) -> Self {
        let lost = Arc::new(AtomicBool::new(false));
        let complaint = Arc::new(Mutex::new(None));
        // No locks in this one: it may be called from within any other call.
        let lost_too = Arc::clone(&lost);
        device.set_device_lost_callback(move |_, _| lost_too.store(true, Ordering::Release));
        let first = Arc::clone(&complaint);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            if !is_of_a_surface(&error) {
                first.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert_with(|| error.to_string());
            }
        }));
        let meter = Meter::new(&device, &queue, adapter.software);
        let images = adapter.software && device.limits().max_storage_textures_per_shader_stage >= IMAGES;
        Self { device, queue, adapter, lost, complaint, kernels: Mutex::default(), meter, images }
    }

    /// The kernel that was built of this text.
    fn built(&self, text: &str) -> Option<Kernel> {
        self.kernels.lock().unwrap_or_else(PoisonError::into_inner).get(text).cloned()
    }

    fn remember(&self, text: String, kernel: &Kernel) {
        let mut kernels = self.kernels.lock().unwrap_or_else(PoisonError::into_inner);
        // Kernels that are written out for a scene are as many as there are scenes.
        if kernels.len() >= MOST_KERNELS {
            kernels.clear();
        }
        kernels.insert(text, kernel.clone());
    }

    /// The adapter behind it.
    #[must_use]
    pub fn adapter(&self) -> &Adapter {
        &self.adapter
    }

    /// The device itself, for what shares it: a window, or a peer to compare with.
    #[must_use]
    pub fn device(&self) -> &wgpu::Device {
        &self.device
    }

    /// The device's queue.
    #[must_use]
    pub fn queue(&self) -> &wgpu::Queue {
        &self.queue
    }

    /// Whether the device is gone.
    #[must_use]
    pub fn lost(&self) -> bool {
        self.lost.load(Ordering::Acquire)
    }

    /// The same, after a look at the device: it tells of its end when it is asked, and not before.
    #[must_use]
    pub fn is_lost(&self) -> bool {
        let polled = catch_unwind(AssertUnwindSafe(|| self.device.poll(wgpu::PollType::Poll)));
        if polled.is_err() {
            self.lost.store(true, Ordering::Release);
        }
        self.lost()
    }

    /// Whether it is a program on this machine's processor.
    #[must_use]
    pub fn software(&self) -> bool {
        self.adapter.software
    }

    /// Whether it computes as Rust does, operation by operation: measured of Mesa's llvmpipe alone.
    #[must_use]
    pub fn exact(&self) -> bool {
        self.adapter.software && self.adapter.name.starts_with("llvmpipe")
    }

    /// Whether kernels read tables as images: on a processor they are the faster ones, and WebGPU promises but four.
    pub(crate) fn has_images(&self) -> bool {
        self.images
    }

    /// The same device, whose kernels read tables as textures, as those of all hardware do.
    #[must_use]
    pub fn without_images(self) -> Self {
        Self { images: false, ..self }
    }

    /// The fewest lanes of a subgroup, or 0 if there are none.
    #[must_use]
    pub fn subgroup(&self) -> u32 {
        self.adapter.raw.get_info().subgroup_min_size
    }

    /// How long one slice of work should take at most. Watchdogs kill at 2 s (Windows), 640 ms (i915) or a few
    /// 100 ms (macOS); a software adapter has none.
    #[must_use]
    pub fn slice_time(&self) -> Duration {
        Duration::from_millis(if self.adapter.software { 250 } else { 50 })
    }

    /// The first validation message since the last call, if there was one.
    #[must_use]
    pub fn complaint(&self) -> Option<String> {
        self.complaint.lock().unwrap_or_else(PoisonError::into_inner).take()
    }

    /// Submits recorded work and waits for its end.
    fn finish(&self, mut encoder: wgpu::CommandEncoder) -> Result<(), Error> {
        let timed = self.meter.as_ref().map(|meter| meter.fetch(&mut encoder)).unwrap_or_default();
        let work = AssertUnwindSafe(|| {
            let submission = self.queue.submit([encoder.finish()]);
            let wait = wgpu::PollType::Wait { submission_index: Some(submission), timeout: Some(PATIENCE) };
            self.device.poll(wait)
        });
        // wgpu 30 panics in `poll` when the device is really lost.
        let waited = catch_unwind(work);
        if self.lost.load(Ordering::Acquire) || waited.is_err() {
            return Err(Error::Lost);
        }
        if let Some(message) = self.complaint() {
            return Err(Error::Validation(message));
        }
        match waited {
            Ok(Ok(_)) => {
                if let Some(meter) = &self.meter {
                    meter.learn(timed);
                }
                Ok(())
            }
            _ => Err(Error::TimeOut(PATIENCE)),
        }
    }

    fn encoder(&self) -> wgpu::CommandEncoder {
        self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default())
    }
}

/// Whether an error is of a window's surface. It cannot be configured while kernels are submitted, which wgpu takes for
/// an error; its painter does it again, and no kernel has anything to do with it.
fn is_of_a_surface(error: &wgpu::Error) -> bool {
    error.to_string().contains("In Surface::")
}

#[cfg(test)]
mod tests {
    use super::is_of_a_surface;

    #[test]
    fn a_surface_is_not_a_kernels_business() {
        let error = |description: &str| wgpu::Error::Validation {
            source: Box::new(std::io::Error::other("why")),
            description: description.to_owned(),
        };
        assert!(is_of_a_surface(&error(
            "Validation Error\n\nCaused by:\n  In Surface::configure\n    Failed to wait"
        )));
        assert!(!is_of_a_surface(&error("Validation Error\n\nCaused by:\n  In Device::create_bind_group")));
    }
}
