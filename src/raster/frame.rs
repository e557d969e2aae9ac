//! a drawing -> its film, lens after lens and window after window

use std::iter;
use std::ops::{ControlFlow, Range};

use super::{Look, Raster};
use crate::film::{Band, Film, Run, Watch, split};
use crate::tables::{Drawing, Lens, SHOW_TILES};

/// Asked between portions of a lens's faces: whether to go on.
type Asked<'a> = &'a mut dyn FnMut() -> ControlFlow<()>;

const GO_ON: ControlFlow<()> = ControlFlow::Continue(());

/// What a lens sees: the stages that both passes share.
///
/// # Errors
/// The backend's.
pub fn draw<R: Raster>(stages: &mut R, lens: &Lens, image: &mut R::Image) -> Result<(), R::Error> {
    drawn(stages, lens, image, &mut || GO_ON).map(|_| ())
}

/// The same for who may stop it; then not all is drawn.
fn drawn<R: Raster>(
    stages: &mut R,
    lens: &Lens,
    image: &mut R::Image,
    asked: Asked<'_>,
) -> Result<ControlFlow<()>, R::Error> {
    stages.project(lens)?;
    if layer(stages, lens, image, false, asked)?.is_break() {
        return Ok(ControlFlow::Break(()));
    }
    if stages.laced() { layer(stages, lens, image, true, asked) } else { Ok(GO_ON) }
}

fn layer<R: Raster>(
    stages: &mut R,
    lens: &Lens,
    image: &mut R::Image,
    lace: bool,
    asked: Asked<'_>,
) -> Result<ControlFlow<()>, R::Error> {
    loop {
        // No cut-out face is drawn before it is in a tile, so that none of them is hidden as a whole.
        let whole = iter::once(0..stages.faces());
        let portions = if lace { whole.collect() } else { stages.portions(lens) };
        for faces in portions {
            if faces.start > 0 {
                if asked().is_break() {
                    return Ok(ControlFlow::Break(()));
                }
                stages.far(lens, image)?;
                stages.veil(lens)?;
            }
            stages.split(lens, image, lace, faces)?;
        }
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
            return Ok(GO_ON);
        }
        if asked().is_break() {
            return Ok(ControlFlow::Break(()));
        }
    }
}

/// What an eye sees, with its ids.
///
/// # Errors
/// The backend's.
pub fn marked<R: Look>(stages: &mut R, eye: &Lens, image: &mut R::Image) -> Result<(), R::Error> {
    if stages.marks() && stages.portions(eye).len() > 1 {
        stages.far(eye, image)?;
        stages.veil(eye)?;
    }
    stages.mark(eye, image)
}

/// One sample of each pixel that an eye sees, added to the sums.
///
/// # Errors
/// The backend's.
pub fn look<R: Look>(
    stages: &mut R,
    drawing: &Drawing,
    eye: &Lens,
    image: &mut R::Image,
    shadows: &R::Image,
) -> Result<(), R::Error> {
    looked(stages, drawing, eye, image, shadows, &mut || GO_ON).map(|_| ())
}

/// The same for who may stop it; then nothing is added.
fn looked<R: Look>(
    stages: &mut R,
    drawing: &Drawing,
    eye: &Lens,
    image: &mut R::Image,
    shadows: &R::Image,
    asked: Asked<'_>,
) -> Result<ControlFlow<()>, R::Error> {
    stages.clear(image)?;
    if drawn(stages, eye, image, asked)?.is_break() {
        return Ok(ControlFlow::Break(()));
    }
    marked(stages, eye, image)?;
    if drawing.canvas.show == SHOW_TILES {
        stages.crowd(eye)?;
        stages.heat(eye)?;
    } else {
        stages.sift(eye, image)?;
        stages.shade(eye, image, shadows)?;
        stages.ground(eye)?;
    }
    Ok(GO_ON)
}

/// One frame: every light's shadows, then every sample. `watch` is told the fraction done, and may stop it.
///
/// # Errors
/// The backend's.
pub fn frame<R: Look>(stages: &mut R, drawing: &Drawing, watch: &mut dyn Watch) -> Result<Film, R::Error> {
    part(stages, drawing, &drawing.film().map(|side| 0..side), watch)
}

/// A rectangle of a frame, window by window. No window shows: each pixel is decided by the same numbers in all of them.
///
/// # Errors
/// The backend's.
pub fn part<R: Look>(
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

/// How many lenses are drawn, of how many.
struct Steps {
    done: usize,
    all: usize,
}

impl Steps {
    /// Whether to go on, asked in the middle of a lens.
    fn asks(&self, watch: &mut dyn Watch) -> ControlFlow<()> {
        watch.done(self.done as f64 / self.all as f64)
    }

    /// One lens more; what is done cannot be stopped any more.
    fn on(&mut self, watch: &mut dyn Watch) -> ControlFlow<()> {
        self.done += 1;
        if self.asks(watch).is_break() && self.done < self.all { ControlFlow::Break(()) } else { GO_ON }
    }
}

/// The same, so many rows at a time, from the top; of several bands each is kept as a run of pixels.
///
/// # Errors
/// The backend's.
pub fn bands<R: Look>(
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
    let mut steps = Steps { done: 0, all: drawing.lenses.len() + all().count() };
    let mut shadows = stages.image(drawing.shadow_words(), false)?;
    stages.clear(&mut shadows)?;
    for lens in &drawing.lenses {
        let flow = drawn(stages, lens, &mut shadows, &mut || steps.asks(watch))?;
        if flow.is_break() || steps.on(watch).is_break() {
            return Ok(());
        }
    }
    let mut image = stages.image(all().map(Lens::pixels).max().unwrap_or(0) as usize, true)?;
    for (band, windows) in bands.iter().zip(&windows) {
        let top = band[1].start - rows.start;
        let kept = if bands.len() > 1 { taken_up(drawing, band, watch) } else { None };
        if let Some(film) = kept {
            let stopped = windows.iter().flatten().any(|_| steps.on(watch).is_break());
            if stopped || each(Band { top, film }).is_break() {
                return Ok(());
            }
            continue;
        }
        let mut film = Film::new(columns.len() as u32, band[1].len() as u32);
        for eyes in windows {
            for eye in eyes {
                let flow = looked(stages, drawing, eye, &mut image, &shadows, &mut || steps.asks(watch))?;
                if flow.is_break() || steps.on(watch).is_break() {
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
