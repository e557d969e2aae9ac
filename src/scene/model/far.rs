//! positions -> what is to be said where they are so far from zero that f32 hardly tells them apart

use glam::Vec3;

/// How many times its own size a model may be away from zero: then a thousandth of it is a step.
const FAR_AWAY: f32 = 8192.0;

/// A sentence, where it is needed.
pub(super) fn told_apart(positions: &[Vec3]) -> Option<String> {
    let none = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    let (low, high) = positions.iter().fold(none, |(low, high), p| (low.min(*p), high.max(*p)));
    let (far, size) = (low.abs().max(high.abs()).max_element(), (high - low).max_element());
    (size > 0.0 && far > size * FAR_AWAY).then(|| {
        let step = far * f32::EPSILON;
        format!(
            "a model {size:.3} across lies at coordinates up to {far:.0}, where points are told apart in steps of \
             {step:.3} or so; move it nearer to 0 0 0"
        )
    })
}
