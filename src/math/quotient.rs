//! two numbers -> their quotient, rounded as it is in Rust

/// `n / d`: the twin of a kernel that takes no adapter's word for it.
#[must_use]
pub fn quotient(n: f32, d: f32) -> f32 {
    n / d
}
