//! Twins of `wgsl/shade`.

pub mod look;
pub mod phong;
pub mod scale;
pub mod texture;
