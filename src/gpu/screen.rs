//! a film on the device -> a texture that a window shows, without a way through host memory

use bytemuck::Zeroable as _;

use super::wgsl::Sources;
use super::{Binding, Buffer, Error, Gpu, Kernel};
use crate::film::Transfer;
use crate::tables::{AS_IT_IS, Print, SRGB};

/// Words from row to row of a texture are a multiple of this: WebGPU copies 256 bytes at a time.
const PITCH: u32 = 64;

/// A picture that a window shows: display-referred bytes, which nothing encodes again.
#[derive(Debug)]
pub struct Screen {
    size: [u32; 2],
    develop: Kernel,
    print: Buffer<Print>,
    words: Buffer<u32>,
    texture: wgpu::Texture,
    view: wgpu::TextureView,
}

impl Screen {
    /// A black picture of so many pixels.
    ///
    /// # Errors
    /// If it is larger than a texture may be, or the device has no room.
    pub fn new(gpu: &Gpu, sources: &Sources, size: [u32; 2]) -> Result<Self, Error> {
        let [width, height] = size.map(|side| side.max(1));
        let most = gpu.device.limits().max_texture_dimension_2d;
        if width > most || height > most {
            let bytes = |width: u32, height: u32| u64::from(width) * u64::from(height) * 4;
            let (bytes, most) = (bytes(width, height), bytes(most, most));
            return Err(Error::TooLarge { label: "screen".to_owned(), bytes, most });
        }
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("screen"),
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba8Unorm,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        Ok(Self {
            size: [width, height],
            develop: Kernel::new(gpu, sources, "film/develop")?,
            print: gpu.uniform("print", &Print::zeroed())?,
            words: gpu.zeroed("words", (width.next_multiple_of(PITCH) * height) as usize)?,
            view: texture.create_view(&wgpu::TextureViewDescriptor::default()),
            texture,
        })
    }

    /// Pixels across and down.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// What a window binds.
    #[must_use]
    pub fn view(&self) -> &wgpu::TextureView {
        &self.view
    }

    /// How a film of so many pixels becomes this picture.
    #[must_use]
    pub fn print(&self, [width, height]: [u32; 2], transfer: Transfer) -> Print {
        let [across, down] = self.size;
        let transfer = if transfer == Transfer::Srgb { SRGB } else { AS_IT_IS };
        Print { width, height, across, down, pitch: across.next_multiple_of(PITCH), transfer, pad: [0; 2] }
    }

    /// Develops a film that is on the device; the window sees it from its next frame on.
    ///
    /// # Errors
    /// If the device is lost or does not answer.
    pub fn develop(&self, gpu: &Gpu, print: &Print, sums: &Buffer<[f32; 4]>) -> Result<(), Error> {
        gpu.write(&self.print, &[*print]);
        let mut encoder = gpu.encoder();
        let bindings =
            [Binding::new("print", &self.print), Binding::new("sums", sums), Binding::new("words", &self.words)];
        self.develop.dispatch(gpu, &mut encoder, &bindings, print.across * print.down)?;
        self.publish(gpu, encoder)
    }

    /// Shows a picture that was developed in host memory.
    ///
    /// # Errors
    /// If the device is lost or does not answer.
    pub fn put(&self, gpu: &Gpu, words: &[u32]) -> Result<(), Error> {
        gpu.write(&self.words, words);
        self.publish(gpu, gpu.encoder())
    }

    /// The picture in host memory, row by row without gaps; red in the lowest byte.
    ///
    /// # Errors
    /// If the device is lost or does not answer.
    pub fn read(&self, gpu: &Gpu) -> Result<Vec<u32>, Error> {
        let words = gpu.read(&self.words)?;
        let [across, pitch] = [self.size[0], self.size[0].next_multiple_of(PITCH)].map(|side| side as usize);
        Ok(words.chunks_exact(pitch).flat_map(|row| &row[..across]).copied().collect())
    }

    fn publish(&self, gpu: &Gpu, mut encoder: wgpu::CommandEncoder) -> Result<(), Error> {
        let [width, height] = self.size;
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(width.next_multiple_of(PITCH) * 4),
            rows_per_image: None,
        };
        encoder.copy_buffer_to_texture(
            wgpu::TexelCopyBufferInfo { buffer: &self.words.raw, layout },
            self.texture.as_image_copy(),
            wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        );
        gpu.finish(encoder)
    }
}
