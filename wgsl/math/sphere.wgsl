// two uniform numbers -> a uniform direction

const QUARTER: f32 = 1.5707964;

// (cos, sin) of a whole turn times `turns`, for turns in [0, 1).
fn cos_sin_turns(turns: f32) -> vec2f {
    let quarters = turns * 4.0;
    let whole = floor(quarters + 0.5);
    let a = (quarters - whole) * QUARTER;
    let q = a * a;
    let s = a * (1.0 + q * (-0.16666667 + q * (0.008333333 + q * -0.0001984127)));
    let c = 1.0 + q * (-0.5 + q * (0.041666668 + q * (-0.0013888889 + q * 0.000024801588)));
    let quadrant = u32(whole) & 3u;
    if (quadrant == 0u) {
        return vec2f(c, s);
    }
    if (quadrant == 1u) {
        return vec2f(-s, c);
    }
    if (quadrant == 2u) {
        return vec2f(-c, -s);
    }
    return vec2f(s, -c);
}

// Archimedes: height on a sphere is uniform, and so is the angle about the axis.
fn on_sphere(a: f32, b: f32) -> vec3f {
    let z = 1.0 - 2.0 * a;
    let radius = sqrt(max(0.0, 1.0 - z * z));
    let turn = cos_sin_turns(b);
    return vec3f(radius * turn.x, radius * turn.y, z);
}
