//! The reference: every stage as a plain loop, infallible, and the same as its kernel to the bit on lavapipe.
//!
//! A stage's arguments are the kernel's `read` bindings, its results the `read_write` ones. Where a kernel would
//! clamp an index, its twin panics: the tests run both, so the twin is the kernels' sanitizer.

pub mod film;
pub mod first;
mod four;
pub mod grays;
mod grow;
mod lanes;
mod look;
pub mod raster;
pub mod shade;
pub mod trace;
pub mod witness;

pub use grow::CpuSums;
pub use lanes::{Walker, Wides};
