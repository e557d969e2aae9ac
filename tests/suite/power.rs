//! What a color hangs on and no processor has an instruction for: the same numbers on the adapter and in Rust.

use twinlight::gpu::wgsl::Sources;
use twinlight::math::angle::turns;
use twinlight::math::power::power;

use super::Dice;
use super::quotient::on_the_gpu;

/// Cosines of every size, and the exponents of materials.
fn powers() -> Vec<[f32; 2]> {
    let mut dice = Dice(1, 19);
    let mut cosine = || f32::from_bits(dice.bits() % (1.0_f32.to_bits() + 1));
    let exponents = [0.0, 0.25, 1.0, 2.0, 10.0, 32.0, 64.5, 255.0, 10_000.0];
    let mut all: Vec<_> = (0..1 << 20).map(|i| [cosine(), exponents[i % exponents.len()]]).collect();
    let mut dice = Dice(1, 20);
    all.extend(
        (0..1 << 20).map(|i| [1.0 - dice.below(1 << 24) as f32 / 16_777_216.0, exponents[i % exponents.len()]]),
    );
    all.extend([[0.0, 0.0], [1.0, 255.0], [2.0, 3.0], [1e30, 2.0]]);
    all
}

/// Sides of every size and sign.
fn sides() -> Vec<[f32; 2]> {
    let mut dice = Dice(1, 23);
    let mut side = || (dice.below(1 << 24) as f32 / 8_388_608.0 - 1.0) * [1.0, 1e-3, 1e3][dice.below(3)];
    let mut all: Vec<_> = (0..1 << 20).map(|_| [side(), side()]).collect();
    all.extend([[0.0, 0.0], [-1.0, 0.0], [0.0, -1.0], [1.0, 1.0]]);
    all
}

/// How many answers of `file`, with `this` in it written as `that`, are not Rust's.
fn others(file: &str, pairs: &[[f32; 2]], right: fn(f32, f32) -> f32, this: &str, that: &str) -> usize {
    let name = file.rsplit('/').next().unwrap_or(file);
    let function = if name == "angle" { "turns" } else { name };
    let text = Sources::default().get(file).expect("the file").into_owned();
    assert!(text.contains(this), "{file} has no {this}");
    let found = on_the_gpu(name, function, "f32", text.replace(this, that), pairs);
    pairs.iter().zip(found).filter(|([a, b], found)| right(*a, *b).to_bits() != found.to_bits()).count()
}

#[test]
fn powers_are_rusts() {
    let pairs = powers();
    assert_eq!(others("math/power", &pairs, power, "fn", "fn"), 0);
    // The next number of f32, which one pixel in a hundred thousand shows.
    assert!(others("math/power", &pairs, power, "0.57707804", "0.57707798") > 0);
}

#[test]
fn angles_are_rusts() {
    let pairs = sides();
    assert_eq!(others("math/angle", &pairs, turns, "fn", "fn"), 0);
    assert!(others("math/angle", &pairs, turns, "0.19977711", "0.19977713") > 0);
}
