//! a frame, one sample of every pixel after the other -> a film of as many samples as there was time for

use std::ops::ControlFlow;

use super::{BLOCK, Part, Trace, block};
use crate::film::{Film, Run, Watch, variance};
use crate::tables::Tables;

/// When a film is good enough.
pub struct Until<'a> {
    /// How much of the time is used, from 0 to 1; every pixel gets a sample first.
    pub spent: &'a dyn Fn() -> f64,
    /// The error below which a tile gets no more samples: the root of the mean square of its pixels' standard errors,
    /// in luminance.
    pub noise: Option<f32>,
}

/// Columns and rows of a tile that is judged as one.
const TILE: u32 = 16;
/// Tiles are judged after each so many samples: of few, some lie close together by chance.
const JUDGED: u32 = 16;

/// A part of a frame until it is good enough, or has all samples; nothing if it was stopped before.
///
/// A pixel of n samples has the bits of one of which [`part`](super::part) makes the first n.
///
/// # Errors
/// The backend's, once smaller portions no longer help.
pub fn passes<T: Trace>(
    stages: &mut T,
    tables: &Tables,
    part: &Part,
    watch: &mut dyn Watch,
    until: &Until<'_>,
) -> Result<Option<Film>, T::Error> {
    let spent = until.spent;
    let mut film = Film::new(part.columns.len() as u32, part.rows.len() as u32);
    let first = part.samples.start;
    let mut whole = Run::new(0..film.pixels(), first);
    let mut open = whole.clone();
    for sample in part.samples.clone() {
        let ended = 1.0 - f64::from(open.going()) / f64::from(film.pixels());
        let mut told = |within: f64| {
            let share = (f64::from(sample - first) + within) / part.samples.len() as f64;
            // Until the film is laid it is not done, however much time is used: a stop is one.
            watch.done(share.max(ended).max(spent()).min(0.99))
        };
        if pass(stages, tables, part, &mut open, &mut told)?.is_break() {
            // A pass that is not whole would leave pixels with fewer samples than others.
            return Ok(None);
        }
        open.samples.end = sample + 1;
        let made = open.samples.end - first;
        if let Some(noise) = until.noise.filter(|_| made.is_multiple_of(JUDGED)) {
            open.ended = judged(&whole, &open, film.width(), noise);
        }
        let last = open.samples.end == part.samples.end || open.going() == 0 || spent() >= 1.0;
        if open.samples.end.is_multiple_of(BLOCK) || last {
            whole.add(open.samples.end, &open.sums, &open.squares, &open.ids);
            open = Run { ended: open.ended, ..Run::new(0..film.pixels(), whole.samples.end) };
        }
        if last {
            break;
        }
    }
    film.put(0, &whole.sums, &whole.ids);
    film.put_squares(0, &whole.squares);
    let _ = watch.done(1.0);
    Ok(Some(film))
}

/// The pixels of tiles whose error is below `noise`, and of those that had ended before.
fn judged(whole: &Run, open: &Run, width: u32, noise: f32) -> Vec<bool> {
    let mut ended: Vec<bool> = (0..open.sums.len()).map(|pixel| open.has_ended(pixel)).collect();
    let height = open.sums.len() as u32 / width;
    let error = |pixel: usize| {
        let sum = std::array::from_fn(|i| whole.sums[pixel][i] + open.sums[pixel][i]);
        variance(sum, whole.squares[pixel] + open.squares[pixel]) / f64::from(sum[3])
    };
    for top in (0..height).step_by(TILE as usize) {
        for left in (0..width).step_by(TILE as usize) {
            let rows = top..height.min(top + TILE);
            let row = |row: u32| (row * width + left..row * width + width.min(left + TILE)).map(|p| p as usize);
            let tile: Vec<usize> = rows.flat_map(row).collect();
            let squared: f64 = tile.iter().map(|&pixel| error(pixel)).sum();
            if squared <= f64::from(noise).powi(2) * tile.len() as f64 {
                for pixel in tile {
                    ended[pixel] = true;
                }
            }
        }
    }
    ended
}

/// One more sample of every pixel that gets any.
fn pass<T: Trace>(
    stages: &mut T,
    tables: &Tables,
    part: &Part,
    open: &mut Run,
    told: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<ControlFlow<()>, T::Error> {
    let all = open.pixels.len() as f64;
    let mut at = 0;
    for run in part.runs(tables) {
        let end = at + run.len() as u32;
        while at < end {
            let count = stages.most_pixels().clamp(1, end - at);
            let mut here = open.cut(at..at + count);
            if here.going() == 0 {
                at += count;
                continue;
            }
            let pixel = run.end - (end - at);
            here.pixels = pixel..pixel + count;
            let mut within = |share: f64| told((f64::from(at) + share * f64::from(count)) / all);
            match block(stages, tables, &here, here.samples.end + 1, &mut within) {
                Ok(Some(paths)) => {
                    let range = at as usize..(at + count) as usize;
                    open.sums[range.clone()].copy_from_slice(&paths.sums);
                    open.squares[range.clone()].copy_from_slice(&paths.squares);
                    open.ids[range].copy_from_slice(&paths.ids);
                    at += count;
                }
                Ok(None) => return Ok(ControlFlow::Break(())),
                Err(error) => stages.ease(error)?,
            }
        }
    }
    Ok(ControlFlow::Continue(()))
}
