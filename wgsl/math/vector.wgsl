// vectors -> vectors, each product and sum in one fixed order

fn unit(v: vec3f) -> vec3f {
    return v / sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

// `unit` of what may be so long, or so short, that its square is more or less than an `f32` holds.
fn unit_of_any(v: vec3f) -> vec3f {
    let most = largest(abs(v));
    let shrunk = select(v, v * 8.67361738e-19, most > 1.1529215e18);
    return unit(select(shrunk, shrunk * 1.1529215e18, most < 8.67361738e-19));
}

// Eq. 2.6: the mirror of `i`, which points away from the surface, about the normal `n`.
fn mirror(i: vec3f, n: vec3f) -> vec3f {
    return unit(n * (2.0 * dot(i, n)) - i);
}

// Of a linear color: Rec. 709.
fn luminance(color: vec3f) -> f32 {
    return dot(color, vec3f(0.2126, 0.7152, 0.0722));
}

fn largest(v: vec3f) -> f32 {
    return max(v.x, max(v.y, v.z));
}
