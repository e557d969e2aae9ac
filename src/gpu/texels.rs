//! Rust values -> a texture of four words a texel
//!
//! A table that rays find their own ways through: lavapipe reads an array at an index of each lane's own word by word
//! and lane by lane, and a texture four words at a time.

use bytemuck::Pod;

use super::{Error, Gpu};

/// Texels in a row: as `wgsl/trace/walk.wgsl` counts them.
const ROW: u32 = 4096;

/// A table as a texture.
#[derive(Debug)]
pub struct Texels {
    pub(super) view: wgpu::TextureView,
}

impl Gpu {
    /// A table whose rows are a whole number of texels of 16 bytes.
    ///
    /// # Errors
    /// If it is larger than a texture may be, or the device has no room.
    pub fn texels<T: Pod>(&self, label: &str, values: &[T]) -> Result<Texels, Error> {
        let bytes: &[u8] = bytemuck::cast_slice(values);
        let row = ROW as usize * 16;
        let height = bytes.len().div_ceil(row).max(1);
        let most = self.device.limits().max_texture_dimension_2d as usize;
        if height > most {
            let (bytes, most) = (bytes.len() as u64, (most * row) as u64);
            return Err(Error::TooLarge { label: label.to_owned(), bytes, most });
        }
        let size = wgpu::Extent3d { width: ROW, height: height as u32, depth_or_array_layers: 1 };
        let scope = self.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let texture = self.device.create_texture(&wgpu::TextureDescriptor {
            label: Some(label),
            size,
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba32Uint,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        let whole = bytes.len() / row;
        let put = |from: usize, data: &[u8], width: usize, rows: usize| {
            if data.is_empty() {
                return;
            }
            self.queue.write_texture(
                wgpu::TexelCopyTextureInfo {
                    texture: &texture,
                    mip_level: 0,
                    origin: wgpu::Origin3d { x: 0, y: from as u32, z: 0 },
                    aspect: wgpu::TextureAspect::All,
                },
                data,
                wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row as u32), rows_per_image: None },
                wgpu::Extent3d { width: width as u32, height: rows as u32, depth_or_array_layers: 1 },
            );
        };
        let (rows, rest) = bytes.split_at(whole * row);
        put(0, rows, ROW as usize, whole);
        put(whole, rest, rest.len() / 16, 1);
        if pollster::block_on(scope.pop()).is_some() {
            return Err(Error::NoRoom { label: label.to_owned(), bytes: bytes.len() as u64 });
        }
        Ok(Texels { view: texture.create_view(&wgpu::TextureViewDescriptor::default()) })
    }
}
