//! What a drawn frame is: the stages, and their order.
//!
//! ```text
//! each light:  project -> split -> cut -> count -> scan -> fill -> cover                  -> shadows
//! each sample: project -> split -> cut -> count -> scan -> fill -> cover -> mark
//!              -> sift -> shade, ground                                                    -> Film
//! ```
//!
//! Cut-out faces go the same way once more, each lens's after all others, with lace in the place of cover: it asks their
//! pictures whether they are there. Instead of sift, shade and ground, crowd -> heat show how much each tile has to do (`--show tiles`).
//!
//! The shadow pass is the first stages of the color pass, seen from the light. What is nearest is decided in
//! integers and by a maximum, so neither the order of the work nor its division can show in the picture: small faces
//! are drawn by one invocation each, and never enter a list; all others become pieces, which are sorted into tiles that
//! a workgroup owns.

use std::ops::{ControlFlow, Range};

use crate::film::{Band, Film, Run, Watch, split};
use crate::tables::{Drawing, Lens, SHOW_TILES};

/// A film's sums (red, green, blue and the number of samples) and its ids, pixel by pixel.
pub type Drawn = (Vec<[f32; 4]>, Vec<u32>);

/// Depths and ids of an image, row by row from the top left.
pub type Seen = (Vec<u32>, Vec<u32>);

/// One method a stage: `wgsl/raster/NAME.wgsl` and `cpu/raster/NAME.rs` do the same.
pub trait Raster {
    /// Depths and ids, where this backend keeps them.
    type Image;
    /// What can go wrong.
    type Error;

    /// Room for so many pixels, with ids if they are asked for.
    ///
    /// # Errors
    /// If there is none.
    fn image(&mut self, pixels: usize, ids: bool) -> Result<Self::Image, Self::Error>;

    /// anything -> an image on which nothing is drawn
    ///
    /// # Errors
    /// If it cannot be done.
    fn clear(&mut self, image: &mut Self::Image) -> Result<(), Self::Error>;

    /// vertices -> corners in fixed point, or the planes that they lie beyond
    ///
    /// # Errors
    /// If the stage cannot be done.
    fn project(&mut self, lens: &Lens) -> Result<(), Self::Error>;

    /// faces -> small ones drawn onto the image, and the numbers of all others
    ///
    /// `lace`: of cut-out faces, none of which is drawn at once; else of all others.
    ///
    /// # Errors
    /// If the stage cannot be done.
    fn split(&mut self, lens: &Lens, image: &mut Self::Image, lace: bool) -> Result<(), Self::Error>;

    /// faces that are large or cross a plane -> pieces of them, bin by bin
    ///
    /// # Errors
    /// If the stage cannot be done.
    fn cut(&mut self, lens: &Lens) -> Result<(), Self::Error>;

    /// pieces -> how many of them each list has
    ///
    /// # Errors
    /// If the stage cannot be done.
    fn count(&mut self, lens: &Lens) -> Result<(), Self::Error>;

    /// how many pieces each list has -> where it begins, and the tiles that have any
    ///
    /// # Errors
    /// If the stage cannot be done.
    fn scan(&mut self, lens: &Lens) -> Result<(), Self::Error>;

    /// pieces -> the lists of each tile, in any order
    ///
    /// # Errors
    /// If the stage cannot be done.
    fn fill(&mut self, lens: &Lens) -> Result<(), Self::Error>;

    /// the lists of each tile -> the nearest of its pixels, and the least id of those
    ///
    /// # Errors
    /// If the stage cannot be done.
    fn cover(&mut self, lens: &Lens, image: &mut Self::Image) -> Result<(), Self::Error>;

    /// Whether any face is cut out.
    fn laced(&self) -> bool;

    /// the lists of each tile -> the nearest of its pixels where a cut-out face is there, and the least id of those
    ///
    /// # Errors
    /// If the stage cannot be done.
    fn lace(&mut self, lens: &Lens, image: &mut Self::Image) -> Result<(), Self::Error>;

