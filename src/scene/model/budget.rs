//! Limits -> memory that is counted before it is taken.

/// How much a model may ask for. The defaults hold a model of 30 million triangles.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Limits {
    /// Bytes of the OBJ file.
    pub obj_bytes: u64,
    /// Bytes of all MTL files together.
    pub mtl_bytes: u64,
    /// MTL files.
    pub mtl_files: usize,
    /// Bytes of one line, its continuations included.
    pub line_bytes: usize,
    /// `v` lines; as many `vt` and `vn` lines again.
    pub vertices: u64,
    /// Triangles, after polygons were cut up.
    pub triangles: u64,
    /// Different names after `usemtl`, and after `g` and `o`.
    pub names: usize,
    /// Different pictures.
    pub textures: usize,
    /// Bytes of one picture file.
    pub picture_bytes: u64,
    /// Texels along one side of a picture.
    pub texture_side: u32,
    /// Bytes of one decoded picture, at 4 a texel.
    pub texture_bytes: u64,
    /// Bytes of memory for all of the model.
    pub memory: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            obj_bytes: 4 << 30,
            mtl_bytes: 64 << 20,
            mtl_files: 64,
            line_bytes: 1 << 20,
            vertices: 1 << 27,
            triangles: 1 << 27,
            names: 1 << 18,
            textures: 4096,
            picture_bytes: 512 << 20,
            texture_side: 16_384,
            texture_bytes: 256 << 20,
            memory: 8 << 30,
        }
    }
}

/// The memory that is still free to be taken, in bytes.
#[derive(Debug)]
pub struct Budget {
    left: u64,
    /// What there was at the start, for the sentence of the error.
    pub(super) whole: u64,
}

/// The budget, or the machine, has no more memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::scene) struct Spent;

impl Budget {
    /// All of [`Limits::memory`].
    #[must_use]
    pub fn new(limits: &Limits) -> Self {
        Self { left: limits.memory, whole: limits.memory }
    }

    /// Takes `bytes`, or nothing.
    pub(in crate::scene) fn take(&mut self, bytes: u64) -> Result<(), Spent> {
        self.left = self.left.checked_sub(bytes).ok_or(Spent)?;
        Ok(())
    }

    /// Pushes, where the vector must grow only after asking the budget and the allocator.
    #[inline]
    pub(super) fn push<T>(&mut self, list: &mut Vec<T>, value: T) -> Result<(), Spent> {
        if list.len() == list.capacity() {
            self.grow(list)?;
        }
        list.push(value);
        Ok(())
    }

    #[cold]
    fn grow<T>(&mut self, list: &mut Vec<T>) -> Result<(), Spent> {
        let more = list.len().max(64);
        self.take((more * size_of::<T>()) as u64)?;
        list.try_reserve_exact(more).map_err(|_| Spent)
    }

    /// `count` copies of `value`, counted first.
    pub(super) fn filled<T: Clone>(&mut self, count: usize, value: T) -> Result<Vec<T>, Spent> {
        self.take((count as u64).saturating_mul(size_of::<T>() as u64))?;
        let mut list = Vec::new();
        list.try_reserve_exact(count).map_err(|_| Spent)?;
        list.resize(count, value);
        Ok(list)
    }

    /// Drops a list's content and gives back what it had taken.
    pub(super) fn give_back<T>(&mut self, list: &mut Vec<T>) {
        self.left += (std::mem::take(list).capacity() * size_of::<T>()) as u64;
    }
}
