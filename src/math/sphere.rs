//! two uniform numbers -> a uniform direction

use glam::Vec3;

const QUARTER: f32 = 1.570_796_4;

/// (cos, sin) of a whole turn times `turns`, for turns in [0, 1), to about 4e-7.
#[must_use]
pub fn cos_sin_turns(turns: f32) -> [f32; 2] {
    let quarters = turns * 4.0;
    let whole = (quarters + 0.5).floor();
    let a = (quarters - whole) * QUARTER;
    let q = a * a;
    let s = a * (1.0 + q * (-0.166_666_67 + q * (0.008_333_333 + q * -0.000_198_412_7)));
    let c = 1.0 + q * (-0.5 + q * (0.041_666_668 + q * (-0.001_388_888_9 + q * 0.000_024_801_588)));
    match whole as u32 & 3 {
        0 => [c, s],
        1 => [-s, c],
        2 => [-c, -s],
        _ => [s, -c],
    }
}

/// A direction of length one, uniform on the sphere for `a` and `b` uniform in [0, 1).
///
/// Archimedes: height on a sphere is uniform, and so is the angle about the axis.
#[must_use]
pub fn on_sphere(a: f32, b: f32) -> Vec3 {
    let z = 1.0 - 2.0 * a;
    let radius = (1.0 - z * z).max(0.0).sqrt();
    let [cos, sin] = cos_sin_turns(b);
    Vec3::new(radius * cos, radius * sin, z)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_follow_f64() {
        for i in 0..4096 {
            let turns = i as f32 / 4096.0;
            let (sin, cos) = (f64::from(turns) * std::f64::consts::TAU).sin_cos();
            let [c, s] = cos_sin_turns(turns);
            assert!((f64::from(c) - cos).abs() < 5e-7 && (f64::from(s) - sin).abs() < 5e-7, "at {turns}");
        }
    }
}
