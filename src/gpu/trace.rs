//! The ray tracer's stages as kernels.

mod fit;
mod grow;
mod paths;

pub use fit::fit;
pub use grow::GpuSums;
pub use paths::GpuPaths;

use std::time::Instant;

use bytemuck::Zeroable as _;

use super::pace::Pace;
use super::wgsl::Sources;
use super::{Binding, Buffer, Error, Gpu, Kernel, Texels};
use crate::film::Run;
use crate::tables::{
    CUT_SHORT, Few, Light, Material, Path, STACK_FULL, Settings, Slice, Status, Tables, View, Waiting,
};
use crate::trace::{Paths, Trace};

/// Room for paths and stacks: half of what every adapter binds at once, and what a software adapter's cache holds.
const PATH_BYTES: u64 = 64 << 20;
const PATH_BYTES_IN_CACHE: u64 = 16 << 20;

/// The ray tracer on a GPU.
#[derive(Debug)]
pub struct GpuTrace<'a> {
    gpu: &'a Gpu,
    cast: Kernel,
    follow: Kernel,
    gather: Kernel,
    lay: Kernel,
    few: Option<Kernel>,
    steps: Option<Kernel>,
    max_depth: u32,
    deep: u32,
    /// Of the block in hand, those that were made before included; and those that are not made yet.
    samples: u32,
    left: u32,
    view: Buffer<View>,
    settings: Buffer<Settings>,
    nodes: Texels,
    leaves: Texels,
    materials: Buffer<Material>,
    paints: Texels,
    faces: Texels,
    instances: Texels,
    vertices: Texels,
    texels: Texels,
    lights: Buffer<Light>,
    scene: Buffer<Few>,
    slice: Buffer<Slice>,
    status: Buffer<Status>,
    /// Recorded and not yet submitted, with the workgroups it should report.
    recorded: Option<(wgpu::CommandEncoder, u32)>,
    last: Status,
    /// Paths that are done with: room for the next run.
    spare: Option<GpuPaths>,
    pace: Pace,
    idle: u32,
}

impl<'a> GpuTrace<'a> {
    /// A tracer of one scene with the kernels of `sources`.
    ///
    /// # Errors
    /// If a kernel's source is wrong, or the scene does not fit the device.
    pub fn new(gpu: &'a Gpu, sources: &Sources, tables: &Tables) -> Result<Self, Error> {
        let sources = &fit(sources, tables);
        let few = tables.few.then(|| Kernel::new(gpu, sources, "trace/few"));
        let [depth, deep] = [tables.settings.max_depth, tables.deep].map(u64::from);
        let a_pixel = depth * size_of::<Waiting>() as u64 + deep * 8 + size_of::<Path>() as u64;
        let room = if gpu.software() { PATH_BYTES_IN_CACHE } else { PATH_BYTES };
        let pixels = (room / a_pixel).min(1 << 18) as u32;
        Ok(Self {
            gpu,
            cast: Kernel::new(gpu, sources, "trace/cast")?,
            follow: Kernel::new(gpu, sources, "trace/follow")?,
            gather: Kernel::new(gpu, sources, "trace/gather")?,
            lay: Kernel::new(gpu, sources, "trace/lay")?,
            few: few.transpose()?,
            steps: tables.steps.then(|| Kernel::new(gpu, sources, "trace/steps")).transpose()?,
            max_depth: tables.settings.max_depth,
            deep: tables.deep,
            samples: tables.samples,
            left: tables.samples,
            view: gpu.uniform("view", &tables.view)?,
            settings: gpu.uniform("settings", &tables.settings)?,
            nodes: gpu.values("nodes", &tables.nodes)?,
            leaves: gpu.values("leaves", &tables.leaves)?,
            materials: gpu.upload("materials", &tables.materials)?,
            paints: gpu.texels("paints", &tables.paints)?,
            faces: gpu.texels("faces", &tables.faces)?,
            instances: gpu.texels("instances", &tables.instances)?,
            vertices: gpu.texels("vertices", &tables.vertices)?,
            texels: gpu.words("texels", &tables.texels)?,
            lights: gpu.upload("lights", &tables.lights)?,
            scene: gpu.uniform("scene", &tables.scene())?,
            slice: gpu.uniform("slice", &Slice::zeroed())?,
            status: gpu.zeroed("status", 1)?,
            recorded: None,
            last: Status::zeroed(),
            spare: None,
            pace: Pace::new(gpu.slice_time(), pixels),
            idle: 0,
        })
    }

