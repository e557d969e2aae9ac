// x, k -> x^k, from + - * / and bit operations alone, so that every adapter and Rust give the same bits

const LOG2_RANGE: f32 = 1.41421354;

fn log2_exact(x: f32) -> f32 {
    let bits = bitcast<u32>(x);
    var exponent = i32(bits >> 23u) - 127;
    var mantissa = bitcast<f32>((bits & 0x007fffffu) | 0x3f800000u);
    if (mantissa > LOG2_RANGE) {
        mantissa = mantissa * 0.5;
        exponent = exponent + 1;
    }
    let s = (mantissa - 1.0) / (mantissa + 1.0);
    let q = s * s;
    let series = 2.88539 + q * (0.9617967 + q * (0.57707804 + q * 0.41219857));
    return f32(exponent) + s * series;
}

fn exp2_exact(y: f32) -> f32 {
    if (y < -126.0) {
        return 0.0;
    }
    let top = min(y, 127.0);
    // Above zero, so that cutting off the fraction rounds `top` to the nearest whole number, plus 127.
    let biased = i32(top + 127.5);
    let f = top - f32(biased - 127);
    let series = 1.0 + f * (0.69314718 + f * (0.24022651 + f * (0.05550411
        + f * (0.00961813 + f * (0.00133336 + f * 0.00015404)))));
    return series * bitcast<f32>(u32(biased) << 23u);
}

fn power(x: f32, k: f32) -> f32 {
    if (k == 0.0) {
        return 1.0;
    }
    if (x <= 0.0) {
        return 0.0;
    }
    return exp2_exact(k * log2_exact(x));
}
