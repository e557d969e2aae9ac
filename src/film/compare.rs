//! two films -> where they differ, and whether that is more than the table allows

use glam::{DVec3, Vec3};
use image::{Rgb, RgbImage};

use super::{Film, Transfer};

/// How alike the two sides must be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Standard {
    /// The adapter computes as Rust does (lavapipe): not a bit may differ.
    Exact,
    /// The adapter may fuse and round differently; every path is decided by the scene alone.
    Near,
    /// As [`Near`](Self::Near), but paths are chosen by random numbers, and a hair's difference sends one elsewhere.
    Random,
}

/// What a row of the tolerance table measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measure {
    /// Pixels whose ids differ.
    Ids,
    /// Of these, the ones that lie more than a pixel from an edge.
    InnerIds,
    /// Pixels whose colors differ in any bit.
    Bits,
    /// The share of pixels that differ by more than 2/255.
    Steps,
    /// The largest z of a tile's mean difference.
    TileZ,
    /// The relative difference of the pictures' means.
    Mean,
}

impl Measure {
    /// For a table.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Ids => "pixels whose ids differ",
            Self::InnerIds => "pixels whose ids differ, more than a pixel from an edge",
            Self::Bits => "pixels whose colors differ in any bit",
            Self::Steps => "share of pixels that differ by more than 2/255",
            Self::TileZ => "largest z of a 16 x 16 tile's mean difference",
            Self::Mean => "relative difference of the pictures' means",
        }
    }
}

/// One row of the tolerance table.
#[derive(Debug, Clone, Copy)]
pub struct Tolerance {
    /// A: ids, B: colors, C: means of random paths.
    pub tier: char,
    /// Which standards it is asked of.
    pub asked: &'static [Standard],
    /// What is measured.
    pub what: Measure,
    /// The most of it that passes.
    pub most: f64,
    /// Why so.
    pub reason: &'static str,
}

use Standard::{Exact, Near, Random};

/// Every tolerance there is, with its reason.
pub const TOLERANCES: [Tolerance; 6] = [
    Tolerance {
        tier: 'A',
        asked: &[Exact],
        what: Measure::Ids,
        most: 0.0,
        reason: "both sides do the same operations in the same order, and lavapipe rounds as Rust does",
    },
    Tolerance {
        tier: 'A',
        asked: &[Near, Random],
        what: Measure::InnerIds,
        most: 0.0,
        reason: "a fused product moves a hit by an ulp, and an edge by less than a pixel",
    },
    Tolerance {
        tier: 'B',
        asked: &[Exact],
        what: Measure::Bits,
        most: 0.0,
        reason: "no operation is used that lavapipe rounds otherwise than Rust",
    },
    Tolerance {
        tier: 'B',
        asked: &[Near],
        what: Measure::Steps,
        most: 0.001,
        reason: "division and square root may be 2.5 ulps off (WGSL), and reflected edges move",
    },
    Tolerance {
        tier: 'C',
        asked: &[Random],
        what: Measure::TileZ,
        most: 6.0,
        reason: "by chance below 1e-4 in a picture of 100,000 tiles; single pixels are not comparable",
    },
    Tolerance {
        tier: 'C',
        asked: &[Random],
        what: Measure::Mean,
        most: 0.005,
        reason: "the same light in all, whichever way each path went",
    },
];

/// What was measured for one row of the table.
#[derive(Debug, Clone, Copy)]
pub struct Row {
    /// The row.
    pub tolerance: Tolerance,
    /// How much was found.
    pub found: f64,
}

impl Row {
    /// Whether it is within the tolerance. What is not a number never is.
    #[must_use]
    pub fn passes(&self) -> bool {
        self.found <= self.tolerance.most
    }
}

/// Two films compared in linear light.
#[derive(Debug, Clone)]
pub struct Comparison {
    /// The rows that the standard asks for.
    pub rows: Vec<Row>,
    /// The largest difference of any color part.
    pub largest: f64,
    /// Where it is, from the top left.
    pub worst: [u32; 2],
    /// The mean difference of all color parts.
    pub mean: f64,
}

impl Comparison {
    /// Whether all rows pass.
    #[must_use]
    pub fn passes(&self) -> bool {
        !self.rows.is_empty() && self.rows.iter().all(Row::passes)
    }
}

/// Films of two sizes are not comparable.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the pictures are {}x{} and {}x{}: only pictures of one size can be compared", .0[0], .0[1], .1[0], .1[1])]
pub struct Sizes(pub [u32; 2], pub [u32; 2]);

