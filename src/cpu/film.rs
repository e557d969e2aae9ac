//! Twins of `wgsl/film`.

pub mod develop;
