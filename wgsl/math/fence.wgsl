// numbers -> the same numbers, through which no compiler sees

// WGSL lets compilers reorder sums, and lavapipe turns `a + b - c` round: 1e-5 where it cancels. What is
// exclusive-ored with a zero that only the buffer knows of stays as it was written.
fn fence(v: vec3f, zero: u32) -> vec3f {
    return bitcast<vec3f>(bitcast<vec3u>(v) ^ vec3u(zero));
}
