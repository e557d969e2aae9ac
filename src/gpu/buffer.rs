//! Rust values <-> buffers on the device

use std::marker::PhantomData;

use bytemuck::Pod;
use wgpu::BufferUsages as Usage;

use super::{Error, Gpu};

/// An array on the device that knows its element. Never without room: an empty binding is not valid.
#[derive(Debug)]
pub struct Buffer<T> {
    pub(super) raw: wgpu::Buffer,
    len: usize,
    element: PhantomData<T>,
}

impl<T: Pod> Buffer<T> {
    /// Elements.
    #[must_use]
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Records that all of it becomes zero.
    pub(super) fn clear(&self, encoder: &mut wgpu::CommandEncoder) {
        encoder.clear_buffer(&self.raw, 0, None);
    }

    /// Records that `count` elements from `first` on are copied onto another's from `at` on.
    pub(super) fn copy(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        first: usize,
        to: &Self,
        at: usize,
        count: usize,
    ) {
        let [first, at, count] = [first, at, count].map(|n| (n * size_of::<T>()) as u64);
        encoder.copy_buffer_to_buffer(&self.raw, first, &to.raw, at, Some(count));
    }

    fn bytes(&self) -> u64 {
        (self.len * size_of::<T>()) as u64
    }
}

impl Gpu {
    /// Zeros, readable and writable by kernels.
    ///
    /// # Errors
    /// If it is larger than a binding may be, or the device has no room.
    pub fn zeroed<T: Pod>(&self, label: &str, len: usize) -> Result<Buffer<T>, Error> {
        self.create(label, len, Usage::STORAGE)
    }

    /// Zeros that say how large dispatches are.
    ///
    /// # Errors
    /// If the device has no room.
    pub fn calls(&self, label: &str, len: usize) -> Result<Buffer<[u32; 4]>, Error> {
        self.create(label, len, Usage::STORAGE | Usage::INDIRECT)
    }

    /// An array for kernels.
    ///
    /// # Errors
    /// If it is larger than a binding may be, or the device has no room.
    pub fn upload<T: Pod>(&self, label: &str, values: &[T]) -> Result<Buffer<T>, Error> {
        let buffer = self.create(label, values.len(), Usage::STORAGE)?;
        self.write(&buffer, values);
        Ok(buffer)
    }

    /// One value that is the same for every invocation.
    ///
    /// # Errors
    /// If the device has no room.
    pub fn uniform<T: Pod>(&self, label: &str, value: &T) -> Result<Buffer<T>, Error> {
        let buffer = self.create(label, 1, Usage::UNIFORM)?;
        self.write(&buffer, std::slice::from_ref(value));
        Ok(buffer)
    }

    /// Values that are the same for every invocation, as an array of exactly so many.
    ///
    /// # Errors
    /// If the device has no room.
    pub fn uniforms<T: Pod>(&self, label: &str, values: &[T]) -> Result<Buffer<T>, Error> {
        let buffer = self.create(label, values.len(), Usage::UNIFORM)?;
        self.write(&buffer, values);
        Ok(buffer)
    }

    /// Writes values over a buffer's first elements, before whatever is submitted next.
    pub fn write<T: Pod>(&self, buffer: &Buffer<T>, values: &[T]) {
        self.queue.write_buffer(&buffer.raw, 0, bytemuck::cast_slice(values));
    }

    /// The buffer in host memory.
    ///
    /// # Errors
    /// If the device is lost or does not answer.
    pub fn read<T: Pod>(&self, buffer: &Buffer<T>) -> Result<Vec<T>, Error> {
        self.finish_and_read(self.encoder(), buffer)
    }

    /// Submits recorded work, waits for it, and reads a buffer.
    pub(super) fn finish_and_read<T: Pod>(
        &self,
        mut encoder: wgpu::CommandEncoder,
        buffer: &Buffer<T>,
    ) -> Result<Vec<T>, Error> {
        if buffer.is_empty() {
            self.finish(encoder)?;
            return Ok(Vec::new());
        }
        let staging = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("staging"),
            size: buffer.bytes(),
            usage: Usage::MAP_READ | Usage::COPY_DST,
            mapped_at_creation: false,
        });
        encoder.copy_buffer_to_buffer(&buffer.raw, 0, &staging, 0, Some(buffer.bytes()));
        encoder.map_buffer_on_submit(&staging, wgpu::MapMode::Read, .., |_| {});
        self.finish(encoder)?;
        // What could not be mapped says so here.
        let mapped = staging.get_mapped_range(..).map_err(|_| Error::Lost)?;
        Ok(bytemuck::pod_collect_to_vec(&mapped))
    }

    fn create<T: Pod>(&self, label: &str, len: usize, usage: Usage) -> Result<Buffer<T>, Error> {
        // 16 bytes: an empty array's place, and the smallest uniform.
        let bytes = ((len * size_of::<T>()) as u64).max(16).next_multiple_of(4).max(size_of::<T>() as u64);
        let most = self.device.limits().max_storage_buffer_binding_size;
        if bytes > most {
            return Err(Error::TooLarge { label: label.to_owned(), bytes, most });
        }
        let scope = self.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let raw = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: bytes,
            usage: usage | Usage::COPY_DST | Usage::COPY_SRC,
            mapped_at_creation: false,
        });
        if pollster::block_on(scope.pop()).is_some() {
            return Err(Error::NoRoom { label: label.to_owned(), bytes });
        }
        Ok(Buffer { raw, len, element: PhantomData })
    }
}
