// two numbers -> their quotient, rounded as it is in Rust

#if divides
// This adapter's divisions are Rust's.
fn quotient(n: f32, d: f32) -> f32 {
    return n / d;
}
#else
// The bits of a number's size, and those of the whole number that they count in units of its last place.
fn digits(bits: u32) -> u32 {
    return (bits & 8388607u) | 8388608u;
}

// WGSL lets a division be off by 2.5 units of its last place, and a decision may hang on each. So it is taken as an
// estimate, and moved for as long as n - q d, in integers, is more than half a unit: of that only the last 32 bits are
// needed, since it is small. Zero, infinity and what is next to them are left as they are.
fn quotient(n: f32, d: f32) -> f32 {
    var q = bitcast<u32>(n / d);
    let nb = bitcast<u32>(n);
    let db = bitcast<u32>(d);
    let exponents = vec3u(nb >> 23u, db >> 23u, q >> 23u) & vec3u(255u);
    if (any(exponents < vec3u(25u)) || any(exponents > vec3u(229u))) {
        return n / d;
    }
    let unit = i32(digits(db));
    for (var i = 0; i < 4; i++) {
        let shift = exponents.x + 150u - exponents.y - ((q >> 23u) & 255u);
        let rest = i32((digits(nb) << shift) - digits(q) * u32(unit));
        // Below a power of two the units are half as large.
        let least = select(-unit, -(unit >> 1u), (q & 8388607u) == 0u);
        if (2 * rest > unit) {
            q++;
        } else if (2 * rest < least) {
            q--;
        } else {
            break;
        }
    }
    return bitcast<f32>(q);
}
#end
