//! Divisions that are right however wrong the adapter's are.

use twinlight::gpu::wgsl::Sources;
use twinlight::gpu::{Binding, Kernel};
use twinlight::math::quotient::quotient;
use twinlight::math::whole::whole;

use super::{Dice, gpu};

const KERNEL: &str = r#"#import "math/NAME.wgsl"
@group(0) @binding(0) var<storage, read> pairs: array<vec2<KIND>>;
@group(0) @binding(1) var<storage, read_write> quotients: array<KIND>;

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    let i = (group.y * groups.x + group.x) * 64 + lane;
    if (i < arrayLength(&pairs)) {
        quotients[i] = FUNCTION(pairs[i].x, pairs[i].y);
    }
}
"#;

/// What a function of `math/NAME.wgsl`, which reads `file`, says of each pair.
pub(super) fn on_the_gpu<T: bytemuck::Pod>(
    name: &str,
    function: &str,
    kind: &str,
    file: String,
    pairs: &[[T; 2]],
) -> Vec<T> {
    let kernel = KERNEL.replace("NAME", name).replace("FUNCTION", function).replace("KIND", kind);
    let sources = Sources::default().with(&format!("math/{name}"), file).with("kernel", kernel);
    let gpu = gpu();
    let kernel = Kernel::new(&gpu, &sources, "kernel").unwrap_or_else(|e| panic!("{e}"));
    let quotients = gpu.zeroed::<T>("quotients", pairs.len()).expect("room");
    let numbers = gpu.upload("pairs", pairs).expect("room");
    let bindings = [Binding::new("pairs", &numbers), Binding::new("quotients", &quotients)];
    let mut encoder = gpu.device().create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    kernel.dispatch(&gpu, &mut encoder, &bindings, pairs.len() as u32).expect("it runs");
    gpu.queue().submit([encoder.finish()]);
    gpu.read(&quotients).expect("quotients")
}

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
    let pairs = pairs();
    let found = on_the_gpu("quotient", "quotient", "f32", file, &pairs);
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

/// Pairs just below, at and just above where the answer grows by one; the last answer is 2^22 - 1.
fn whole_pairs() -> Vec<[u32; 2]> {
    let mut dice = Dice(1, 17);
    let mut all = vec![[0, 1], [(1 << 22) - 1, 1], [u32::MAX, 1 << 10], [u32::MAX, (1 << 31) - 1]];
    while all.len() < 1 << 20 {
        let d = 1 + (dice.bits() >> (1 + dice.below(31)));
        let most = (u32::MAX / d).min((1 << 22) - 1);
        let times = dice.bits() % most.max(1);
        all.extend([0, 1, d - 1].map(|rest| [times * d + rest.min(d - 1), d]));
    }
    all
}

/// How many whole quotients are not Rust's if `this` in their file is `that`.
fn wrong_wholes(this: &str, that: &str) -> usize {
    let file = Sources::default().get("math/whole").expect("the file").into_owned();
    assert!(file.contains(this));
    let pairs = whole_pairs();
    let found = on_the_gpu("whole", "whole", "u32", file.replace(this, that), &pairs);
    pairs.iter().zip(&found).filter(|([n, d], found)| whole(*n, *d) != **found).count()
}

#[test]
fn whole_quotients_are_rusts() {
    assert_eq!(wrong_wholes("estimate", "estimate"), 0);
}

#[test]
fn a_whole_quotient_that_is_not_mended_is_seen() {
    assert!(wrong_wholes("select(0u, 1u, rest >= i32(d))", "0u") > 1000);
    assert!(wrong_wholes("0xffffffffu, rest < 0", "0u, rest < 0") > 1000);
}
