#![forbid(unsafe_code)]
pub mod cpu;
pub mod film;
pub mod gpu;
pub mod math;
pub mod prepare;
pub mod raster;
pub mod render;
pub mod scene;
pub mod tables;
pub mod trace;
