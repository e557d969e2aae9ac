//! an explanation -> words: what it is, the figures, and where the spec explains them

mod drawn;
mod traced;

use std::fmt::{self, Display, Formatter, Write as _};

use glam::Vec3;

use super::place::place;
use super::{Explanation, Maps, Places, Samples, Thing};

impl Display for Explanation {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let ([x, y], [width, height]) = (self.pixel, self.size);
        let mut page = Page { out: f, places: self.spec, depth: 0 };
        let how = match &self.samples {
            Samples::Raster(_) => "drawn (spec part 1)",
            Samples::Trace(_) => "traced (spec part 2)",
        };
        page.say(&format!("pixel {x},{y} of {width}x{height}, {how}"))?;
        let count = match &self.samples {
            Samples::Raster(samples) => {
                let mut all = samples.iter().zip(1..);
                all.try_for_each(|(sample, i)| drawn::sample(&mut page, sample, i, samples.len()))?;
                samples.len()
            }
            Samples::Trace(samples) => {
                let mut all = samples.iter().zip(1..);
                all.try_for_each(|(sample, i)| traced::sample(&mut page, sample, i, samples.len()))?;
                samples.len()
            }
        };
        page.say("")?;
        if count > 1 {
            page.say(&format!("the mean of the {count} samples' colors:"))?;
        }
        // These are read back by scripts: as many digits as it takes to mean the very same numbers.
        let [red, green, blue] = self.linear.to_array();
        let [r, g, b] = self.rgb8;
        writeln!(f, "linear {red} {green} {blue} -> 8 bits {r} {g} {b}")
    }
}

/// Where words go, line by line: a label, what there is to say, and the spec's place at the right.
struct Page<'a, 'b> {
    out: &'a mut Formatter<'b>,
    places: Places,
    depth: usize,
}

/// Columns of a label and of the figures.
const LABEL: usize = 30;
const FIGURES: usize = 52;

impl Page<'_, '_> {
    /// Words alone.
    fn say(&mut self, words: &str) -> fmt::Result {
        let indent = if words.is_empty() { 0 } else { self.depth * 2 };
        writeln!(self.out, "{:indent$}{words}", "")
    }

    /// Figures; `field` is what the spec's place is found by.
    fn row(&mut self, label: &str, figures: &str, field: &str) -> fmt::Result {
        let indent = self.depth * 2;
        let (width, place) = (LABEL - indent, place(self.places, field));
        let line = format!("{:indent$}{label:<width$}{figures:<FIGURES$}  {place}", "");
        writeln!(self.out, "{}", line.trim_end())
    }
}

/// Six digits that count.
fn number(x: f64) -> String {
    if x == 0.0 || !x.is_finite() || x.abs() >= 1e7 || x.abs() < 1e-5 {
        return if x == 0.0 { "0".to_owned() } else { format!("{x:.5e}") };
    }
    let whole = x.abs().log10().floor() as i32;
    format!("{x:.*}", (5 - whole).clamp(0, 6) as usize)
}

/// Numbers side by side.
fn numbers(all: &[f64]) -> String {
    all.iter().fold(String::new(), |mut line, x| {
        let _ = write!(line, "{:>12}", number(*x));
        line
    })
}

fn vector(v: Vec3) -> String {
    numbers(&v.to_array().map(f64::from))
}

fn thing(thing: &Thing) -> String {
    let triangle = thing.triangle.map_or_else(String::new, |number| format!(", triangle {number}"));
    let group = thing.group.as_ref().map_or_else(String::new, |name| format!(" of group {name:?}"));
    format!("{}{triangle}{group}, material {:?} (id {})", thing.object, thing.material, thing.id)
}

fn maps(page: &mut Page<'_, '_>, maps: &Maps, tangents: Option<[Vec3; 2]>) -> fmt::Result {
    let normal = maps.normal.map(|map| map * 2.0 - 1.0);
    for (map, name) in [(maps.diffuse, "diffuse map"), (maps.specular, "specular map"), (normal, "normal map")] {
        if let Some(value) = map {
            page.row(name, &vector(value), "maps")?;
        }
    }
    if let Some(share) = maps.exponent {
        page.row("exponent map", &numbers(&[f64::from(share)]), "maps")?;
    }
    for (tangent, name) in tangents.into_iter().flatten().zip(["T", "B"]) {
        page.row(name, &vector(tangent), "tangents")?;
    }
    Ok(())
}