    /// What the kernels told at the last [`Trace::settle`].
    #[must_use]
    pub fn status(&self) -> Status {
        self.last
    }

    /// Records one stage. Slices are told apart by the submission: all stages of one read the same.
    fn record(
        &mut self,
        slice: &Slice,
        dispatch: impl FnOnce(&Self, &mut wgpu::CommandEncoder) -> Result<u32, Error>,
    ) -> Result<(), Error> {
        let (mut encoder, groups) = if let Some(recorded) = self.recorded.take() {
            recorded
        } else {
            self.gpu.write(&self.slice, &[*slice]);
            self.gpu.write(&self.status, &[Status::zeroed()]);
            (self.gpu.encoder(), 0)
        };
        let more = dispatch(self, &mut encoder)?;
        self.recorded = Some((encoder, groups + more));
        Ok(())
    }
}

impl Trace for GpuTrace<'_> {
    type Paths = GpuPaths;
    type Error = Error;

    fn most_pixels(&self) -> u32 {
        self.pace.pixels
    }

    fn budget(&self) -> u32 {
        self.pace.budget
    }

    fn rounds(&self) -> u32 {
        self.pace.rounds.min(self.left)
    }

    fn begin(&mut self, run: &Run, end: u32) -> Result<GpuPaths, Error> {
        self.samples = end - run.samples.start;
        self.left = end - run.samples.end;
        self.recorded = None;
        self.idle = 0;
        match self.spare.take().filter(|spare| spare.pixels.len() == run.pixels.len()) {
            Some(spare) => Ok(self.again(spare, run, end)),
            None => self.fresh(run, end),
        }
    }

    fn cast(&mut self, paths: &mut GpuPaths, slice: &Slice) -> Result<(), Error> {
        self.record(slice, |this, encoder| {
            let bindings = [
                Binding::new("settings", &this.settings),
                Binding::new("view", &this.view),
                Binding::new("slice", &this.slice),
                Binding::new("paths", &paths.paths),
                Binding::new("status", &this.status),
            ];
            this.cast.dispatch(this.gpu, encoder, &bindings, slice.count)
        })
    }

    fn follow(&mut self, paths: &mut GpuPaths, slice: &Slice) -> Result<(), Error> {
        self.record(slice, |this, encoder| {
            let bindings = [
                Binding::new("settings", &this.settings),
                Binding::texels("nodes", &this.nodes),
                Binding::texels("leaves", &this.leaves),
                Binding::new("walks", &paths.walks),
                Binding::new("materials", &this.materials),
                Binding::texels("paints", &this.paints),
                Binding::texels("faces", &this.faces),
                Binding::texels("instances", &this.instances).optional(),
                Binding::texels("vertices", &this.vertices),
                Binding::texels("texels", &this.texels).optional(),
                Binding::new("lights", &this.lights),
                Binding::new("view", &this.view),
                Binding::new("slice", &this.slice),
                Binding::new("paths", &paths.paths),
                Binding::new("waiting", &paths.waiting),
                Binding::new("status", &this.status),
            ];
            this.follow.dispatch(this.gpu, encoder, &bindings, slice.count)
        })
    }

    fn steps(&mut self, paths: &mut GpuPaths, slice: &Slice) -> Result<(), Error> {
        self.record(slice, |this, encoder| {
            let Some(steps) = &this.steps else { return Ok(0) };
            let bindings = [
                Binding::new("settings", &this.settings),
                Binding::texels("nodes", &this.nodes),
                Binding::texels("leaves", &this.leaves),
                Binding::texels("paints", &this.paints).optional(),
                Binding::texels("faces", &this.faces).optional(),
                Binding::texels("instances", &this.instances).optional(),
                Binding::texels("vertices", &this.vertices).optional(),
                Binding::texels("texels", &this.texels).optional(),
                Binding::new("slice", &this.slice),
                Binding::new("paths", &paths.paths),
                Binding::new("status", &this.status),
            ];
            steps.dispatch(this.gpu, encoder, &bindings, slice.count)
        })
    }

    fn gather(&mut self, paths: &mut GpuPaths, slice: &Slice) -> Result<(), Error> {
        self.record(slice, |this, encoder| {
            let bindings = [
                Binding::new("slice", &this.slice),
                Binding::new("paths", &paths.paths),
                Binding::new("sums", &paths.sums),
                Binding::new("squares", &paths.squares),
                Binding::new("ids", &paths.ids),
                Binding::new("status", &this.status),
            ];
            this.gather.dispatch(this.gpu, encoder, &bindings, slice.count)
        })
    }

    fn few(&mut self, paths: &mut GpuPaths, slice: &Slice) -> Result<(), Error> {
        self.record(slice, |this, encoder| {
            let Some(few) = &this.few else { return Ok(0) };
            let bindings = [
                Binding::new("settings", &this.settings),
                Binding::new("scene", &this.scene),
                Binding::new("view", &this.view),
                Binding::new("slice", &this.slice),
                Binding::new("paths", &paths.paths),
                Binding::new("waiting", &paths.waiting),
                Binding::new("sums", &paths.sums),
                Binding::new("squares", &paths.squares),
                Binding::new("ids", &paths.ids),
                Binding::new("status", &this.status),
            ];
            few.dispatch(this.gpu, encoder, &bindings, slice.count)
        })
    }

    fn settle(&mut self, _paths: &mut GpuPaths) -> Result<u32, Error> {
        let Some((encoder, groups)) = self.recorded.take() else { return Ok(0) };
        let start = Instant::now();
        let status = self.gpu.finish_and_read(encoder, &self.status)?;
        self.pace.learn(start.elapsed());
        let status = status.first().copied().unwrap_or_else(Status::zeroed);
        self.last = status;
        let incomplete = |why: String| Err(Error::Incomplete(why));
        if status.groups != groups {
            return incomplete(format!("{} of {groups} workgroups ran", status.groups));
        }
        if status.flags & CUT_SHORT != 0 {
            return incomplete("the driver cut a loop short".to_owned());
        }
        if status.flags & STACK_FULL != 0 {
            return incomplete("a ray stack was full".to_owned());
        }
        // Work that neither turns a loop nor ends a pixel is none, however often it is done.
        self.idle = if status.turns == 0 && status.pixels == 0 { self.idle + 1 } else { 0 };
        if self.idle > 8 {
            return incomplete("nothing moves any more".to_owned());
        }
        Ok(status.pixels)
    }

    fn end(&mut self, paths: GpuPaths) -> Result<Paths, Error> {
        let sums = self.gpu.read(&paths.sums)?;
        let squares = self.gpu.read(&paths.squares)?;
        let ids = self.gpu.read(&paths.ids)?;
        // A killed dispatch may be reported as done (Metal and DX12 do so): the film itself is the proof.
        let wanted = self.samples as f32;
        let ended = |i: usize| paths.ended.get(i).is_some_and(|ended| *ended);
        if let Some(short) = (0..sums.len()).find(|&i| sums[i][3] != wanted && !ended(i)) {
            let why = format!("a pixel has {} of {wanted} samples", sums[short][3]);
            return Err(Error::Incomplete(why));
        }
        let (paths, pixels) = (Vec::new(), paths.pixels);
        Ok(Paths { pixels, paths, waiting: Vec::new(), walks: Vec::new(), sums, squares, ids })
    }

    fn ease(&mut self, error: Error) -> Result<(), Error> {
        self.recorded = None;
        let again = matches!(error, Error::Incomplete(_) | Error::TimeOut(_) | Error::NoRoom { .. });
        if again && self.pace.ease() { Ok(()) } else { Err(error) }
    }
}
