//! runs of pixels <-> an append-only file, from which a frame is resumed or put together
//!
//! A line of JSON says what the runs belong to. Each run follows with its own checksum, so a tail that was cut off while
//! it was written is noticed and left out. The sums are those of memory, bit for bit.

use std::collections::HashMap;
use std::fs::File;
use std::io::{BufRead as _, BufReader, Read, Seek as _, SeekFrom, Write as _};
use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::{Run, Transfer};

/// What the runs of a file belong to.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Subject {
    /// What the picture is known by: runs of another one are of no use.
    pub stamp: String,
    /// Of the whole film, of which `columns` and `rows` are made.
    pub width: u32,
    /// From the left.
    pub columns: Range<u32>,
    /// From the top.
    pub rows: Range<u32>,
    /// Samples of a finished pixel.
    pub samples: u32,
    /// How colors become a display's numbers.
    pub transfer: Transfer,
    /// The first sample, where the runs are a part of all samples.
    pub from: u32,
    /// The sample after the last.
    pub to: u32,
}

/// The longest first line.
const MOST_HEAD: u64 = 4096;
const MAGIC: &str = "twinlight runs 2 ";
/// First pixel, pixels, first sample, sample after the last.
const COUNTS: usize = 16;
const PIXEL: usize = 24;
const SUM: usize = 16;

/// The first line.
fn head(subject: &Subject) -> String {
    format!("{MAGIC}{}\n", serde_json::to_string(subject).unwrap_or_default())
}

/// A run as bytes.
fn record(head: &[u8], run: &Run) -> Vec<u8> {
    let counts = [run.pixels.start, run.pixels.len() as u32, run.samples.start, run.samples.end];
    let mut bytes = Vec::with_capacity(COUNTS + run.sums.len() * PIXEL + SUM);
    bytes.extend(counts.iter().flat_map(|count| count.to_le_bytes()));
    bytes.extend(run.sums.iter().flatten().flat_map(|part| part.to_bits().to_le_bytes()));
    bytes.extend(run.squares.iter().flat_map(|square| square.to_bits().to_le_bytes()));
    bytes.extend(run.ids.iter().flat_map(|id| id.to_le_bytes()));
    let sum = checksum(head, &bytes);
    bytes.extend(sum);
    bytes
}

fn checksum(head: &[u8], bytes: &[u8]) -> [u8; SUM] {
    let mut hasher = blake3::Hasher::new();
    hasher.update(head).update(bytes);
    let mut sum = [0; SUM];
    sum.copy_from_slice(&hasher.finalize().as_bytes()[..SUM]);
    sum
}

/// All of a file: its subject and its runs.
#[must_use]
pub fn written(subject: &Subject, runs: &[Run]) -> Vec<u8> {
    let head = head(subject).into_bytes();
    let mut bytes = head.clone();
    bytes.extend(runs.iter().flat_map(|run| record(&head, run)));
    bytes
}

/// Reads a file run by run.
#[derive(Debug)]
pub struct Reader<R> {
    source: BufReader<R>,
    head: Vec<u8>,
    subject: Subject,
    /// Bytes of whole runs, and of the first line.
    read: u64,
}

impl<R: Read> Reader<R> {
    /// Reads the first line; nothing if it is not one of ours.
    pub fn new(source: R) -> Option<Self> {
        let mut source = BufReader::new(source);
        let mut head = Vec::new();
        (&mut source).take(MOST_HEAD).read_until(b'\n', &mut head).ok()?;
        let text = std::str::from_utf8(&head).ok()?.strip_suffix('\n')?.strip_prefix(MAGIC)?;
        let subject: Subject = serde_json::from_str(text).ok()?;
        let inside = subject.columns.start < subject.columns.end
            && subject.columns.end <= subject.width
            && subject.rows.start < subject.rows.end
            && u64::from(subject.width) * u64::from(subject.rows.end) < 1 << 30
            && subject.from < subject.to
            && subject.to <= subject.samples;
        let read = head.len() as u64;
        inside.then_some(Self { source, head, subject, read })
    }

    /// What the runs belong to.
    #[must_use]
    pub fn subject(&self) -> &Subject {
        &self.subject
    }

