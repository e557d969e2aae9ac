//! What a drawn frame is: the stages, and their order.
//!
//! ```text
//! each light:  project -> split -> count -> scan -> fill -> cover                  -> shadows
//! each sample: project -> split -> count -> scan -> fill -> cover -> mark -> shade -> Film
//! ```
//!
//! The shadow pass is the first stages of the color pass, seen from the light. What is nearest is decided in
//! integers and by a minimum, so neither the order of the work nor its division can show in the picture: small faces
//! are drawn by one invocation each, all others become pieces, which are sorted into tiles that a workgroup owns.

use crate::film::{Film, Watch};
use crate::tables::{Drawing, Lens};

/// A film's sums (red, green, blue and the number of samples) and its ids, pixel by pixel.
pub type Drawn = (Vec<[f32; 4]>, Vec<u32>);

/// One method a stage: `wgsl/raster/NAME.wgsl` and `cpu/raster/NAME.rs` do the same.
pub trait Raster {
    /// Depths and ids, where this backend keeps them.
    type Image;
    /// What can go wrong.
    type Error;

    /// nothing -> an image of so many depths and ids on which nothing is drawn
    ///
    /// # Errors
    /// If there is no room for it.
    fn clear(&mut self, depths: usize, ids: usize) -> Result<Self::Image, Self::Error>;

    /// vertices -> corners in fixed point
    ///
    /// # Errors
    /// If the stage cannot be done.
    fn project(&mut self, lens: &Lens) -> Result<(), Self::Error>;

    /// corners -> small faces drawn, and pieces of all others
    ///
    /// # Errors
    /// If the stage cannot be done, or the pieces have no room.
    fn split(&mut self, lens: &Lens, image: &mut Self::Image) -> Result<(), Self::Error>;

    /// pieces -> how many of them each tile has
    ///
    /// # Errors
    /// If the stage cannot be done.
    fn count(&mut self, lens: &Lens) -> Result<(), Self::Error>;

    /// counts -> where each tile's list begins
    ///
    /// # Errors
    /// If the stage cannot be done, or the lists have no room.
    fn scan(&mut self, lens: &Lens) -> Result<(), Self::Error>;

    /// pieces -> the tiles' lists
    ///
    /// # Errors
    /// If the stage cannot be done.
    fn fill(&mut self, lens: &Lens) -> Result<(), Self::Error>;

    /// the tiles' lists -> depths and ids
    ///
    /// # Errors
    /// If the stage cannot be done.
    fn cover(&mut self, lens: &Lens, image: &mut Self::Image) -> Result<(), Self::Error>;

    /// small faces and depths -> ids
    ///
    /// # Errors
    /// If the stage cannot be done.
    fn mark(&mut self, lens: &Lens, image: &mut Self::Image) -> Result<(), Self::Error>;

    /// ids -> colors, added to the film's sums
    ///
    /// # Errors
    /// If the stage cannot be done.
    fn shade(&mut self, lens: &Lens, image: &Self::Image, shadows: &Self::Image) -> Result<(), Self::Error>;

    /// The sums, and the ids of an image, in host memory.
    ///
    /// # Errors
    /// If they cannot be read back, or are not whole.
    fn end(&mut self, image: &Self::Image) -> Result<Drawn, Self::Error>;
}

/// What a lens sees: the stages that both passes share.
///
/// # Errors
/// The backend's.
pub fn draw<R: Raster>(stages: &mut R, lens: &Lens, image: &mut R::Image) -> Result<(), R::Error> {
    stages.project(lens)?;
    stages.split(lens, image)?;
    stages.count(lens)?;
    stages.scan(lens)?;
    stages.fill(lens)?;
    stages.cover(lens, image)
}

/// One frame: every light's shadows, then every sample. `watch` is told the fraction done, and may stop it.
///
/// # Errors
/// The backend's.
pub fn frame<R: Raster>(stages: &mut R, drawing: &Drawing, watch: &mut dyn Watch) -> Result<Film, R::Error> {
    let passes = (drawing.lenses.len() + drawing.eyes.len()) as f64;
    let mut done = 0.0;
    let mut step = |done: &mut f64| {
        *done += 1.0;
        watch.done(*done / passes)
    };
    let mut film = Film::new(drawing.eyes[0].width, drawing.eyes[0].height);
    let mut shadows = stages.clear(drawing.shadow_words(), 0)?;
    for lens in &drawing.lenses {
        draw(stages, lens, &mut shadows)?;
        if step(&mut done).is_break() {
            return Ok(film);
        }
    }
    for eye in &drawing.eyes {
        let pixels = eye.pixels() as usize;
        let mut image = stages.clear(pixels, pixels)?;
        draw(stages, eye, &mut image)?;
        stages.mark(eye, &mut image)?;
        stages.shade(eye, &image, &shadows)?;
        let stop = step(&mut done).is_break();
        if done == passes {
            let (sums, ids) = stages.end(&image)?;
            film.put(0, &sums, &ids);
        } else if stop {
            return Ok(film);
        }
    }
    Ok(film)
}
