//! the sums of a block and of those before it -> all sums

/// Of one pixel: red, green, blue and the number of samples in the sum.
#[must_use]
pub fn lay(before: [f32; 4], block: [f32; 4]) -> [f32; 4] {
    std::array::from_fn(|i| before[i] + block[i])
}
