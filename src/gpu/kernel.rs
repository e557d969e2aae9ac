//! a wgsl file -> a pipeline whose bindings go by name

use std::borrow::Cow;

use bytemuck::Pod;
use naga::proc::Layouter;
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{AddressSpace, ImageClass, Module, StorageAccess, StorageFormat, TypeInner};

use super::wgsl::{Joined, Sources, join};
use super::{Buffer, Error, Gpu, Texels};

/// What variants of kernels may ask for; the device says no where it has not.
const CAPABILITIES: Capabilities =
    Capabilities::SUBGROUP.union(Capabilities::SHADER_INT64).union(Capabilities::SHADER_INT64_ATOMIC_MIN_MAX);
/// More workgroups than this in one dimension are not valid, so larger numbers are folded into two.
const MOST_GROUPS: u32 = 65_535;

/// Bytes of a texel: four words.
const TEXEL: u32 = 16;

/// Columns and rows of workgroups, as `wgsl/raster/call.wgsl` counts them too.
pub(super) fn fold(groups: u32) -> [u32; 2] {
    [groups.min(MOST_GROUPS), groups.div_ceil(MOST_GROUPS)]
}

/// A WGSL variable that a buffer is bound to.
#[derive(Debug, Clone)]
struct Slot {
    name: String,
    binding: u32,
    space: Space,
    /// Bytes of an array's element or of the struct.
    element: u32,
}

/// How a kernel reads a variable.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Space {
    Uniform,
    Storage { read_only: bool },
    Texture,
    Image(wgpu::TextureFormat, wgpu::StorageTextureAccess),
}

/// A compute pipeline made of one file of `wgsl/`.
#[derive(Debug, Clone)]
pub struct Kernel {
    name: String,
    pipeline: wgpu::ComputePipeline,
    layout: wgpu::BindGroupLayout,
    slots: Vec<Slot>,
    group: u32,
}

#[derive(Debug, Clone, Copy)]
enum Raw<'a> {
    Buffer(&'a wgpu::Buffer),
    Texture(&'a wgpu::TextureView),
}

/// A buffer or a texture under the name of the WGSL variable that reads it.
#[derive(Debug, Clone, Copy)]
pub struct Binding<'a> {
    name: &'a str,
    raw: Raw<'a>,
    element: u32,
    /// Whether a kernel may have no such variable.
    optional: bool,
}

impl<'a> Binding<'a> {
    /// Binds `buffer` to the variable `name`.
    #[must_use]
    pub fn new<T: Pod>(name: &'a str, buffer: &'a Buffer<T>) -> Self {
        Self { name, raw: Raw::Buffer(&buffer.raw), element: size_of::<T>() as u32, optional: false }
    }

    /// Binds a table to the texture `name`.
    #[must_use]
    pub fn texels(name: &'a str, texels: &'a Texels) -> Self {
        Self { name, raw: Raw::Texture(&texels.view), element: TEXEL, optional: false }
    }

    /// The same for a kernel that need not read it.
    #[must_use]
    pub fn optional(self) -> Self {
        Self { optional: true, ..self }
    }

    /// The same buffer as elements of so many bytes.
    #[must_use]
    pub fn of_bytes(self, element: u32) -> Self {
        Self { element, ..self }
    }
}

/// Parses and validates a kernel's source; errors name the file and line that they were written in.
///
/// # Errors
/// [`Error::Wgsl`].
pub fn parse(joined: &Joined, name: &str) -> Result<(Module, naga::valid::ModuleInfo), Error> {
    let place = |line: Option<u32>| match line.and_then(|line| joined.origin(line)) {
        Some((file, line)) => format!("{file}:{line}"),
        None => format!("wgsl/{name}.wgsl"),
    };
    let module = naga::front::wgsl::parse_str(&joined.text).map_err(|e| {
        let line = e.location(&joined.text).map(|at| at.line_number);
        Error::Wgsl(format!("{}: {}", place(line), e.message()))
    })?;
    let info = Validator::new(ValidationFlags::all(), CAPABILITIES).validate(&module).map_err(|e| {
        let line = e.location(&joined.text).map(|at| at.line_number);
        let mut why = e.as_inner().to_string();
        let mut source = std::error::Error::source(e.as_inner());
        while let Some(cause) = source {
            why = format!("{why}: {cause}");
            source = cause.source();
        }
        Error::Wgsl(format!("{}: {why}", place(line)))
    })?;
    Ok((module, info))
}

