//! positions -> what is to be said where they are so far from zero, so near to it or so far apart that f32 hardly tells

use std::ops::RangeInclusive;

use glam::Vec3;

/// How many times its own size a model may be away from zero: then a thousandth of it is a step.
const FAR_AWAY: f32 = 8192.0;

/// How large a model may be: the products of three of its edges are still numbers of full precision.
const SIZES: RangeInclusive<f32> = 1e-12..=1e12;

/// A sentence, where it is needed.
pub(super) fn told_apart(positions: &[Vec3]) -> Option<String> {
    let none = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    let (low, high) = positions.iter().fold(none, |(low, high), p| (low.min(*p), high.max(*p)));
    let (far, size) = (low.abs().max(high.abs()).max_element(), (high - low).max_element());
    if size > 0.0 && !SIZES.contains(&size) {
        return Some(format!("a model {size:e} across is drawn with errors that show; scale it to 1e-12 to 1e12"));
    }
    (size > 0.0 && far > size * FAR_AWAY).then(|| {
        let step = far * f32::EPSILON;
        format!(
            "a model {size:.3} across lies at coordinates up to {far:.0}, where points are told apart in steps of \
             {step:.3} or so; move it nearer to 0 0 0"
        )
    })
}
