//! passes of kernels -> how long each stage took, as the device's clock tells, or the host's

use std::mem;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use super::{Error, Gpu};

/// Passes of one submission that are timed; those after them are not.
const MOST: u32 = 1024;

/// A stage and the time that its passes took together.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StageTime {
    /// The kernel's name, as `raster/split`.
    pub name: String,
    /// How often it ran.
    pub passes: u32,
    /// All of them together.
    pub took: Duration,
}

/// A clock for passes.
#[derive(Debug)]
pub(super) struct Meter {
    /// Not of a software adapter: Mesa's lavapipe writes some ticks a whole pass later than others. It has the host's
    /// clock, and each pass for itself.
    ticks: Option<Ticks>,
    inner: Mutex<Inner>,
}

/// The device's own clock.
#[derive(Debug)]
struct Ticks {
    queries: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    read: wgpu::Buffer,
    /// Nanoseconds of a tick.
    period: f32,
}

#[derive(Debug, Default)]
struct Inner {
    on: bool,
    /// Of the submission that is being recorded, pass by pass.
    recorded: Vec<String>,
    times: Vec<StageTime>,
}

impl Inner {
    fn add(&mut self, name: String, took: Duration) {
        match self.times.iter_mut().find(|time| time.name == name) {
            Some(time) => (time.passes, time.took) = (time.passes + 1, time.took + took),
            None => self.times.push(StageTime { name, passes: 1, took }),
        }
    }
}

impl Ticks {
    fn new(device: &wgpu::Device, queue: &wgpu::Queue) -> Option<Self> {
        if !device.features().contains(wgpu::Features::TIMESTAMP_QUERY) {
            return None;
        }
        let buffer = |usage| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("ticks"),
                size: u64::from(MOST) * 16,
                usage: usage | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        Some(Self {
            queries: device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("ticks"),
                ty: wgpu::QueryType::Timestamp,
                count: 2 * MOST,
            }),
            resolved: buffer(wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC),
            read: buffer(wgpu::BufferUsages::MAP_READ),
            period: queue.get_timestamp_period(),
        })
    }
}

impl Meter {
    /// None where no clock tells what a pass takes.
    pub(super) fn new(device: &wgpu::Device, queue: &wgpu::Queue, software: bool) -> Option<Self> {
        let ticks = if software { None } else { Some(Ticks::new(device, queue)?) };
        Some(Self { ticks, inner: Mutex::default() })
    }

    fn inner(&self) -> std::sync::MutexGuard<'_, Inner> {
        self.inner.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Where the next pass leaves its times.
    fn stamp(&self, name: &str) -> Option<wgpu::ComputePassTimestampWrites<'_>> {
        let ticks = self.ticks.as_ref()?;
        let mut inner = self.inner();
        let place = 2 * inner.recorded.len() as u32;
        if !inner.on || place >= 2 * MOST {
            return None;
        }
        inner.recorded.push(name.to_owned());
        Some(wgpu::ComputePassTimestampWrites {
            query_set: &ticks.queries,
            beginning_of_pass_write_index: Some(place),
            end_of_pass_write_index: Some(place + 1),
        })
    }

    /// Has the ticks copied to where the host can read them; the names of their passes.
    pub(super) fn fetch(&self, encoder: &mut wgpu::CommandEncoder) -> Vec<String> {
        let names = mem::take(&mut self.inner().recorded);
        if let Some(Ticks { queries, resolved, read, .. }) = self.ticks.as_ref().filter(|_| !names.is_empty()) {
            let count = 2 * names.len() as u32;
            encoder.resolve_query_set(queries, 0..count, resolved, 0);
            encoder.copy_buffer_to_buffer(resolved, 0, read, 0, Some(u64::from(count) * 8));
            encoder.map_buffer_on_submit(read, wgpu::MapMode::Read, .., |_| {});
        }
        names
    }

    /// Adds up what was fetched, once the submission is done.
    pub(super) fn learn(&self, names: Vec<String>) {
        let Some(Ticks { read, period, .. }) = self.ticks.as_ref().filter(|_| !names.is_empty()) else { return };
        {
            let Ok(mapped) = read.get_mapped_range(..) else { return };
            let ticks: Vec<[u64; 2]> = bytemuck::pod_collect_to_vec(&mapped[..names.len() * 16]);
            let mut inner = self.inner();
            for (name, [from, to]) in names.into_iter().zip(ticks) {
                let took = Duration::from_nanos((to.saturating_sub(from) as f64 * f64::from(*period)) as u64);
                inner.add(name, took);
            }
        }
        read.unmap();
    }
}

impl Gpu {
    /// Records a pass of a kernel, and times it if it is asked to.
    pub(super) fn timed(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        name: &str,
        record: impl FnOnce(&mut wgpu::ComputePass<'_>),
    ) -> Result<(), Error> {
        let meter = self.meter.as_ref();
        let by_host = meter.filter(|meter| meter.ticks.is_none() && meter.inner().on);
        if by_host.is_some() {
            self.finish(mem::replace(encoder, self.encoder()))?;
        }
        let timestamp_writes = meter.and_then(|meter| meter.stamp(name));
        record(
            &mut encoder.begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some(name), timestamp_writes }),
        );
        if let Some(meter) = by_host {
            let start = Instant::now();
            self.finish(mem::replace(encoder, self.encoder()))?;
            meter.inner().add(name.to_owned(), start.elapsed());
        }
        Ok(())
    }

    /// Times each pass from now on, or no more, and forgets what was timed; whether there is a clock for it.
    pub fn measure(&self, on: bool) -> bool {
        if let Some(meter) = &self.meter {
            let mut inner = meter.inner();
            inner.on = on;
            inner.times.clear();
        }
        self.meter.is_some()
    }

    /// What was timed, in the order in which the stages ran first.
    #[must_use]
    pub fn times(&self) -> Vec<StageTime> {
        self.meter.as_ref().map(|meter| meter.inner().times.clone()).unwrap_or_default()
    }
}