    /// Waits for the stages; false if something found no room. There is room now, and they are to be done again: what is
    /// drawn twice stays what it is.
    ///
    /// # Errors
    /// If the work was not done, or not to its end, or there is no room.
    fn settle(&mut self, lens: &Lens, image: &mut Self::Image) -> Result<bool, Self::Error>;

    /// small faces and the final depths -> the least id where the depth is theirs
    ///
    /// # Errors
    /// If the stage cannot be done.
    fn mark(&mut self, lens: &Lens, image: &mut Self::Image) -> Result<(), Self::Error>;

    /// ids -> the runs of pixels that show a face, and those that show none
    ///
    /// # Errors
    /// If the stage cannot be done.
    fn sift(&mut self, lens: &Lens, image: &Self::Image) -> Result<(), Self::Error>;

    /// runs that show a face -> each pixel's color, once
    ///
    /// # Errors
    /// If the stage cannot be done.
    fn shade(&mut self, lens: &Lens, image: &Self::Image, shadows: &Self::Image) -> Result<(), Self::Error>;

    /// runs that show no face -> the background, once
    ///
    /// # Errors
    /// If the stage cannot be done.
    fn ground(&mut self, lens: &Lens) -> Result<(), Self::Error>;

    /// small faces -> how many of them each tile has, beside those of its lists
    ///
    /// # Errors
    /// If the stage cannot be done.
    fn crowd(&mut self, lens: &Lens) -> Result<(), Self::Error>;

    /// how many faces each tile has -> the color of its pixels, added to the film's sums
    ///
    /// # Errors
    /// If the stage cannot be done.
    fn heat(&mut self, lens: &Lens) -> Result<(), Self::Error>;

    /// The sums of what a lens sees, and the ids of its image, in host memory; the sums begin anew.
    ///
    /// # Errors
    /// If they cannot be read back, or are not whole.
    fn end(&mut self, lens: &Lens, image: &Self::Image) -> Result<Drawn, Self::Error>;
}

/// What a lens sees: the stages that both passes share.
///
/// # Errors
/// The backend's.
pub fn draw<R: Raster>(stages: &mut R, lens: &Lens, image: &mut R::Image) -> Result<(), R::Error> {
    stages.project(lens)?;
    layer(stages, lens, image, false)?;
    if stages.laced() { layer(stages, lens, image, true) } else { Ok(()) }
}

fn layer<R: Raster>(stages: &mut R, lens: &Lens, image: &mut R::Image, lace: bool) -> Result<(), R::Error> {
    loop {
        stages.split(lens, image, lace)?;
        stages.cut(lens)?;
        stages.count(lens)?;
        stages.scan(lens)?;
        stages.fill(lens)?;
        if lace {
            stages.lace(lens, image)?;
        } else {
            stages.cover(lens, image)?;
        }
        if stages.settle(lens, image)? {
            return Ok(());
        }
    }
}

/// One sample of each pixel that an eye sees, added to the sums.
///
/// # Errors
/// The backend's.
pub fn look<R: Raster>(
    stages: &mut R,
    drawing: &Drawing,
    eye: &Lens,
    image: &mut R::Image,
    shadows: &R::Image,
) -> Result<(), R::Error> {
    stages.clear(image)?;
    draw(stages, eye, image)?;
    stages.mark(eye, image)?;
    if drawing.canvas.show == SHOW_TILES {
        stages.crowd(eye)?;
        return stages.heat(eye);
    }
    stages.sift(eye, image)?;
    stages.shade(eye, image, shadows)?;
    stages.ground(eye)
}

/// One frame: every light's shadows, then every sample. `watch` is told the fraction done, and may stop it.
///
/// # Errors
/// The backend's.
pub fn frame<R: Raster>(stages: &mut R, drawing: &Drawing, watch: &mut dyn Watch) -> Result<Film, R::Error> {
    part(stages, drawing, &drawing.film().map(|side| 0..side), watch)
}

