//! The adapter's own graphics pipeline, on the same device and with the same matrices: depth, and ids if asked.

use std::borrow::Cow;

use twinlight::gpu::Gpu;
use twinlight::tables::{Drawing, Lens};
use wgpu::util::DeviceExt as _;

const SHADER: &str = "
struct Lens { x: vec4f, y: vec4f, z: vec4f, w: vec4f }
@group(0) @binding(0) var<uniform> lens: Lens;
@vertex fn vertex(@location(0) p: vec3f) -> @builtin(position) vec4f {
    let at = vec4f(p, 1.0);
    return vec4f(dot(lens.x, at), dot(lens.y, at), dot(lens.z, at), dot(lens.w, at));
}
";

/// A pipeline with its buffers, ready to be drawn.
pub(crate) struct Peer<'a> {
    gpu: &'a Gpu,
    pipeline: wgpu::RenderPipeline,
    group: wgpu::BindGroup,
    vertices: wgpu::Buffer,
    indices: wgpu::Buffer,
    count: u32,
    depth: wgpu::Texture,
}

impl<'a> Peer<'a> {
    pub(crate) fn new(gpu: &'a Gpu, drawing: &Drawing) -> Self {
        let device = gpu.device();
        let lens: &Lens = &drawing.eyes[0];
        let buffer = |label, contents: &[u8], usage| {
            device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: Some(label), contents, usage })
        };
        let vertices = buffer("peer vertices", bytemuck::cast_slice(&drawing.vertices), wgpu::BufferUsages::VERTEX);
        let indices: Vec<u32> = drawing.faces.iter().flat_map(|f| [f.a, f.b, f.c]).collect();
        let count = indices.len() as u32;
        let indices = buffer("peer indices", bytemuck::cast_slice(&indices), wgpu::BufferUsages::INDEX);
        let rows = [lens.x, lens.y, lens.z, lens.w];
        let uniform = buffer("peer lens", bytemuck::cast_slice(&rows), wgpu::BufferUsages::UNIFORM);
        let module = naga::front::wgsl::parse_str(SHADER).expect("the peer's shader");
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("peer"),
            source: wgpu::ShaderSource::Naga(Cow::Owned(module)),
        });
        let format = wgpu::TextureFormat::Depth32Float;
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("peer"),
            layout: None,
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: None,
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[Some(wgpu::VertexBufferLayout {
                    array_stride: size_of::<twinlight::tables::Vertex>() as u64,
                    step_mode: wgpu::VertexStepMode::Vertex,
                    attributes: &wgpu::vertex_attr_array![0 => Float32x3],
                })],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: Some(wgpu::DepthStencilState {
                format,
                depth_write_enabled: Some(true),
                depth_compare: Some(wgpu::CompareFunction::Less),
                stencil: wgpu::StencilState::default(),
                bias: wgpu::DepthBiasState::default(),
            }),
            multisample: wgpu::MultisampleState::default(),
            fragment: None,
            multiview_mask: None,
            cache: None,
        });
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("peer"),
            layout: &pipeline.get_bind_group_layout(0),
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: uniform.as_entire_binding() }],
        });
        let depth = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("peer depth"),
            size: wgpu::Extent3d { width: lens.width, height: lens.height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        Self { gpu, pipeline, group, vertices, indices, count, depth }
    }

    /// Clears and draws, and waits for it.
    pub(crate) fn draw(&self) {
        let device = self.gpu.device();
        let view = self.depth.create_view(&wgpu::TextureViewDescriptor::default());
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("peer"),
                color_attachments: &[],
                depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                    view: &view,
                    depth_ops: Some(wgpu::Operations {
                        load: wgpu::LoadOp::Clear(1.0),
                        store: wgpu::StoreOp::Store,
                    }),
                    stencil_ops: None,
                }),
                timestamp_writes: None,
                occlusion_query_set: None,
                multiview_mask: None,
            });
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &self.group, &[]);
            pass.set_vertex_buffer(0, self.vertices.slice(..));
            pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
            pass.draw_indexed(0..self.count, 0, 0..1);
        }
        self.gpu.queue().submit([encoder.finish()]);
        device.poll(wgpu::PollType::wait_indefinitely()).expect("the peer's work");
    }

    /// The depths, row by row: 1 where nothing is.
    pub(crate) fn depths(&self) -> Vec<f32> {
        texels(self.gpu, &self.depth, wgpu::TextureAspect::DepthOnly)
    }
}

/// What a texture holds, row by row.
pub(crate) fn texels<T: bytemuck::Pod>(gpu: &Gpu, texture: &wgpu::Texture, aspect: wgpu::TextureAspect) -> Vec<T> {
    let size = texture.size();
    let bytes = size.width as usize * size_of::<T>();
    let row = bytes.next_multiple_of(256);
    let staging = gpu.device().create_buffer(&wgpu::BufferDescriptor {
        label: Some("peer staging"),
        size: row as u64 * u64::from(size.height),
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    let mut encoder = gpu.device().create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    encoder.copy_texture_to_buffer(
        wgpu::TexelCopyTextureInfo { aspect, ..texture.as_image_copy() },
        wgpu::TexelCopyBufferInfo {
            buffer: &staging,
            layout: wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(row as u32),
                rows_per_image: None,
            },
        },
        size,
    );
    gpu.queue().submit([encoder.finish()]);
    staging.map_async(wgpu::MapMode::Read, .., |_| {});
    gpu.device().poll(wgpu::PollType::wait_indefinitely()).expect("the peer's picture");
    let mapped = staging.get_mapped_range(..).expect("mapped");
    mapped.chunks_exact(row).flat_map(|row| bytemuck::pod_collect_to_vec::<u8, T>(&row[..bytes])).collect()
}
