// two whole numbers -> how often the one holds the other

// lavapipe divides integers lane by lane. An estimate in floats is off by one at most while the answer is below 2^22,
// and d below 2^31.
fn whole(n: u32, d: u32) -> u32 {
    let estimate = u32(f32(n) / f32(d));
    let rest = i32(n - estimate * d);
    return estimate + select(select(0u, 1u, rest >= i32(d)), 0xffffffffu, rest < 0);
}
