//! rows -> bands of them: a picture that is too large for one film comes one band after the other

use std::ops::Range;

use super::Film;

/// Some rows of a picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Band {
    /// Its first row, counted from the picture's.
    pub top: u32,
    /// Its rows.
    pub film: Film,
}

/// Rows from the top, `height` at a time; the last band is what is left.
pub fn split(rows: &Range<u32>, height: u32) -> impl Iterator<Item = Range<u32>> + use<> {
    let end = rows.end;
    rows.clone().step_by(height.max(1) as usize).map(move |top| top..end.min(top.saturating_add(height.max(1))))
}
