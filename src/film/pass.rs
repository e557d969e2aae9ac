//! what a frame is made of, pixel by pixel, beside its colors: for compositing

use glam::Vec3;
use image::{Rgb, RgbImage};

use super::{Film, Transfer};

/// One of the things that a picture is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, clap::ValueEnum)]
pub enum Pass {
    /// Distance from the eye along the view, in world units; infinite where nothing is.
    Depth,
    /// The shading normal, in world space; zero where nothing is.
    Normal,
    /// The surface's own color, by the weight of its local light.
    Albedo,
    /// The share of the lights that reaches a point; zero where nothing is.
    Shadow,
    /// The number of what is seen; 4294967295 where nothing is.
    Id,
    /// How many samples a pixel has.
    Samples,
    /// The variance of a pixel's samples, by their luminance; the ray tracer's alone.
    Variance,
}

impl Pass {
    /// Its name in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Depth => "depth",
            Self::Normal => "normal",
            Self::Albedo => "albedo",
            Self::Shadow => "shadow",
            Self::Id => "id",
            Self::Samples => "samples",
            Self::Variance => "variance",
        }
    }

    /// The last part of its channels' names, as compositors expect them.
    #[must_use]
    pub fn channels(self) -> &'static [&'static str] {
        match self {
            Self::Depth => &["Z"],
            Self::Normal => &["X", "Y", "Z"],
            Self::Albedo => &["R", "G", "B"],
            Self::Shadow | Self::Id | Self::Samples | Self::Variance => &["Y"],
        }
    }
}

/// A pass of a picture, row by row from the top left.
#[derive(Debug, Clone, PartialEq)]
pub struct Layer {
    /// Which pass.
    pub pass: Pass,
    /// Its numbers.
    pub values: Values,
}

/// The numbers of a pass.
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// One for each pixel.
    One(Vec<f32>),
    /// Three for each pixel.
    Three(Vec<Vec3>),
    /// A whole number for each pixel.
    Number(Vec<u32>),
}

impl Layer {
    /// A pass that the film itself holds: ids, samples and what is known of their variance.
    #[must_use]
    pub fn of(film: &Film, pass: Pass) -> Option<Self> {
        let values = match pass {
            Pass::Id => Values::Number(film.ids().to_vec()),
            Pass::Samples => Values::One(film.sums().iter().map(|sum| sum[3]).collect()),
            Pass::Variance => Values::One((0..film.pixels()).map(|p| film.variance(p)).collect::<Option<_>>()?),
            _ => return None,
        };
        Some(Self { pass, values })
    }

    /// The pass as a picture: near is bright, normals are bluish, numbers are colors.
    #[must_use]
    pub fn picture(&self, width: u32, height: u32, transfer: Transfer) -> RgbImage {
        let plain = |v: Vec3| Rgb(v.to_array().map(|part| Transfer::None.encode(part)));
        let most = match &self.values {
            Values::One(values) => values.iter().copied().filter(|v| v.is_finite()).fold(0.0, f32::max),
            _ => 0.0,
        };
        let nearest = match &self.values {
            Values::One(values) => values.iter().copied().fold(f32::INFINITY, f32::min),
            _ => 0.0,
        };
        RgbImage::from_fn(width, height, |x, y| {
            let i = (y * width + x) as usize;
            match &self.values {
                Values::One(values) => plain(Vec3::splat(match self.pass {
                    Pass::Depth => nearest / values[i],
                    Pass::Samples => values[i] / most,
                    // As a deviation, which the eye can read.
                    Pass::Variance => (values[i] / most.max(f32::MIN_POSITIVE)).sqrt(),
                    _ => values[i],
                })),
                Values::Three(values) if self.pass == Pass::Normal => {
                    plain(if values[i] == Vec3::ZERO { Vec3::ZERO } else { values[i] * 0.5 + 0.5 })
                }
                Values::Three(values) => Rgb(values[i].to_array().map(|part| transfer.encode(part))),
                Values::Number(numbers) if numbers[i] == crate::tables::NONE => Rgb([0; 3]),
                // Another color for every number: Fibonacci hashing (Knuth, TAOCP 6.4).
                Values::Number(numbers) => {
                    let [_, blue, green, red] = numbers[i].wrapping_mul(2_654_435_769).to_le_bytes();
                    Rgb([red, green, blue].map(|part| 64 | part >> 1))
                }
            }
        })
    }
}
