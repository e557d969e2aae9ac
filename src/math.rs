//! Numbers in the one way that every adapter and Rust agree on to the bit.
//!
//! `+ - * /` and `sqrt` of f32 are the same on lavapipe and in Rust; `pow`, `exp2`, `sin` and `fma` are not
//! (measured; WGSL allows them several ulps). So the functions that a decision or a color hangs on are built
//! here from the former, each with its twin in `wgsl/math`.

pub mod angle;
pub mod fence;
pub mod power;
pub mod quotient;
pub mod random;
pub mod sphere;
pub mod vector;
pub mod whole;

pub use glam::{Vec2, Vec3};