/// Measures what the standard asks for.
///
/// # Errors
/// [`Sizes`] if the films differ in size.
pub fn compare(a: &Film, b: &Film, standard: Standard) -> Result<Comparison, Sizes> {
    let size = [a.width(), a.height()];
    if size != [b.width(), b.height()] {
        return Err(Sizes(size, [b.width(), b.height()]));
    }
    let pixels = || 0..a.pixels();
    let mut largest = 0.0;
    let mut worst = [0, 0];
    let mut sum = 0.0;
    for p in pixels() {
        let difference = difference(a, b, p);
        sum += f64::from(difference.element_sum());
        // The negation lets a NaN through, which is the worst there is.
        if !(f64::from(difference.max_element()) <= largest || f64::is_nan(largest)) {
            largest = f64::from(difference.max_element());
            worst = [p % size[0], p / size[0]];
        }
    }
    let measure = |what: Measure| match what {
        Measure::Ids => pixels().filter(|&p| a.id(p) != b.id(p)).count() as f64,
        Measure::InnerIds => pixels().filter(|&p| a.id(p) != b.id(p) && !edge(a, p) && !edge(b, p)).count() as f64,
        Measure::Bits => pixels().filter(|&p| bits(a, p) != bits(b, p)).count() as f64,
        Measure::Steps => {
            let over = pixels().filter(|&p| difference(a, b, p).max_element() > 2.0 / 255.0 || !finite(a, b, p));
            over.count() as f64 / f64::from(a.pixels())
        }
        Measure::TileZ => largest_z(a, b),
        Measure::Mean => {
            let sum = |film: &Film| pixels().map(|p| film.color(p).as_dvec3()).sum::<DVec3>();
            let (a, b) = (sum(a), sum(b));
            let relative = (a - b).abs() / a.abs().max(b.abs()).max(DVec3::splat(f64::MIN_POSITIVE));
            if relative.is_finite() { relative.max_element() } else { f64::NAN }
        }
    };
    let rows = TOLERANCES.iter().filter(|t| t.asked.contains(&standard));
    Ok(Comparison {
        rows: rows.map(|t| Row { tolerance: *t, found: measure(t.what) }).collect(),
        largest,
        worst,
        mean: sum / f64::from(3 * a.pixels()),
    })
}

fn difference(a: &Film, b: &Film, pixel: u32) -> Vec3 {
    (a.color(pixel) - b.color(pixel)).abs()
}

fn finite(a: &Film, b: &Film, pixel: u32) -> bool {
    a.color(pixel).is_finite() && b.color(pixel).is_finite()
}

fn bits(film: &Film, pixel: u32) -> [u32; 4] {
    let color = film.color(pixel);
    [color.x.to_bits(), color.y.to_bits(), color.z.to_bits(), film.samples(pixel).to_bits()]
}

/// Whether one of the eight neighbors has another id.
fn edge(film: &Film, pixel: u32) -> bool {
    let (x, y) = (pixel % film.width(), pixel / film.width());
    let columns = x.saturating_sub(1)..=(x + 1).min(film.width() - 1);
    let rows = y.saturating_sub(1)..=(y + 1).min(film.height() - 1);
    rows.flat_map(|y| columns.clone().map(move |x| y * film.width() + x)).any(|p| film.id(p) != film.id(pixel))
}

const TILE: u32 = 16;

/// For each tile, how many standard errors its mean difference lies from zero; the largest of them.
fn largest_z(a: &Film, b: &Film) -> f64 {
    let mut largest = 0.0_f64;
    for top in (0..a.height()).step_by(TILE as usize) {
        for left in (0..a.width()).step_by(TILE as usize) {
            let rows = top..(top + TILE).min(a.height());
            let columns = left..(left + TILE).min(a.width());
            let pixels = rows.flat_map(|y| columns.clone().map(move |x| y * a.width() + x));
            let signed: Vec<_> = pixels.map(|p| (a.color(p) - b.color(p)).as_dvec3()).collect();
            let n = signed.len() as f64;
            let mean = signed.iter().sum::<DVec3>() / n;
            let spread = signed.iter().map(|d| (d - mean) * (d - mean)).sum::<DVec3>() / (n - 1.0).max(1.0);
            // A tenth of a step of an 8-bit picture is no difference, however even it is.
            let error = (spread / n).map(f64::sqrt).max(DVec3::splat(0.1 / 255.0));
            let z = if mean.is_finite() { (mean.abs() / error).max_element() } else { f64::NAN };
            largest = if z.is_nan() || largest.is_nan() { f64::NAN } else { largest.max(z) };
        }
    }
    largest
}

/// `a | b | difference x gain`, side by side.
///
/// # Errors
/// [`Sizes`] if the films differ in size.
pub fn side_by_side(a: &Film, b: &Film, transfer: Transfer, gain: f32) -> Result<RgbImage, Sizes> {
    let size = [a.width(), a.height()];
    if size != [b.width(), b.height()] {
        return Err(Sizes(size, [b.width(), b.height()]));
    }
    let [left, right] = [a, b].map(|film| film.to_rgb8(transfer));
    Ok(RgbImage::from_fn(3 * size[0], size[1], |x, y| match x / size[0] {
        0 => *left.get_pixel(x, y),
        1 => *right.get_pixel(x - size[0], y),
        _ => {
            let pixel = y * size[0] + x - 2 * size[0];
            if finite(a, b, pixel) {
                Rgb((difference(a, b, pixel) * gain).to_array().map(|c| Transfer::None.encode(c)))
            } else {
                Rgb([255, 0, 255])
            }
        }
    }))
}
