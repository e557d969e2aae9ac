//! a count -> its color on a scale of heat

use glam::Vec3;

/// None, 1, 2 and 3, and so on: each begins at twice the number of the one before, and the last has no end.
pub const HEATS: [[f32; 3]; 12] = [
    [0.0, 0.0, 0.0],
    [0.01, 0.01, 0.06],
    [0.02, 0.03, 0.2],
    [0.03, 0.1, 0.5],
    [0.02, 0.3, 0.6],
    [0.02, 0.45, 0.3],
    [0.15, 0.6, 0.05],
    [0.6, 0.7, 0.02],
    [0.9, 0.45, 0.02],
    [0.9, 0.15, 0.02],
    [0.7, 0.02, 0.15],
    [1.0, 0.75, 0.9],
];

/// The color of a count, linear.
#[must_use]
pub fn heat_of(count: u32) -> Vec3 {
    Vec3::from_array(HEATS[(32 - count.leading_zeros()).min(11) as usize])
}
