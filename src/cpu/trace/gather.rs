//! finished ray trees -> sums on the film

use crate::math::vector::luminance;
use crate::tables::{DONE, IDLE, Path, Slice};

/// Adds a finished tree to its pixel; returns 1 if that was the pixel's last sample.
///
/// `sum`: red, green, blue and the number of samples in the sum; `square`: of the samples' luminances, with which the
/// sum tells how far the samples lie apart.
pub fn gather(slice: &Slice, path: &mut Path, sum: &mut [f32; 4], square: &mut f32, id: &mut u32) -> u32 {
    if path.state != DONE {
        return 0;
    }
    let one = [path.radiance.x, path.radiance.y, path.radiance.z, 1.0];
    for (sum, one) in sum.iter_mut().zip(one) {
        *sum += one;
    }
    let light = luminance(path.radiance);
    *square += light * light;
    if path.sample == 0 {
        *id = path.seen;
    }
    path.sample += 1;
    path.state = IDLE;
    u32::from(path.sample == slice.samples)
}
