//! Flattened charts in, their places on a square out.

use glam::{Vec2, vec2};
use std::cmp::Reverse;
use std::collections::BTreeMap;

/// Where a chart went: perhaps a quarter turn, then a shift, in pixels.
#[derive(Clone, Copy)]
pub struct Place {
    turned: bool,
    shift: Vec2,
}

impl Place {
    pub fn apply(&self, p: Vec2) -> Vec2 {
        (if self.turned { vec2(-p.y, p.x) } else { p }) + self.shift
    }
}

/// Packs by horizons (Levy et al., Least Squares Conformal Maps, 2002): the lower outline of each
/// chart is set onto the skyline where it rises least.
pub fn pack(flats: &[Vec<[Vec2; 3]>], scale: f32, size: usize, gutter: usize) -> Option<Vec<Place>> {
    let mut order: BTreeMap<(Reverse<u32>, usize), Outline> = BTreeMap::new();
    for (i, chart) in flats.iter().enumerate() {
        let straight = Outline::new(chart, scale, false);
        let turned = Outline::new(chart, scale, true);
        let best = if straight.high < turned.high { turned } else { straight };
        order.insert((Reverse(best.high as u32), i), best);
    }
    let mut sky = vec![0i32; size];
    let mut places = vec![Place { turned: false, shift: Vec2::ZERO }; flats.len()];
    let gap = gutter as i32;
    for ((_, i), o) in &order {
        let wide = o.lower.len();
        if wide + gutter * 2 > size {
            return None;
        }
        let mut best = (i64::MAX, 0, 0);
        for x in gutter / 2..size - wide - gutter / 2 {
            // The skyline must clear the chart's underside by a gutter, sideways too.
            let base = (0..wide).map(|k| sky[x + k] + gap - o.lower[k]).max().unwrap_or(0);
            let base = base.max(gap / 2);
            let top = (base + o.high) as i64;
            let waste: i64 = (0..wide).map(|k| i64::from(base + o.lower[k] - sky[x + k])).sum();
            if top + (gap as i64) < size as i64 {
                let cost = top * 3 + waste / wide as i64 * 4;
                if cost < best.0 {
                    best = (cost, x, base);
                }
            }
        }
        let (cost, x, base) = best;
        if cost == i64::MAX {
            return None;
        }
        for k in 0..wide {
            let from = (x + k).saturating_sub(gutter);
            for s in &mut sky[from..(x + k + gutter + 1).min(size)] {
                *s = (*s).max(base + o.upper[k]);
            }
        }
        places[*i] = Place { turned: o.turned, shift: vec2(x as f32, base as f32) - o.low };
    }
    Some(places)
}

/// A chart's under- and upper side, pixel column by pixel column.
struct Outline {
    turned: bool,
    low: Vec2,
    high: i32,
    lower: Vec<i32>,
    upper: Vec<i32>,
}

impl Outline {
    fn new(chart: &[[Vec2; 3]], scale: f32, turned: bool) -> Outline {
        let spin = Place { turned, shift: Vec2::ZERO };
        let all = || chart.iter().map(|t| t.map(|p| spin.apply(p * scale)));
        let low = all().flatten().fold(Vec2::INFINITY, Vec2::min).floor();
        let high = (all().flatten().fold(Vec2::NEG_INFINITY, Vec2::max) - low).ceil().as_ivec2() + 1;
        let mut out = Outline {
            turned,
            low,
            high: high.y,
            lower: vec![high.y; high.x as usize],
            upper: vec![0; high.x as usize],
        };
        for t in all() {
            for k in 0..3 {
                let (a, b) = (t[k] - low, t[(k + 1) % 3] - low);
                let steps = (b - a).abs().max_element().ceil().max(1.0) as i32 * 2;
                for s in 0..=steps {
                    let p = a.lerp(b, s as f32 / steps as f32);
                    let x = p.x as usize;
                    out.lower[x] = out.lower[x].min(p.y.floor() as i32);
                    out.upper[x] = out.upper[x].max(p.y.ceil() as i32);
                }
            }
        }
        out
    }
}