/// A rectangle of a frame, window by window. No window shows: each pixel is decided by the same numbers in all of them.
///
/// # Errors
/// The backend's.
pub fn part<R: Raster>(
    stages: &mut R,
    drawing: &Drawing,
    rectangle: &[Range<u32>; 2],
    watch: &mut dyn Watch,
) -> Result<Film, R::Error> {
    let mut all = None;
    bands(stages, drawing, rectangle, u32::MAX, watch, &mut |band| {
        all = Some(band.film);
        ControlFlow::Continue(())
    })?;
    Ok(all.unwrap_or_else(|| Film::new(rectangle[0].len() as u32, rectangle[1].len() as u32)))
}

/// The same, so many rows at a time, from the top; of several bands each is kept as a run of pixels.
///
/// # Errors
/// The backend's.
pub fn bands<R: Raster>(
    stages: &mut R,
    drawing: &Drawing,
    [columns, rows]: &[Range<u32>; 2],
    height: u32,
    watch: &mut dyn Watch,
    each: &mut dyn FnMut(Band) -> ControlFlow<()>,
) -> Result<(), R::Error> {
    let bands: Vec<_> = split(rows, height).map(|rows| [columns.clone(), rows]).collect();
    let windows: Vec<_> = bands.iter().map(|band| drawing.windows(band)).collect();
    let all = || windows.iter().flatten().flatten();
    let passes = (drawing.lenses.len() + all().count()) as f64;
    let mut done = 0.0;
    let mut step = |watch: &mut dyn Watch| {
        done += 1.0;
        // What is done cannot be stopped any more.
        watch.done(done / passes).is_break() && done < passes
    };
    let mut shadows = stages.image(drawing.shadow_words(), false)?;
    stages.clear(&mut shadows)?;
    for lens in &drawing.lenses {
        draw(stages, lens, &mut shadows)?;
        if step(watch) {
            return Ok(());
        }
    }
    let mut image = stages.image(all().map(Lens::pixels).max().unwrap_or(0) as usize, true)?;
    for (band, windows) in bands.iter().zip(&windows) {
        let top = band[1].start - rows.start;
        let kept = if bands.len() > 1 { taken_up(drawing, band, watch) } else { None };
        if let Some(film) = kept {
            let stopped = windows.iter().flatten().any(|_| step(watch));
            if stopped || each(Band { top, film }).is_break() {
                return Ok(());
            }
            continue;
        }
        let mut film = Film::new(columns.len() as u32, band[1].len() as u32);
        for eyes in windows {
            for eye in eyes {
                look(stages, drawing, eye, &mut image, &shadows)?;
                if step(watch) {
                    return Ok(());
                }
            }
            let (sums, ids) = stages.end(&eyes[0], &image)?;
            let place = [eyes[0].left - columns.start, eyes[0].top - band[1].start];
            film.lay(place, eyes[0].width, &sums, &ids);
        }
        if bands.len() > 1 {
            let run = Run { samples: samples(drawing), ..Run::new(pixels(band), 0) };
            watch.keep(&Run { sums: film.sums().to_vec(), ids: film.ids().to_vec(), ..run });
        }
        if each(Band { top, film }).is_break() {
            return Ok(());
        }
    }
    Ok(())
}

/// The pixels of a band, which are counted along its own rows, as if the picture had no others.
fn pixels([columns, rows]: &[Range<u32>; 2]) -> Range<u32> {
    let width = columns.len() as u32;
    rows.start * width..rows.end * width
}

fn samples(drawing: &Drawing) -> Range<u32> {
    0..drawing.samples() as u32
}

/// A band that an earlier try has kept.
fn taken_up(drawing: &Drawing, band: &[Range<u32>; 2], watch: &mut dyn Watch) -> Option<Film> {
    let run = watch.kept(pixels(band).start)?;
    if run.pixels != pixels(band) || run.samples != samples(drawing) {
        return None;
    }
    let mut film = Film::new(band[0].len() as u32, band[1].len() as u32);
    film.put(0, &run.sums, &run.ids);
    Some(film)
}