impl Kernel {
    /// Builds the kernel that is written in `wgsl/NAME.wgsl`, or takes the one that was built of the same text before:
    /// most of a small frame's time goes into building them.
    ///
    /// # Errors
    /// [`Error::Wgsl`] with file and line if its source is wrong.
    pub fn new(gpu: &Gpu, sources: &Sources, name: &str) -> Result<Self, Error> {
        let with_images = gpu.has_images().then(|| sources.clone().for_what("images"));
        let joined = join(with_images.as_ref().unwrap_or(sources), name).map_err(Error::Wgsl)?;
        if let Some(kernel) = gpu.built(&joined.text) {
            return Ok(kernel);
        }
        let (module, info) = parse(&joined, name)?;
        let slots = slots(&module, &info);
        let entry = module.entry_points.first();
        let group = entry
            .map(|e| e.workgroup_size[0])
            .ok_or_else(|| Error::Wgsl(format!("wgsl/{name}.wgsl has no entry point")))?;
        let entries: Vec<_> = slots.iter().map(layout_entry).collect();
        let device = &gpu.device;
        let layout = device
            .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(name), entries: &entries });
        let shader = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(name),
            source: wgpu::ShaderSource::Naga(Cow::Owned(module)),
        });
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(name),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(name),
            layout: Some(&pipeline_layout),
            module: &shader,
            entry_point: None,
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        if let Some(message) = gpu.complaint() {
            return Err(Error::Validation(message));
        }
        let kernel = Self { name: name.to_owned(), pipeline, layout, slots, group };
        gpu.remember(joined.text, &kernel);
        Ok(kernel)
    }

    /// Records `invocations` of the kernel, or a few more; returns the number of workgroups.
    ///
    /// # Errors
    /// [`Error::Binding`] if the names or element sizes are not those of the WGSL.
    pub fn dispatch(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        bindings: &[Binding<'_>],
        invocations: u32,
    ) -> Result<u32, Error> {
        let [columns, rows] = fold(invocations.div_ceil(self.group).max(1));
        self.pass(gpu, encoder, bindings, |pass| pass.dispatch_workgroups(columns, rows, 1))?;
        Ok(columns * rows)
    }

    /// Records as many workgroups as a kernel before it has written into row `row` of `calls`.
    ///
    /// # Errors
    /// [`Error::Binding`] if the names or element sizes are not those of the WGSL.
    pub fn dispatch_called(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        bindings: &[Binding<'_>],
        calls: &Buffer<[u32; 4]>,
        row: u32,
    ) -> Result<(), Error> {
        let offset = u64::from(row) * size_of::<[u32; 4]>() as u64;
        self.pass(gpu, encoder, bindings, |pass| pass.dispatch_workgroups_indirect(&calls.raw, offset))
    }

    fn pass(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        bindings: &[Binding<'_>],
        dispatch: impl FnOnce(&mut wgpu::ComputePass<'_>),
    ) -> Result<(), Error> {
        let wrong =
            |name: &str, why: String| Error::Binding { kernel: self.name.clone(), name: name.to_owned(), why };
        if let Some(stray) = bindings.iter().find(|b| !b.optional && !self.slots.iter().any(|s| s.name == b.name)) {
            return Err(wrong(stray.name, "the kernel has no such variable".to_owned()));
        }
        let mut entries = Vec::with_capacity(self.slots.len());
        for slot in &self.slots {
            let bound = bindings.iter().find(|b| b.name == slot.name);
            let bound = bound.ok_or_else(|| wrong(&slot.name, "nothing is bound to it".to_owned()))?;
            if bound.element != slot.element {
                let why = format!("its elements are {} bytes, and {} are bound", slot.element, bound.element);
                return Err(wrong(&slot.name, why));
            }
            let resource = match bound.raw {
                Raw::Buffer(buffer) => buffer.as_entire_binding(),
                Raw::Texture(view) => wgpu::BindingResource::TextureView(view),
            };
            entries.push(wgpu::BindGroupEntry { binding: slot.binding, resource });
        }
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(&self.name),
            layout: &self.layout,
            entries: &entries,
        });
        gpu.timed(encoder, &self.name, |pass| {
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &group, &[]);
            dispatch(pass);
        })
    }
}

/// The bindings that a module's kernel uses, by name.
fn slots(module: &Module, info: &ModuleInfo) -> Vec<Slot> {
    let mut layouter = Layouter::default();
    // A module that has been validated has a layout.
    let _ = layouter.update(module.to_ctx());
    let used = |handle: naga::Handle<naga::GlobalVariable>| {
        module.entry_points.is_empty() || !info.get_entry_point(0)[handle].is_empty()
    };
    let variables = module.global_variables.iter().filter(|(handle, _)| used(*handle)).map(|(_, v)| v);
    let bound = variables.filter_map(|v| Some((v, v.binding.as_ref()?)));
    bound
        .map(|(v, binding)| {
            let element = match module.types[v.ty].inner {
                TypeInner::Array { stride, .. } => stride,
                TypeInner::Image { .. } => TEXEL,
                _ => layouter[v.ty].size,
            };
            let space = match v.space {
                AddressSpace::Storage { access } => {
                    Space::Storage { read_only: !access.contains(StorageAccess::STORE) }
                }
                AddressSpace::Handle => match module.types[v.ty].inner {
                    TypeInner::Image { class: ImageClass::Storage { format, access }, .. } => {
                        let format = match format {
                            StorageFormat::R32Uint => wgpu::TextureFormat::R32Uint,
                            _ => wgpu::TextureFormat::Rgba32Uint,
                        };
                        let access = if access.contains(StorageAccess::STORE) {
                            wgpu::StorageTextureAccess::WriteOnly
                        } else {
                            wgpu::StorageTextureAccess::ReadOnly
                        };
                        Space::Image(format, access)
                    }
                    _ => Space::Texture,
                },
                _ => Space::Uniform,
            };
            Slot { name: v.name.clone().unwrap_or_default(), binding: binding.binding, space, element }
        })
        .collect()
}

fn layout_entry(slot: &Slot) -> wgpu::BindGroupLayoutEntry {
    let buffer = |ty| wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None };
    let ty = match slot.space {
        Space::Uniform => buffer(wgpu::BufferBindingType::Uniform),
        Space::Storage { read_only } => buffer(wgpu::BufferBindingType::Storage { read_only }),
        Space::Texture => wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Uint,
            view_dimension: wgpu::TextureViewDimension::D2,
            multisampled: false,
        },
        Space::Image(format, access) => {
            wgpu::BindingType::StorageTexture { access, format, view_dimension: wgpu::TextureViewDimension::D2 }
        }
    };
    wgpu::BindGroupLayoutEntry { binding: slot.binding, visibility: wgpu::ShaderStages::COMPUTE, ty, count: None }
}
