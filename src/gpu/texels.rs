//! Rust values -> a texture of four words a texel, or of one
//!
//! A table that lanes find their own ways through: lavapipe reads an array at an index of each lane's own word by word
//! and lane by lane, and a texture much faster, four words at a time; faster still as an image, which has no levels.

use bytemuck::Pod;

use super::{Error, Gpu};
use crate::tables;

const ROW: usize = tables::ROW as usize;
/// Bytes of a texel of four words.
const TEXEL: usize = 16;

/// A table as a texture.
#[derive(Debug)]
pub struct Texels {
    texture: wgpu::Texture,
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

    /// A table that a kernel writes, of values of a texel each; zeros until then.
    ///
    /// # Errors
    /// If it is larger than a texture may be, or the device has no room.
    pub(super) fn blank<T: Pod>(&self, label: &str, values: usize) -> Result<Texels, Error> {
        const { assert!(size_of::<T>() == TEXEL) }
        let usage = wgpu::TextureUsages::STORAGE_BINDING | wgpu::TextureUsages::COPY_SRC;
        // Rows that are read back are multiples of 256 bytes.
        let texels = values.max(1).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT as usize / TEXEL);
        self.room(label, texels, wgpu::TextureFormat::Rgba32Uint, ROW, usage)
    }

    /// The first of a table's values, of a texel each, in host memory.
    ///
    /// # Errors
    /// If the device is lost or does not answer, or has no room.
    pub(super) fn read_texels<T: Pod>(&self, texels: &Texels, values: usize) -> Result<Vec<T>, Error> {
        let size = texels.texture.size();
        let words = self.zeroed::<[u32; 4]>("texels", (size.width * size.height) as usize)?;
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(size.width * TEXEL as u32),
            rows_per_image: None,
        };
        let to = wgpu::TexelCopyBufferInfo { buffer: &words.raw, layout };
        let mut encoder = self.encoder();
        encoder.copy_texture_to_buffer(texels.texture.as_image_copy(), to, size);
        let words = self.finish_and_read(encoder, &words)?;
        Ok(bytemuck::pod_collect_to_vec(&words[..values]))
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
        let table = self.room(label, bytes.len() / texel, format, width, wgpu::TextureUsages::COPY_DST)?;
        let row = width * texel;
        let whole = bytes.len() / row;
        let put = |from: usize, data: &[u8], width: usize, rows: usize| {
            if data.is_empty() {
                return;
            }
            self.queue.write_texture(
                wgpu::TexelCopyTextureInfo {
                    origin: wgpu::Origin3d { x: 0, y: from as u32, z: 0 },
                    ..table.texture.as_image_copy()
                },
                data,
                wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row as u32), rows_per_image: None },
                wgpu::Extent3d { width: width as u32, height: rows as u32, depth_or_array_layers: 1 },
            );
        };
        let (rows, rest) = bytes.split_at(whole * row);
        put(0, rows, width, whole);
        put(whole, rest, rest.len() / texel, 1);
        Ok(table)
    }

    /// A table of so many texels that kernels can read; `usage`: for what else it is.
    fn room(
        &self,
        label: &str,
        texels: usize,
        format: wgpu::TextureFormat,
        width: usize,
        usage: wgpu::TextureUsages,
    ) -> Result<Texels, Error> {
        let texel = format.block_copy_size(None).unwrap_or(1) as usize;
        let height = texels.max(1).div_ceil(width);
        let bytes = (texels * texel) as u64;
        let most = self.device.limits().max_texture_dimension_2d as usize;
        if height > most {
            return Err(Error::TooLarge { label: label.to_owned(), bytes, most: (most * width * texel) as u64 });
        }
        let bound = if self.has_images() {
            wgpu::TextureUsages::STORAGE_BINDING
        } else {
            wgpu::TextureUsages::TEXTURE_BINDING
        };
        let scope = self.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let texture = self.device.create_texture(&wgpu::TextureDescriptor {
            label: Some(label),
            size: wgpu::Extent3d {
                width: texels.clamp(1, width) as u32,
                height: height as u32,
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: bound | usage,
            view_formats: &[],
        });
        if pollster::block_on(scope.pop()).is_some() {
            return Err(Error::NoRoom { label: label.to_owned(), bytes });
        }
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        Ok(Texels { texture, view })
    }
}
