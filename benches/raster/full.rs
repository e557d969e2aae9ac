//! The adapter's own graphics pipeline for a whole frame: a shadow map from the sun, then Phong with maps from the eye.

use std::borrow::Cow;
use std::ops::Range;

use bytemuck::{Pod, Zeroable};
use glam::{Vec2, Vec3, Vec4};
use twinlight::gpu::Gpu;
use twinlight::tables::{Drawing, Lens, Map, NONE, ONE_SIDED, Vertex};
use wgpu::util::DeviceExt as _;

const SHADOWS: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
const COLORS: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;

#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Frame {
    eye_rows: [Vec4; 4],
    sun_rows: [Vec4; 4],
    eye: Vec3,
    shade: f32,
    toward: Vec3,
    bias: f32,
    power: Vec3,
    pad: f32,
    ambient: Vec3,
    pad2: f32,
}

#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Paint {
    color: Vec3,
    exponent: f32,
    specular: Vec3,
    bump: f32,
    scale: Vec2,
    shift: Vec2,
}

/// Pipelines with their buffers, ready to be drawn.
pub(crate) struct Full<'a> {
    gpu: &'a Gpu,
    by_sun: wgpu::RenderPipeline,
    by_eye: wgpu::RenderPipeline,
    frames: [wgpu::BindGroup; 2],
    /// Indices of each paint's faces.
    paints: Vec<(wgpu::BindGroup, Range<u32>)>,
    vertices: wgpu::Buffer,
    indices: wgpu::Buffer,
    shadows: wgpu::TextureView,
    depth: wgpu::TextureView,
    colors: wgpu::Texture,
    background: wgpu::Color,
}

impl<'a> Full<'a> {
    /// For a drawing with one directional light.
    pub(crate) fn new(gpu: &'a Gpu, drawing: &Drawing) -> Self {
        let device = gpu.device();
        let (eye, sun, lamp, canvas) = (&drawing.eyes[0], &drawing.lenses[0], &drawing.lamps[0], &drawing.canvas);
        let rows = |lens: &Lens| [lens.x, lens.y, lens.z, lens.w];
        let frame = Frame {
            eye_rows: rows(eye),
            sun_rows: rows(sun),
            eye: canvas.eye,
            shade: canvas.shade,
            toward: lamp.place,
            bias: 0.0005,
            power: lamp.power,
            pad: 0.0,
            ambient: canvas.ambient,
            pad2: 0.0,
        };
        let buffer = |contents: &[u8], usage| {
            device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: Some("peer"), contents, usage })
        };
        let uniform = buffer(bytemuck::bytes_of(&frame), wgpu::BufferUsages::UNIFORM);
        let module = naga::front::wgsl::parse_str(include_str!("full.wgsl")).expect("the peer's shader");
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("peer"),
            source: wgpu::ShaderSource::Naga(Cow::Owned(module)),
        });
        let [by_sun, by_eye] = ["by_sun", "by_eye"].map(|entry| pipeline(device, &module, entry));
        let target = |lens: &Lens, format, usage| {
            device.create_texture(&wgpu::TextureDescriptor {
                label: Some("peer"),
                size: wgpu::Extent3d { width: lens.width, height: lens.height, depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: usage | wgpu::TextureUsages::RENDER_ATTACHMENT,
                view_formats: &[],
            })
        };
        let view = |texture: &wgpu::Texture| texture.create_view(&wgpu::TextureViewDescriptor::default());
        let shadows = view(&target(sun, SHADOWS, wgpu::TextureUsages::TEXTURE_BINDING));
        let depth = view(&target(eye, SHADOWS, wgpu::TextureUsages::empty()));
        let colors = target(eye, COLORS, wgpu::TextureUsages::COPY_SRC);
        let group = |pipeline: &wgpu::RenderPipeline, index, entries: &[wgpu::BindGroupEntry<'_>]| {
            let layout = &pipeline.get_bind_group_layout(index);
            device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some("peer"), layout, entries })
        };
        let frame = entry(0, uniform.as_entire_binding());
        let map = entry(1, wgpu::BindingResource::TextureView(&shadows));
        let frames = [group(&by_sun, 0, std::slice::from_ref(&frame)), group(&by_eye, 0, &[frame, map])];
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            address_mode_u: wgpu::AddressMode::Repeat,
            address_mode_v: wgpu::AddressMode::Repeat,
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            ..Default::default()
        });
        let mut indices: Vec<u32> = Vec::new();
        let mut paints = Vec::new();
        for (number, paint) in drawing.paints.iter().enumerate() {
            let first = indices.len() as u32;
            let of_it = |face: &&twinlight::tables::Face| face.paint & !ONE_SIDED == number as u32;
            indices.extend(drawing.faces.iter().filter(of_it).flat_map(|f| [f.a, f.b, f.c]));
            let maps = [
                picture(gpu, drawing, &paint.diffuse_map, true),
                picture(gpu, drawing, &paint.normal_map, false),
                picture(gpu, drawing, &paint.specular_map, false),
            ];
            let about = look(paint);
            let about = buffer(bytemuck::bytes_of(&about), wgpu::BufferUsages::UNIFORM);
            let entries = [
                entry(0, about.as_entire_binding()),
                entry(1, wgpu::BindingResource::TextureView(&maps[0])),
                entry(2, wgpu::BindingResource::TextureView(&maps[1])),
                entry(3, wgpu::BindingResource::TextureView(&maps[2])),
                entry(4, wgpu::BindingResource::Sampler(&sampler)),
            ];
            paints.push((group(&by_eye, 1, &entries), first..indices.len() as u32));
        }
        let [r, g, b] = canvas.background.to_array().map(f64::from);
        Self {
            gpu,
            by_sun,
            by_eye,
            frames,
            paints,
            vertices: buffer(bytemuck::cast_slice(&drawing.vertices), wgpu::BufferUsages::VERTEX),
            indices: buffer(bytemuck::cast_slice(&indices), wgpu::BufferUsages::INDEX),
            shadows,
            depth,
            colors,
            background: wgpu::Color { r, g, b, a: 1.0 },
        }
    }

    /// Both passes; waits for them.
    pub(crate) fn draw(&self) {
        let device = self.gpu.device();
        let colors = self.colors.create_view(&wgpu::TextureViewDescriptor::default());
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = begin(&mut encoder, &self.shadows, None);
            pass.set_pipeline(&self.by_sun);
            pass.set_bind_group(0, &self.frames[0], &[]);
            pass.set_vertex_buffer(0, self.vertices.slice(..));
            pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
            pass.draw_indexed(0..self.paints.last().map_or(0, |(_, range)| range.end), 0, 0..1);
        }
        {
            let mut pass = begin(&mut encoder, &self.depth, Some((&colors, self.background)));
            pass.set_pipeline(&self.by_eye);
            pass.set_bind_group(0, &self.frames[1], &[]);
            pass.set_vertex_buffer(0, self.vertices.slice(..));
            pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
            for (paint, range) in self.paints.iter().filter(|(_, range)| !range.is_empty()) {
                pass.set_bind_group(1, paint, &[]);
                pass.draw_indexed(range.clone(), 0, 0..1);
            }
        }
        self.gpu.queue().submit([encoder.finish()]);
        device.poll(wgpu::PollType::wait_indefinitely()).expect("the peer's work");
    }

    /// The colors, row by row.
    pub(crate) fn colors(&self) -> Vec<[f32; 4]> {
        super::peer::texels(self.gpu, &self.colors, wgpu::TextureAspect::All)
    }
}

