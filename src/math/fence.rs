//! numbers -> the same numbers, through which no compiler sees

use glam::Vec3;

/// `v`. Rust never reorders floats; its twin keeps lavapipe from turning `a + b - c` round.
#[must_use]
pub fn fence(v: Vec3) -> Vec3 {
    v
}
