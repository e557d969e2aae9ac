//! a picture's work -> its passes: what each pixel's first sample has met

use glam::Vec3;

use super::{Kind, Work};
use crate::cpu::first::first;
use crate::film::Film;
use crate::film::pass::{Layer, Pass, Values};
use crate::render::{Error, Good};
use crate::tables::{Drawing, NONE, SHOW_ALBEDO, SHOW_DEPTH, SHOW_NORMAL, SHOW_SHADOW};

impl Work {
    /// The same, if the method has these passes.
    ///
    /// # Errors
    /// [`Error::Untold`] if it has no samples to tell the variance of.
    pub fn having(self, passes: &[Pass]) -> Result<Self, Error> {
        match self.kind {
            Kind::Drawn(_) if passes.contains(&Pass::Variance) => Err(Error::Untold("the variance")),
            _ => Ok(self),
        }
    }

    /// Passes of the picture; `show` draws it with something else shown.
    pub(in crate::render) fn layers(
        &self,
        film: &Film,
        wanted: &[Pass],
        mut show: impl FnMut(&Work) -> Result<Film, Error>,
    ) -> Result<Vec<Layer>, Error> {
        let mut layers: Vec<Layer> = wanted.iter().filter_map(|&pass| Layer::of(film, pass)).collect();
        let wanted = wanted.iter().copied().filter(|pass| Layer::of(film, *pass).is_none());
        match &self.kind {
            Kind::Traced(tables, _) => {
                let wanted: Vec<_> = wanted.collect();
                if wanted.is_empty() {
                    return Ok(layers);
                }
                let first = first(tables, self.columns.clone(), self.rows.clone());
                layers.extend(wanted.into_iter().map(|pass| {
                    let values = match pass {
                        Pass::Normal => Values::Three(first.iter().map(|f| f.normal).collect()),
                        Pass::Albedo => Values::Three(first.iter().map(|f| f.albedo).collect()),
                        Pass::Shadow => Values::One(first.iter().map(|f| f.shadow).collect()),
                        _ => Values::One(first.iter().map(|f| f.depth).collect()),
                    };
                    Layer { pass, values }
                }));
            }
            Kind::Drawn(drawing) => {
                for pass in wanted {
                    if pass == Pass::Variance {
                        return Err(Error::Untold("the variance"));
                    }
                    let film = show(&self.showing(drawing, pass))?;
                    let seen = film.ids().iter().map(|id| *id != NONE);
                    let shown = film.sums().iter().map(|sum| Vec3::new(sum[0], sum[1], sum[2]) / sum[3]).zip(seen);
                    let one = |value: fn(f32) -> f32, nothing: f32| {
                        let values = shown.clone().map(|(v, seen)| if seen { value(v.x) } else { nothing });
                        Values::One(values.collect())
                    };
                    let three = |value: fn(Vec3) -> Vec3| {
                        let values = shown.clone().map(|(v, seen)| if seen { value(v) } else { Vec3::ZERO });
                        Values::Three(values.collect())
                    };
                    let values = match pass {
                        Pass::Normal => three(|v| v * 2.0 - 1.0),
                        Pass::Albedo => three(|v| v),
                        Pass::Shadow => one(|v| v, 0.0),
                        // What is shown is one over the depth.
                        _ => one(|v| 1.0 / v, f32::INFINITY),
                    };
                    layers.push(Layer { pass, values });
                }
            }
        }
        Ok(layers)
    }

    /// The drawing of one sample that shows a pass instead of colors.
    fn showing(&self, drawing: &Drawing, pass: Pass) -> Self {
        let mut drawing = drawing.clone();
        drawing.take_one_sample();
        drawing.canvas.show = match pass {
            Pass::Normal => SHOW_NORMAL,
            Pass::Albedo => SHOW_ALBEDO,
            Pass::Shadow => SHOW_SHADOW,
            _ => SHOW_DEPTH,
        };
        (drawing.canvas.depth_times, drawing.canvas.depth_plus) = (1.0, 0.0);
        (drawing.canvas.depth_least, drawing.canvas.depth_most) = (0.0, f32::MAX);
        if pass != Pass::Shadow {
            // No light is asked, so none needs its shadows.
            (drawing.lenses, drawing.lamps) = (Vec::new(), Vec::new());
        }
        let kind = Kind::Drawn(Box::new(drawing));
        let (columns, rows) = (self.columns.clone(), self.rows.clone());
        Self { kind, columns, rows, good: Good::default(), notes: Vec::new(), ..*self }
    }
}