/// Its maps are all placed as the first of them.
fn look(paint: &twinlight::tables::Paint) -> Paint {
    let maps = [paint.diffuse_map, paint.normal_map, paint.specular_map];
    let placed = maps.into_iter().find(|map| map.first != NONE).unwrap_or(paint.diffuse_map);
    Paint {
        color: paint.color,
        exponent: paint.exponent,
        specular: paint.specular,
        bump: if paint.normal_map.first == NONE { 0.0 } else { paint.bump },
        scale: placed.scale,
        shift: placed.shift,
    }
}

fn pipeline(device: &wgpu::Device, module: &wgpu::ShaderModule, entry: &str) -> wgpu::RenderPipeline {
    let colored = entry == "by_eye";
    let attributes = wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32, 2 => Float32x3, 3 => Float32];
    let bias = if colored { 0.0 } else { 1.0 };
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(entry),
        layout: None,
        vertex: wgpu::VertexState {
            module,
            entry_point: Some(entry),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[Some(wgpu::VertexBufferLayout {
                array_stride: size_of::<Vertex>() as u64,
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes: if colored { &attributes } else { &attributes[..1] },
            })],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            format: SHADOWS,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Less),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState { slope_scale: bias, ..Default::default() },
        }),
        multisample: wgpu::MultisampleState::default(),
        fragment: colored.then_some(wgpu::FragmentState {
            module,
            entry_point: Some("color"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(COLORS.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}

fn entry(binding: u32, resource: wgpu::BindingResource<'_>) -> wgpu::BindGroupEntry<'_> {
    wgpu::BindGroupEntry { binding, resource }
}

fn begin<'e>(
    encoder: &'e mut wgpu::CommandEncoder,
    depth: &wgpu::TextureView,
    color: Option<(&wgpu::TextureView, wgpu::Color)>,
) -> wgpu::RenderPass<'e> {
    let color = color.map(|(view, clear)| wgpu::RenderPassColorAttachment {
        view,
        depth_slice: None,
        resolve_target: None,
        ops: wgpu::Operations { load: wgpu::LoadOp::Clear(clear), store: wgpu::StoreOp::Store },
    });
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("peer"),
        color_attachments: if color.is_some() { std::slice::from_ref(&color) } else { &[] },
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: depth,
            depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store: wgpu::StoreOp::Store }),
            stencil_ops: None,
        }),
        timestamp_writes: None,
        occlusion_query_set: None,
        multiview_mask: None,
    })
}

/// A map's finest level as a texture; white, or straight up, where there is none.
fn picture(gpu: &Gpu, drawing: &Drawing, map: &Map, color: bool) -> wgpu::TextureView {
    let none = map.first == NONE;
    let (width, height) = if none { (1, 1) } else { (map.width, map.height) };
    let texels = if none {
        vec![u32::MAX]
    } else {
        drawing.texels[map.first as usize..][..(width * height) as usize].to_vec()
    };
    let texture = gpu.device().create_texture_with_data(
        gpu.queue(),
        &wgpu::TextureDescriptor {
            label: Some("peer"),
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: if color { wgpu::TextureFormat::Rgba8UnormSrgb } else { wgpu::TextureFormat::Rgba8Unorm },
            usage: wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        },
        wgpu::util::TextureDataOrder::default(),
        bytemuck::cast_slice(&texels),
    );
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}
