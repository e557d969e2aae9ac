//! Integers or points in, repeatable randomness out.

use glam::{IVec3, Vec3};

/// PCG-RXS-M-XS of a 32-bit counter (Jarzynski and Olano, Hash Functions for GPU Rendering, 2020).
pub fn hash(x: u32) -> u32 {
    let s = x.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let w = ((s >> ((s >> 28) + 4)) ^ s).wrapping_mul(277_803_737);
    (w >> 22) ^ w
}

fn unit(x: u32) -> f32 {
    (hash(x) >> 8) as f32 / 16_777_216.0
}

/// A stream of random numbers with a seed.
pub struct Dice(pub u32);

impl Dice {
    pub fn roll(&mut self, low: f32, high: f32) -> f32 {
        self.0 = self.0.wrapping_add(1);
        low + (high - low) * unit(self.0)
    }

    /// -1 with the given chance, else 1.
    pub fn sign(&mut self, chance: f32) -> f32 {
        if self.roll(0.0, 1.0) < chance { -1.0 } else { 1.0 }
    }
}

/// Smooth value noise in -1..1 with features one unit wide.
pub fn noise(p: Vec3) -> f32 {
    let f = p.floor();
    let t = p - f;
    let t = t * t * (3.0 - 2.0 * t);
    let c = f.as_ivec3();
    let at = |x: i32, y: i32, z: i32| {
        let q = c + IVec3::new(x, y, z);
        let mixed = q.as_uvec3().wrapping_mul(glam::UVec3::new(0x9e37_79b1, 0x85eb_ca77, 0xc2b2_ae3d));
        let h = hash(mixed.x ^ mixed.y.rotate_left(11) ^ mixed.z.rotate_left(22));
        (h >> 8) as f32 / 8_388_608.0 - 1.0
    };
    let lerp = |a: f32, b: f32, t: f32| a + (b - a) * t;
    let plane = |z: i32| {
        let low = lerp(at(0, 0, z), at(1, 0, z), t.x);
        lerp(low, lerp(at(0, 1, z), at(1, 1, z), t.x), t.y)
    };
    lerp(plane(0), plane(1), t.z)
}

/// Octaves of noise, each half as wide and half as high as the one before.
pub fn clouds(p: Vec3, octaves: u32) -> f32 {
    let mut sum = 0.0;
    let (mut q, mut gain) = (p, 0.5);
    for _ in 0..octaves {
        sum += gain * noise(q);
        // A shift with no common measure keeps the lattices from lining up.
        q = Vec3::new(q.y, q.z, q.x) * 2.03 + 17.13;
        gain *= 0.5;
    }
    sum
}
