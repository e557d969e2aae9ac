//! a drawing -> the ids that the adapter's own graphics pipeline sees

use std::borrow::Cow;

use twinlight::gpu::wgsl::{Sources, join};
use twinlight::gpu::{Gpu, parse};
use twinlight::tables::{Drawing, NONE};

/// The product's own way into clip space, so that both see the same corners.
pub(super) const SHADERS: &str = r#"#import "raster/snap.wgsl"
#import "tables/mesh.wgsl"
@group(0) @binding(0) var<uniform> lens: Lens;
@group(0) @binding(1) var<storage, read> points: array<Vertex>;
@group(0) @binding(2) var<storage, read> triangles: array<Face>;

struct Out {
    @builtin(position) at: vec4f,
    @location(0) @interpolate(flat) id: u32,
}

@vertex
fn corner(@builtin(vertex_index) number: u32) -> Out {
    let face = triangles[number / 3u];
    let corners = array<u32, 3>(face.a, face.b, face.c);
    let c = to_clip(points[corners[number % 3u]].position);
    return Out(c, number / 3u);
}

@fragment
fn pixel(in: Out, @builtin(front_facing) front: bool) -> @location(0) u32 {
    if (lens.cull == 1u && (triangles[in.id].paint & ONE_SIDED) != 0u && !front) {
        discard;
    }
    return in.id;
}
"#;

/// The pipeline of one text of shaders.
pub(super) struct Oracle<'a> {
    gpu: &'a Gpu,
    pipeline: wgpu::RenderPipeline,
}

impl<'a> Oracle<'a> {
    pub(super) fn new(gpu: &'a Gpu, shaders: &str) -> Self {
        let joined = join(&Sources::default().with("oracle", shaders.to_owned()), "oracle").expect("files");
        let (source, _) = parse(&joined, "oracle").unwrap_or_else(|e| panic!("{e}"));
        let device = gpu.device();
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("oracle"),
            source: wgpu::ShaderSource::Naga(Cow::Owned(source)),
        });
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("oracle"),
            layout: None,
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: None,
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: Some(wgpu::DepthStencilState {
                format: wgpu::TextureFormat::Depth32Float,
                depth_write_enabled: Some(true),
                depth_compare: Some(wgpu::CompareFunction::Less),
                stencil: wgpu::StencilState::default(),
                bias: wgpu::DepthBiasState::default(),
            }),
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: None,
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &[Some(wgpu::TextureFormat::R32Uint.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        assert_eq!(gpu.complaint(), None);
        Self { gpu, pipeline }
    }

    fn buffer(&self, bytes: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
        let size = (bytes.len() as u64).max(16);
        let usage = usage | wgpu::BufferUsages::COPY_DST;
        let descriptor = wgpu::BufferDescriptor { label: None, size, usage, mapped_at_creation: false };
        let buffer = self.gpu.device().create_buffer(&descriptor);
        self.gpu.queue().write_buffer(&buffer, 0, bytes);
        buffer
    }

    fn target(&self, [width, height]: [u32; 2], format: wgpu::TextureFormat) -> wgpu::Texture {
        self.gpu.device().create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        })
    }

    /// The ids that the drawing's first eye sees.
    pub(super) fn ids(&self, drawing: &Drawing) -> Vec<u32> {
        let (device, lens) = (self.gpu.device(), &drawing.eyes[0]);
        let size = [lens.width, lens.height];
        let storage = wgpu::BufferUsages::STORAGE;
        let buffers = [
            self.buffer(bytemuck::bytes_of(lens), wgpu::BufferUsages::UNIFORM),
            self.buffer(bytemuck::cast_slice(&drawing.vertices), storage),
            self.buffer(bytemuck::cast_slice(&drawing.faces), storage),
        ];
        let entries =
            [0, 1, 2].map(|i| wgpu::BindGroupEntry { binding: i as u32, resource: buffers[i].as_entire_binding() });
        let layout = self.pipeline.get_bind_group_layout(0);
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &layout,
            entries: &entries,
        });
        let colors = self.target(size, wgpu::TextureFormat::R32Uint);
        let depths = self.target(size, wgpu::TextureFormat::Depth32Float);
        let views = [&colors, &depths].map(|texture| texture.create_view(&wgpu::TextureViewDescriptor::default()));
        let nothing = wgpu::Color { r: f64::from(NONE), ..wgpu::Color::default() };
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: &views[0],
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations { load: wgpu::LoadOp::Clear(nothing), store: wgpu::StoreOp::Store },
                })],
                depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                    view: &views[1],
                    depth_ops: Some(wgpu::Operations {
                        load: wgpu::LoadOp::Clear(1.0),
                        store: wgpu::StoreOp::Store,
                    }),
                    stencil_ops: None,
                }),
                ..wgpu::RenderPassDescriptor::default()
            });
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.draw(0..3 * drawing.faces.len() as u32, 0..1);
        }
        // Rows of a copy begin at multiples of 256 bytes.
        let row = (size[0] * 4).next_multiple_of(256);
        let usage = wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST;
        let bytes = u64::from(row * size[1]);
        let descriptor = wgpu::BufferDescriptor { label: None, size: bytes, usage, mapped_at_creation: false };
        let copy = device.create_buffer(&descriptor);
        let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row), rows_per_image: None };
        let into = wgpu::TexelCopyBufferInfo { buffer: &copy, layout };
        encoder.copy_texture_to_buffer(colors.as_image_copy(), into, colors.size());
        encoder.map_buffer_on_submit(&copy, wgpu::MapMode::Read, .., |_| {});
        self.gpu.queue().submit([encoder.finish()]);
        device.poll(wgpu::PollType::wait_indefinitely()).expect("the device answers");
        assert_eq!(self.gpu.complaint(), None);
        let words: Vec<u32> = bytemuck::pod_collect_to_vec(&copy.get_mapped_range(..).expect("mapped"));
        words.chunks(row as usize / 4).flat_map(|row| row[..size[0] as usize].to_vec()).collect()
    }
}
