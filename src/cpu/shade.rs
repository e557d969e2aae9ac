//! Twins of `wgsl/shade`.

pub mod phong;