    /// The next run; nothing at the end, or where the file is torn.
    pub fn run(&mut self) -> Option<Run> {
        let mut bytes = vec![0; COUNTS];
        self.source.read_exact(&mut bytes).ok()?;
        let word = |bytes: &[u8]| u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]);
        let counts: Vec<u32> = bytes.chunks_exact(4).map(word).collect();
        let [first, count, from, to] = counts[..] else { return None };
        let all = self.subject.width * self.subject.rows.end;
        let end = first.checked_add(count).filter(|end| count > 0 && *end <= all && from < to)?;
        // What is not there is not allocated.
        let rest = count as usize * PIXEL + SUM;
        let got = (&mut self.source).take(rest as u64).read_to_end(&mut bytes).ok()?;
        let (body, sum) = bytes.split_at_checked(COUNTS + rest - SUM).filter(|_| got == rest)?;
        if checksum(&self.head, body) != *sum {
            return None;
        }
        let words: Vec<u32> = body[COUNTS..].chunks_exact(4).map(word).collect();
        let (sums, rest) = words.split_at(count as usize * 4);
        let (squares, ids) = rest.split_at(count as usize);
        let part = |four: &[u32]| [0, 1, 2, 3].map(|i| f32::from_bits(four[i]));
        let sums = sums.chunks_exact(4).map(part).collect();
        let squares = squares.iter().map(|&square| f32::from_bits(square)).collect();
        self.read += bytes.len() as u64;
        Some(Run { pixels: first..end, samples: from..to, sums, squares, ids: ids.to_vec(), ended: Vec::new() })
    }

    /// Whether all of the file was read.
    pub fn is_at_end(&mut self) -> bool {
        self.source.fill_buf().is_ok_and(<[u8]>::is_empty)
    }
}

/// A frame's runs on their way to a file.
#[derive(Debug)]
pub struct Ledger {
    file: File,
    head: Vec<u8>,
    /// Where the last record of the runs that begin at a pixel stands.
    places: HashMap<u32, u64>,
    /// Not yet written.
    waiting: Vec<Run>,
}

impl Ledger {
    /// What the file holds of the subject; of anything else it is emptied, and a torn tail is cut off.
    ///
    /// # Errors
    /// If the file cannot be read or cut.
    pub fn open(mut file: File, subject: &Subject) -> std::io::Result<Self> {
        let head = head(subject).into_bytes();
        let mut places = HashMap::new();
        file.seek(SeekFrom::Start(0))?;
        let mut whole = 0;
        if let Some(mut reader) = Reader::new(&file).filter(|reader| reader.subject == *subject) {
            whole = reader.read;
            while let Some(run) = reader.run() {
                places.insert(run.pixels.start, whole);
                whole = reader.read;
            }
        }
        if file.metadata()?.len() != whole {
            file.set_len(whole)?;
        }
        Ok(Self { file, head, places, waiting: Vec::new() })
    }

    /// Gives up all that was kept: where there is no room for it, the picture needs what there is.
    pub fn forget(self) {
        let _ = self.file.set_len(0);
    }

    /// The pixels from `first` on, as far as they are kept.
    pub fn kept(&mut self, first: u32) -> Option<Run> {
        if let Some(run) = self.waiting.iter().rev().find(|run| run.pixels.start == first) {
            return Some(run.clone());
        }
        let place = *self.places.get(&first)?;
        self.file.seek(SeekFrom::Start(0)).ok()?;
        let mut reader = Reader::new(&self.file)?;
        reader.source.seek(SeekFrom::Start(place)).ok()?;
        reader.run()
    }

    /// Takes a run; an earlier state of the same pixels that was not written gives way.
    pub fn keep(&mut self, run: &Run) {
        self.waiting.retain(|other| other.pixels.start != run.pixels.start);
        self.waiting.push(run.clone());
    }

    /// Writes all that was taken.
    ///
    /// # Errors
    /// If the folder or disk refuses; what was written before is still good.
    pub fn flush(&mut self) -> std::io::Result<()> {
        if self.waiting.is_empty() {
            return Ok(());
        }
        let end = self.file.seek(SeekFrom::End(0))?;
        let runs = std::mem::take(&mut self.waiting);
        if let Err(error) = self.write(end, &runs) {
            // As if it had not been tried.
            let _ = self.file.set_len(end);
            for run in &runs {
                self.places.remove(&run.pixels.start);
            }
            return Err(error);
        }
        Ok(())
    }

    /// Run by run, since together they may be larger than what there is room for.
    fn write(&mut self, mut end: u64, runs: &[Run]) -> std::io::Result<()> {
        if end == 0 {
            self.file.write_all(&self.head)?;
            end = self.head.len() as u64;
        }
        for run in runs {
            let bytes = record(&self.head, run);
            self.file.write_all(&bytes)?;
            self.places.insert(run.pixels.start, end);
            end += bytes.len() as u64;
        }
        self.file.sync_data()
    }

    /// Bytes of the runs that were not written.
    #[must_use]
    pub fn waiting(&self) -> usize {
        self.waiting.iter().map(|run| run.sums.len() * PIXEL).sum()
    }
}
