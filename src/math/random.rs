//! pixel, sample, dimension -> uniform numbers: a hash, so that no order of work can show

/// Four well-mixed words from four: pcg4d of Jarzynski and Olano, "Hash Functions for GPU Rendering",
/// JCGT 9(3), 2020.
#[must_use]
pub fn pcg4d(seed: [u32; 4]) -> [u32; 4] {
    let [mut x, mut y, mut z, mut w] = seed.map(|s| s.wrapping_mul(1_664_525).wrapping_add(1_013_904_223));
    let round = |x: &mut u32, y: &mut u32, z: &mut u32, w: &mut u32| {
        *x = x.wrapping_add(y.wrapping_mul(*w));
        *y = y.wrapping_add(z.wrapping_mul(*x));
        *z = z.wrapping_add(x.wrapping_mul(*y));
        *w = w.wrapping_add(y.wrapping_mul(*z));
    };
    round(&mut x, &mut y, &mut z, &mut w);
    [x, y, z, w] = [x, y, z, w].map(|v| v ^ (v >> 16));
    round(&mut x, &mut y, &mut z, &mut w);
    [x, y, z, w]
}

/// A number in [0, 1): the top 24 bits, so that the result is exact and below one.
#[must_use]
pub fn unit_float(bits: u32) -> f32 {
    (bits >> 8) as f32 * 5.960_464_5e-8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unit_floats_stay_below_one_and_fill_the_interval() {
        assert_eq!(unit_float(u32::MAX), 1.0 - f32::EPSILON / 2.0);
        let mut counts = [0_u32; 16];
        for i in 0..16_000 {
            counts[(unit_float(pcg4d([i % 97, i / 97, 0, 7])[0]) * 16.0) as usize] += 1;
        }
        // Chi-square of 15 degrees of freedom: 37.7 is exceeded once in a thousand.
        let chi: f64 = counts.iter().map(|&c| (f64::from(c) - 1000.0).powi(2) / 1000.0).sum();
        assert!(chi < 37.7, "{counts:?}");
    }
}
