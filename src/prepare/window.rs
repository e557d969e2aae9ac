//! a film of any size -> rectangles of it that are drawn one after the other

use std::ops::Range;

use crate::tables::{Drawing, Lens, REGION, TILE};

/// The regions of a film, row by row: columns and rows of each. Most films are one.
#[must_use]
pub(super) fn regions(film: [u32; 2]) -> Vec<[Range<u32>; 2]> {
    let cuts = |side: u32| (0..side).step_by(REGION as usize).map(move |at| at..side.min(at + REGION));
    cuts(film[1]).flat_map(|rows| cuts(film[0]).map(move |columns| [columns, rows.clone()])).collect()
}

impl Lens {
    /// The columns and rows of the film that it sees.
    #[must_use]
    pub fn on_film(&self) -> [Range<u32>; 2] {
        [self.left..self.left + self.width, self.top..self.top + self.height]
    }

    /// The same lens, which sees these columns and rows alone.
    #[must_use]
    pub fn window(&self, [columns, rows]: &[Range<u32>; 2]) -> Self {
        let [width, height] = [columns, rows].map(|range| range.len() as u32);
        Self { left: columns.start, top: rows.start, width, height, columns: width.div_ceil(TILE), ..*self }
    }
}

impl Drawing {
    /// Samples of a pixel.
    #[must_use]
    pub fn samples(&self) -> usize {
        let place = |eye: &Lens| (eye.left, eye.top);
        self.eyes.iter().take_while(|eye| place(eye) == place(&self.eyes[0])).count()
    }

    /// Leaves the first sample of each pixel.
    pub fn take_one_sample(&mut self) {
        self.eyes = self.eyes.iter().copied().step_by(self.samples().max(1)).collect();
    }

    /// Width and height of the film.
    #[must_use]
    pub fn film(&self) -> [u32; 2] {
        [0, 1].map(|i| self.eyes.iter().map(|eye| eye.on_film()[i].end).max().unwrap_or(0))
    }

    /// The lenses that see the film, or a rectangle of it: for each window one for each sample of a pixel.
    #[must_use]
    pub fn windows(&self, rectangle: &[Range<u32>; 2]) -> Vec<Vec<Lens>> {
        let meet = |a: &Range<u32>, b: &Range<u32>| a.start.max(b.start)..a.end.min(b.end);
        let mut all = Vec::new();
        for eyes in self.eyes.chunks(self.samples().max(1)) {
            let region = eyes[0].on_film();
            let [columns, rows] = [0, 1].map(|i| meet(&region[i], &rectangle[i]));
            // As wide as the rectangle, not the region: of the one that is narrow, windows are high.
            let wide = self.most.clamp(1, (columns.len() as u32).max(1));
            let high = (self.most / wide).max(1);
            for top in rows.clone().step_by(high as usize) {
                for left in columns.clone().step_by(wide as usize) {
                    let [right, bottom] = [left.saturating_add(wide), top.saturating_add(high)];
                    let window = [left..right.min(columns.end), top..bottom.min(rows.end)];
                    all.push(eyes.iter().map(|eye| eye.window(&window)).collect());
                }
            }
        }
        all
    }
}
