// world space -> clip space -> fixed point on the film (spec 1.2.3)
#import "tables/lens.wgsl"
#import "tables/piece.wgsl"
#import "raster/hold.wgsl"
#import "math/quotient.wgsl"

fn along(row: vec4f, p: vec3f) -> f32 {
    return ((hold(row.x * p.x) + hold(row.y * p.y)) + hold(row.z * p.z)) + row.w;
}

// World2Camera and Projection.
fn to_clip(p: vec3f) -> vec4f {
    return vec4f(along(lens.x, p), along(lens.y, p), along(lens.z, p), along(lens.w, p));
}

// How far a corner lies on the inner side of a plane: near, far, left, right, bottom, top.
fn height(plane: u32, c: vec4f) -> f32 {
    switch (plane) {
        case 0u: { return c.z; }
        case 1u: { return c.w - c.z; }
        case 2u: { return hold(lens.guard_x * c.w) + c.x; }
        case 3u: { return hold(lens.guard_x * c.w) - c.x; }
        case 4u: { return hold(lens.guard_y * c.w) + c.y; }
        default: { return hold(lens.guard_y * c.w) - c.y; }
    }
}

// The planes that a corner lies beyond, one bit each. Written out: a loop with a switch costs ten times as much on
// lavapipe.
fn outcode(c: vec4f) -> u32 {
    let reach = vec2f(hold(lens.guard_x * c.w), hold(lens.guard_y * c.w));
    let depth = select(vec2u(1u, 2u), vec2u(0u), vec2f(c.z, c.w - c.z) >= vec2f(0.0));
    let low = select(vec2u(4u, 16u), vec2u(0u), reach + c.xy >= vec2f(0.0));
    let high = select(vec2u(8u, 32u), vec2u(0u), reach - c.xy >= vec2f(0.0));
    let all = depth | low | high;
    return all.x | all.y;
}

// Homogeneous division and Clip2Screen, in 1/256 pixel with y down; depth as a share of DEEP.
fn snap(c: vec4f) -> vec3i {
    let half = vec2f(f32(lens.span_x * 128u), f32(lens.span_y * 128u));
    let x = half.x + hold(half.x * hold(quotient(c.x, c.w)));
    let y = half.y - hold(half.y * hold(quotient(c.y, c.w)));
    let z = clamp(hold(quotient(c.z, c.w)), 0.0, 1.0) * f32(DEEP);
    let start = vec2i(vec2u(lens.left, lens.top) % REGION) * 256;
    return vec3i(i32(floor(x + 0.5)) - start.x, i32(floor(y + 0.5)) - start.y, i32(z));
}
