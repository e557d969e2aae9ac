//! A division that is right however wrong the adapter's is.

use twinlight::gpu::wgsl::Sources;
use twinlight::gpu::{Binding, Kernel};
use twinlight::math::quotient::quotient;

use super::{Dice, gpu};

const KERNEL: &str = r#"#import "math/quotient.wgsl"
@group(0) @binding(0) var<storage, read> pairs: array<vec2f>;
@group(0) @binding(1) var<storage, read_write> quotients: array<f32>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) at: vec3u) {
    if (at.x < arrayLength(&pairs)) {
        quotients[at.x] = quotient(pairs[at.x].x, pairs[at.x].y);
    }
}
"#;

/// Numbers of every size that are often hard to round: digits near a power of two, few digits, and any.
fn pairs() -> Vec<[f32; 2]> {
    let mut dice = Dice(1, 13);
    let mut number = || {
        let digits = match dice.below(4) {
            0 => dice.below(5) as u32,
            1 => 0x007f_ffff - dice.below(5) as u32,
            2 => (dice.below(32) as u32) << 18,
            _ => dice.bits() & 0x007f_ffff,
        };
        let exponent = 127 + dice.below(81) as u32 - 40;
        let sign = (dice.below(2) as u32) << 31;
        f32::from_bits(sign | exponent << 23 | digits)
    };
    let mut all: Vec<_> = (0..1 << 20).map(|_| [number(), number()]).collect();
    all.extend([[0.0, 3.0], [-0.0, 3.0], [1e-44, 7.0], [3e38, 0.5], [1.0, 0.0], [f32::INFINITY, 2.0]]);
    all
}

/// How many quotients are not Rust's, where `estimate` stands for the adapter's division.
fn wrong(estimate: &str, other: &str) -> usize {
    let file = Sources::default().get("math/quotient").expect("the file").into_owned();
    let first = "bitcast<u32>(n / d)";
    assert!(file.contains(first));
    let file = file.replace(first, estimate).replace("i < 4", other);
    let sources = Sources::default().with("math/quotient", file).with("kernel", KERNEL.to_owned());
    let gpu = gpu();
    let pairs = pairs();
    let kernel = Kernel::new(&gpu, &sources, "kernel").unwrap_or_else(|e| panic!("{e}"));
    let quotients = gpu.zeroed::<f32>("quotients", pairs.len()).expect("room");
    let numbers = gpu.upload("pairs", &pairs).expect("room");
    let bindings = [Binding::new("pairs", &numbers), Binding::new("quotients", &quotients)];
    let mut encoder = gpu.device().create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    kernel.dispatch(&gpu, &mut encoder, &bindings, pairs.len() as u32).expect("it runs");
    gpu.queue().submit([encoder.finish()]);
    let found = gpu.read(&quotients).expect("quotients");
    let right = pairs.iter().map(|[n, d]| quotient(*n, *d).to_bits());
    found.iter().zip(right).filter(|(found, right)| found.to_bits() != *right).count()
}

#[test]
fn quotients_are_rusts_even_where_divisions_are_three_units_off() {
    assert_eq!(wrong("bitcast<u32>(n / d)", "i < 4"), 0);
    // The numbers next to nothing and infinity are left as they are, but these estimates leave their range.
    for off in ["1u", "3u", "(bitcast<u32>(n) & 3u)"] {
        for way in ["+", "-"] {
            assert_eq!(wrong(&format!("(bitcast<u32>(n / d) {way} {off})"), "i < 4"), 0, "{way} {off}");
        }
    }
}

#[test]
fn a_quotient_that_is_not_looked_at_is_seen() {
    assert!(wrong("(bitcast<u32>(n / d) + 1u)", "i < 0") > 1 << 19);
    assert!(wrong("(bitcast<u32>(n / d) + 3u)", "i < 2") > 1 << 19);
}
