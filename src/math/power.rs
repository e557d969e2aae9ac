//! x, k -> x^k, from + - * / and bit operations alone, so that every adapter and Rust give the same bits

const LOG2_RANGE: f32 = 1.414_213_5;

/// 2 / (n ln 2) for n = 1, 3, 5, 7: of the logarithm to base 2, also where it is taken in lanes.
pub const LOG2_SERIES: [f32; 4] = [2.885_39, 0.961_796_7, 0.577_078_04, 0.412_198_57];

/// The base-2 logarithm of a positive, normal `x`, to about 2e-7.
///
/// The series of atanh at `(m - 1) / (m + 1)`, m the mantissa in [0.707, 1.414].
#[must_use]
pub fn log2_exact(x: f32) -> f32 {
    let bits = x.to_bits();
    let mut exponent = (bits >> 23) as i32 - 127;
    let mut mantissa = f32::from_bits((bits & 0x007f_ffff) | 0x3f80_0000);
    if mantissa > LOG2_RANGE {
        mantissa *= 0.5;
        exponent += 1;
    }
    let s = (mantissa - 1.0) / (mantissa + 1.0);
    let q = s * s;
    let [a, b, c, d] = LOG2_SERIES;
    let series = a + q * (b + q * (c + q * d));
    exponent as f32 + s * series
}

/// 2^y, to a few ulps; 0 below the normal numbers. The Taylor series about the nearest whole number.
#[must_use]
pub fn exp2_exact(y: f32) -> f32 {
    if y < -126.0 {
        return 0.0;
    }
    let top = y.min(127.0);
    // Above zero, so that cutting off the fraction rounds `top` to the nearest whole number, plus 127.
    let biased = (top + 127.5) as i32;
    let f = top - (biased - 127) as f32;
    let series = 1.0
        + f * (0.693_147_2
            + f * (0.240_226_51 + f * (0.055_504_11 + f * (0.009_618_13 + f * (0.001_333_36 + f * 0.000_154_04)))));
    series * f32::from_bits((biased as u32) << 23)
}

/// x^k for `x >= 0`; 0^0 is 1.
#[must_use]
pub fn power(x: f32, k: f32) -> f32 {
    if k == 0.0 {
        return 1.0;
    }
    if x <= 0.0 {
        return 0.0;
    }
    exp2_exact(k * log2_exact(x))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn power_follows_f64() {
        for i in 1..=4000 {
            let x = i as f32 / 4000.0;
            for k in [0.25_f32, 1.0, 2.0, 10.0, 64.0, 255.0] {
                let exact = f64::from(x).powf(f64::from(k));
                let error = (f64::from(power(x, k)) - exact).abs();
                assert!(error <= 1e-6 + exact * 3e-7 * f64::from(k), "{x}^{k}: {} for {exact}", power(x, k));
            }
        }
        assert_eq!((power(0.0, 10.0), power(0.0, 0.0), power(1.0, 255.0)), (0.0, 1.0, 1.0));
    }
}
