//! two sides of a right angle -> how far round a circle their end lies

const EIGHTH: f32 = 0.785_398_2;
const PER_TURN: f32 = 0.159_154_94;

/// In turns from 0 to 1, from +x by way of +y, to about 1e-7; 0 in the middle. The arctangent is that of Moshier's
/// Cephes: `atanf`.
#[must_use]
pub fn turns(x: f32, y: f32) -> f32 {
    let small = x.abs().min(y.abs());
    let large = x.abs().max(y.abs());
    if large == 0.0 {
        return 0.0;
    }
    // Above tan(pi / 8), what is left to an eighth of a turn.
    let steep = small > large * 0.414_213_57;
    let q = if steep { (small - large) / (small + large) } else { small / large };
    let z = q * q;
    let series = ((0.080_537_446 * z - 0.138_776_86) * z + 0.199_777_11) * z - 0.333_329_5;
    let angle = if steep { EIGHTH } else { 0.0 } + (series * z * q + q);
    let mut turns = angle * PER_TURN;
    if y.abs() > x.abs() {
        turns = 0.25 - turns;
    }
    if x < 0.0 {
        turns = 0.5 - turns;
    }
    if y < 0.0 {
        turns = 1.0 - turns;
    }
    turns
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_follow_f64() {
        for i in 0..4096 {
            let exact = f64::from(i) / 4096.0;
            let (sin, cos) = (exact * std::f64::consts::TAU).sin_cos();
            let got = f64::from(turns((cos * 7.0) as f32, (sin * 7.0) as f32));
            // The first and the last turn are one.
            let error = (got - exact).abs();
            assert!(error.min(1.0 - error) < 1.5e-7, "{got} for {exact}");
        }
        assert_eq!((turns(0.0, 0.0), turns(-1.0, 0.0), turns(0.0, 1.0)), (0.0, 0.5, 0.25));
    }
}
