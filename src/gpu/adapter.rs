//! what this machine has -> the adapter to use, and how a device of it is opened

use std::panic::catch_unwind;

/// What some variants of kernels use, and every kernel has one that does without; and a clock.
const EXTRAS: wgpu::Features = wgpu::Features::SUBGROUP
    .union(wgpu::Features::SHADER_INT64)
    .union(wgpu::Features::SHADER_INT64_ATOMIC_MIN_MAX)
    .union(wgpu::Features::TIMESTAMP_QUERY);

/// Tables that a kernel binds at most, as images where the adapter has so many of them.
pub(super) const IMAGES: u32 = 8;

/// Which adapter to use.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum Wanted {
    /// A hardware GPU if there is one, else a software adapter.
    #[default]
    Best,
    /// A software adapter if there is one: the same on every machine, so the tests ask for it.
    Software,
    /// The first whose name or driver contains this, whatever the case of its letters.
    Named(String),
}

/// An adapter that is there.
#[derive(Debug, Clone)]
pub struct Adapter {
    pub(super) raw: wgpu::Adapter,
    /// Its name, as its driver tells it.
    pub name: String,
    /// Driver and version.
    pub driver: String,
    /// Vulkan, Metal or DX12.
    pub api: String,
    /// "GPU", "integrated GPU", "virtual GPU", "software" or "other".
    pub kind: &'static str,
    pub(super) software: bool,
}

/// Every adapter of this machine, the best first.
#[must_use]
pub fn adapters() -> Vec<Adapter> {
    let found = catch_unwind(|| {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
            backends: wgpu::Backends::PRIMARY,
            ..wgpu::InstanceDescriptor::new_without_display_handle()
        });
        pollster::block_on(instance.enumerate_adapters(wgpu::Backends::PRIMARY))
    });
    // A driver that panics while it is asked is one that cannot be used.
    let mut adapters: Vec<_> = found.unwrap_or_default().into_iter().map(Adapter::new).collect();
    adapters.sort_by_key(Adapter::rank);
    adapters
}

impl Adapter {
    pub(super) fn new(raw: wgpu::Adapter) -> Self {
        let info = raw.get_info();
        let kind = match info.device_type {
            wgpu::DeviceType::DiscreteGpu => "GPU",
            wgpu::DeviceType::IntegratedGpu => "integrated GPU",
            wgpu::DeviceType::VirtualGpu => "virtual GPU",
            wgpu::DeviceType::Cpu => "software",
            wgpu::DeviceType::Other => "other",
        };
        Self {
            name: info.name,
            driver: format!("{} {}", info.driver, info.driver_info).trim().to_owned(),
            api: format!("{:?}", info.backend),
            kind,
            software: kind == "software",
            raw,
        }
    }

    /// Whether an adapter can show what it draws in a window.
    #[must_use]
    pub fn shows(raw: &wgpu::Adapter, window: &wgpu::Surface<'_>) -> bool {
        raw.is_surface_supported(window)
    }

    /// The best of some adapters, or the one that is asked for.
    #[must_use]
    pub fn best(all: impl Iterator<Item = wgpu::Adapter>, wanted: &Wanted) -> Option<wgpu::Adapter> {
        let mut all: Vec<_> = all.map(Self::new).filter(|adapter| adapter.is(wanted)).collect();
        all.sort_by_key(Self::rank);
        all.into_iter().next().map(|adapter| adapter.raw)
    }

    fn rank(&self) -> Option<usize> {
        ["GPU", "integrated GPU", "virtual GPU", "other", "software"].iter().position(|kind| *kind == self.kind)
    }

    /// Whether this is the adapter that `wanted` asks for.
    #[must_use]
    pub fn is(&self, wanted: &Wanted) -> bool {
        match wanted {
            Wanted::Best => true,
            Wanted::Software => self.software,
            Wanted::Named(name) => {
                format!("{} {}", self.name, self.driver).to_lowercase().contains(&name.to_lowercase())
            }
        }
    }

    /// The limits that matter to us: bytes of one storage binding, storage bindings of a kernel, invocations of a
    /// workgroup.
    #[must_use]
    pub fn limits(&self) -> [u64; 3] {
        let limits = self.raw.limits();
        [
            limits.max_storage_buffer_binding_size,
            u64::from(limits.max_storage_buffers_per_shader_stage),
            u64::from(limits.max_compute_invocations_per_workgroup),
        ]
    }
}

/// How to open a device: with WebGPU's default limits, so that what runs here runs on every adapter; faster ways only
/// where there are any.
#[must_use]
pub fn descriptor(adapter: &wgpu::Adapter) -> wgpu::DeviceDescriptor<'static> {
    wgpu::DeviceDescriptor {
        label: Some("twinlight"),
        required_features: adapter.features() & EXTRAS,
        required_limits: wgpu::Limits {
            max_storage_textures_per_shader_stage: adapter
                .limits()
                .max_storage_textures_per_shader_stage
                .min(IMAGES),
            ..wgpu::Limits::default()
        },
        ..wgpu::DeviceDescriptor::default()
    }
}
