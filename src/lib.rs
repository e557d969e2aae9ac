//! Twinlight renders 3-D scenes with nothing but WGSL compute shaders, and every GPU stage has a CPU twin that says
//! what is right. This page is the architecture.
//!
//! It grew from Zhang Zichuan's [course project](https://github.com/a389071432/CourseProjectCG). "The spec" in
//! comments is that project's document: part 1 is its rasterizer, part 2 its ray tracer, and "Eq." and "fig." are its
//! numbers.
//!
//! # One picture
//!
//! ```text
//!           scene.toml -> Scene -> Tables, or Drawing
//! traced    [cast -> follow -> gather] x rounds                                         -> Film -> picture
//! drawn     each light:  [project -> split -> cut -> count -> scan -> fill -> cover]    -> shadow maps
//!           each sample: [project -> split -> cut -> count -> scan -> fill -> cover -> mark
//!                        -> sift -> shade, ground]                                      -> Film -> picture
//! ```
//!
//! Left out here: `few`, which does all three at once for scenes of few things; `steps`, in the place of `follow` for
//! `--show steps`; `lace`, in the place of `cover` for cut-out faces; `crowd -> heat`, in the place of the last three
//! for `--show tiles`; and `call`, which sizes the GPU's next dispatches. With 64-bit atomics `split` does the work of
//! `mark`.
//!
//! A frame is written **once**, as a trait with a method for each of its stages and a function over it
//! ([`trace::Trace`], [`raster::Raster`], and `frame` beside each). [`cpu`] and [`gpu`] implement the trait and do not
//! know each other. A CPU stage's arguments are the kernel's `read` bindings; its results are the `read_write` ones.
//!
//! # One stage, one name
//!
//! A stage has one name in four places: the kernel `wgsl/trace/follow.wgsl`, its twin `src/cpu/trace/follow.rs`, the
//! trait's method [`trace::Trace::follow`], and the label of the GPU's objects. Both files open with the same line,
//! which says what flows in and out. Of the window's two stages, `lay` is a method of [`trace::grow::Grow`] and
//! `develop`, which makes a display's bytes, is a function; `call` is the GPU's alone to ask.
//!
//! # Floors
//!
//! A module may use those below its own floor, never those above or beside it (`tests/suite/tidy.rs` holds this):
//!
//! ```text
//! 7  bin                   people
//! 6  view                  what the preview knows and does, without its window
//! 5  render | explain      picks method and backend; the only place that knows both | a pixel and all that made it
//! 4  cpu | gpu             how a stage is done; strangers to each other
//! 3  raster | trace        what a frame is: the trait, the order of stages
//! 2  prepare               Scene -> Tables or Drawing
//! 1  scene, tables, film   nouns
//! 0  math                  numbers
//! ```
//!
//! # What holds the twins together
//!
//! The same bits: on Mesa's lavapipe `+ - * /` and `sqrt` of f32 are those of Rust, so the twins are written with
//! these alone ([`math`]), in one order, with the same integer-hash random numbers, and the tests ask for **no
//! differing bit** between them, stage by stage and picture by picture. On other adapters the table
//! [`film::compare::TOLERANCES`] says how much may differ and why.
//!
//! The rasterizer decides in integers: corners are snapped to 1/256 pixel, coverage and depth are integer planes, and
//! the least (depth, id) wins. An image holds both as what they lack of the largest number, so that zero is nothing and
//! the largest wins. A maximum does not mind who comes first, so no order of work and no division of it can show in the
//! picture ([`raster`]), and neither can the variant of a kernel ([`gpu::Variant`]): with or without 64-bit atomics,
//! with or without subgroups.
//!
//! # What the GPU is not trusted with
//!
//! Drivers cut loops, kill long work and report it as done. So a pixel's ray tree can be put down after any loop turn
//! and taken up again ([`tables::Path`]); work goes in slices that are counted and timed; kernels report cut loops and
//! full stacks; and a film is only taken when each of its pixels has all its samples ([`gpu::GpuTrace`]). What fails
//! is tried again in smaller slices, and then on the CPU, with a sentence ([`render::Renderer`]).
//!
//! # An example
//!
//! ```
//! use twinlight::gpu::Wanted;
//! use twinlight::render::{Backend, Renderer};
//! use twinlight::scene::{Method, parse};
//!
//! let scene = parse(
//!     r##"
//!     [camera]
//!     position = [0, 0, 3]
//!     look_at = [0, 0, 0]
//!     [film]
//!     size = [33, 21]
//!     background = "#204060"
//!     [[light.directional]]
//!     toward = [0, 0, 1]
//!     [[material]]
//!     name = "white"
//!     [[object.sphere]]
//!     center = [0, 0, 0]
//!     radius = 1
//!     material = "white"
//!     "##,
//!     "example".as_ref(),
//! )?;
//! let mut renderer = Renderer::open(Backend::Cpu, &Wanted::Best)?;
//! let film = renderer.render(&scene, Method::Trace, &mut |_done| ())?.film;
//! let picture = film.to_rgb8(scene.film.transfer);
//! assert_eq!(picture.get_pixel(16, 10).0, [255, 255, 255]);
//! assert_eq!(picture.get_pixel(0, 0).0, [0x20, 0x40, 0x60]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![forbid(unsafe_code)]

pub mod cpu;
pub mod explain;
pub mod film;
pub mod gpu;
pub mod math;
pub mod prepare;
pub mod raster;
pub mod render;
pub mod scene;
pub mod tables;
pub mod trace;
pub mod view;
