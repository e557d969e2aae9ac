//! Rust values -> a texture of four words a texel, or of one
//!
//! A table that lanes find their own ways through: lavapipe reads an array at an index of each lane's own word by word
//! and lane by lane, and a texture much faster, four words at a time; faster still as an image, which has no levels.

use bytemuck::Pod;

use super::{Error, Gpu};
use crate::tables;

const ROW: usize = tables::ROW as usize;

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
        self.texture(label, bytemuck::cast_slice(values), wgpu::TextureFormat::Rgba32Uint, ROW)
    }

    /// A table with rows of whole values, as many as a power of two: one place is found for all of a value's texels, which
    /// are a whole number.
    ///
    /// # Errors
    /// As [`Self::texels`].
    pub fn values<T: Pod>(&self, label: &str, values: &[T]) -> Result<Texels, Error> {
        let texels = (size_of::<T>() / 16).clamp(1, ROW);
        let row = texels << (ROW / texels).ilog2();
        self.texture(label, bytemuck::cast_slice(values), wgpu::TextureFormat::Rgba32Uint, row)
    }

    /// A table of single words, a texel each.
    ///
    /// # Errors
    /// If it is larger than a texture may be, or the device has no room.
    pub fn words(&self, label: &str, words: &[u32]) -> Result<Texels, Error> {
        self.texture(label, bytemuck::cast_slice(words), wgpu::TextureFormat::R32Uint, ROW)
    }

    /// Bytes of the largest table.
    pub(super) fn most_texels(&self) -> u64 {
        (ROW * 16) as u64 * u64::from(self.device.limits().max_texture_dimension_2d)
    }

    /// `width`: texels in a row.
    fn texture(
        &self,
        label: &str,
        bytes: &[u8],
        format: wgpu::TextureFormat,
        width: usize,
    ) -> Result<Texels, Error> {
        let texel = format.block_copy_size(None).unwrap_or(1) as usize;
        let texels = (bytes.len() / texel).max(1);
        let height = texels.div_ceil(width);
        let most = self.device.limits().max_texture_dimension_2d as usize;
        if height > most {
            let (bytes, most) = (bytes.len() as u64, (most * width * texel) as u64);
            return Err(Error::TooLarge { label: label.to_owned(), bytes, most });
        }
        let size =
            wgpu::Extent3d { width: texels.min(width) as u32, height: height as u32, depth_or_array_layers: 1 };
        let images = self.has_images();
        let bound =
            if images { wgpu::TextureUsages::STORAGE_BINDING } else { wgpu::TextureUsages::TEXTURE_BINDING };
        let scope = self.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let texture = self.device.create_texture(&wgpu::TextureDescriptor {
            label: Some(label),
            size,
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: bound | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        let row = width * texel;
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
        put(0, rows, width, whole);
        put(whole, rest, rest.len() / texel, 1);
        if pollster::block_on(scope.pop()).is_some() {
            return Err(Error::NoRoom { label: label.to_owned(), bytes: bytes.len() as u64 });
        }
        Ok(Texels { view: texture.create_view(&wgpu::TextureViewDescriptor::default()) })
    }
}
