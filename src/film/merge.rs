//! parts of a picture's samples -> the picture, as if it had been made at once

use std::collections::HashMap;
use std::io::Read;
use std::ops::Range;

use super::ledger::{Reader, Subject};
use super::{Film, Run};

/// Why parts are not put together.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Misfit {
    /// A file that holds no runs.
    #[error("{0}: this is no part of a picture; --sample-range makes such")]
    NotAPart(String),
    /// The file ends within a run, or a byte of it has changed.
    #[error("{0}: this part is damaged, or was not written to its end")]
    Damaged(String),
    /// Parts of two pictures.
    #[error("{0}: this is a part of another picture than {1}: other scene, settings, version or adapter")]
    Foreign(String, String),
    /// Samples that no part has.
    #[error("samples {0} to {1} are in no part")]
    Gap(u32, u32),
    /// Samples that two parts have.
    #[error("samples {0} to {1} are in two parts")]
    Overlap(u32, u32),
    /// Pixels that a part lacks, or has twice.
    #[error("a part has some pixels of its samples {0} to {1} twice, or not at all")]
    Pixels(u32, u32),
}

/// Runs of the same samples.
type Block = Vec<Run>;

/// Puts parts together; each has a name for errors.
///
/// # Errors
/// [`Misfit`] if they are not all samples of one picture, each once.
pub fn merge<R: Read>(parts: Vec<(String, R)>) -> Result<(Subject, Film), Misfit> {
    let mut whole: Option<(String, Subject)> = None;
    let mut blocks: HashMap<(u32, u32), Block> = HashMap::new();
    let mut ranges: Vec<Range<u32>> = Vec::new();
    for (name, part) in parts {
        let mut reader = Reader::new(part).ok_or_else(|| Misfit::NotAPart(name.clone()))?;
        let subject = reader.subject().clone();
        let all = Subject { from: 0, to: subject.samples, ..subject.clone() };
        let (first, known) = whole.get_or_insert_with(|| (name.clone(), all.clone()));
        if *known != all {
            return Err(Misfit::Foreign(name, first.clone()));
        }
        let range = subject.from..subject.to;
        if let Some(other) = ranges.iter().find(|other| other.start < range.end && range.start < other.end) {
            return Err(Misfit::Overlap(other.start.max(range.start), other.end.min(range.end)));
        }
        ranges.push(range);
        let mut pixels = 0_u64;
        while let Some(run) = reader.run() {
            pixels += run.pixels.len() as u64 * run.samples.len() as u64;
            blocks.entry((run.samples.start, run.samples.end)).or_default().push(run);
        }
        let film = (subject.columns.len() * subject.rows.len()) as u64;
        if !reader.is_at_end() || pixels < film * u64::from(subject.to - subject.from) {
            return Err(Misfit::Damaged(name));
        }
    }
    let Some((_, subject)) = whole else { return Err(Misfit::Gap(0, 0)) };
    let mut order: Vec<_> = blocks.into_iter().collect();
    order.sort_by_key(|(samples, _)| *samples);
    let mut sum = None;
    let mut end = 0;
    for ((from, to), block) in order {
        if from > end {
            return Err(Misfit::Gap(end, from));
        }
        if from < end {
            return Err(Misfit::Overlap(from, end.min(to)));
        }
        let block = laid_out(&subject, block).ok_or(Misfit::Pixels(from, to))?;
        let sum = sum.get_or_insert_with(|| Run::new(0..block.pixels(), 0));
        sum.add(to, block.sums(), block.squares(), block.ids());
        end = to;
    }
    if end != subject.samples {
        return Err(Misfit::Gap(end, subject.samples));
    }
    let mut film = Film::new(subject.columns.len() as u32, subject.rows.len() as u32);
    if let Some(sum) = sum {
        film.put(0, &sum.sums, &sum.ids);
        film.put_squares(0, &sum.squares);
    }
    Ok((subject, film))
}

/// The runs side by side, if they are every pixel once.
fn laid_out(subject: &Subject, block: Block) -> Option<Film> {
    // Before the film is allocated: a small file may speak of a huge one.
    let pixels: usize = block.iter().map(|run| run.pixels.len()).sum();
    if pixels != subject.columns.len() * subject.rows.len() {
        return None;
    }
    let mut film = Film::new(subject.columns.len() as u32, subject.rows.len() as u32);
    for run in block {
        let (row, column) = (run.pixels.start / subject.width, run.pixels.start % subject.width);
        let row = row.checked_sub(subject.rows.start)?;
        let column = column.checked_sub(subject.columns.start)?;
        let first = row * film.width() + column;
        let end = first.checked_add(run.pixels.len() as u32)?;
        let fresh = end <= film.pixels() && (first..end).all(|pixel| film.samples(pixel) == 0.0);
        if !fresh {
            return None;
        }
        film.put(first, &run.sums, &run.ids);
        film.put_squares(first, &run.squares);
    }
    Some(film)
}
