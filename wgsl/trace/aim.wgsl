// a ray -> what of a walk hangs on the ray alone

struct Ray {
    origin: vec3f,
    direction: vec3f,
    // The leaf that the ray leaves, or NONE.
    leaves: u32,
}

struct Aim {
    // Which of the axes the ray runs along most; with `shear`, a frame in which it runs along the third from zero.
    axis: u32,
    shear: vec3f,
    // One over the direction, no part of which counts as zero.
    inverse: vec3f,
    // How far the distances to the sides of a primitive's own box, and of a node's boxes, may be off.
    own: vec3f,
    slack: vec3f,
    // The places of children are asked from the highest `place ^ octant` down.
    octant: u32,
    // What the child in each place may have: three bits for its primitives; and from bit 24 up, at `place ^ octant`, one
    // for itself.
    may_have: array<vec4u, 2>,
}

// The axes in turn, so that the third is number `axis`; cyclic, so that no handedness changes.
fn turned(v: vec3f, axis: u32) -> vec3f {
    if (axis == 0u) {
        return v.yzx;
    }
    if (axis == 1u) {
        return v.zxy;
    }
    return v;
}

// No part closer to zero than this.
fn apart(x: f32, least: f32) -> f32 {
    return select(select(least, -least, x < 0.0), x, abs(x) >= least);
}

// With u = 2^-24 and `reach` the longest way from the ray's origin to a corner of the tree: the corners of a
// triangle, seen from the ray, are off by 5 u reach at most; the sides of a box that is decoded from bytes, seen
// from the ray, by 9 u reach. So a ray that meets a triangle meets its box, grown by 16 u reach on each side, and
// one that meets this meets the boxes of all nodes above, grown by 64 u reach. After Woop, Benthin and Wald 2013, 4.
fn aim_of(ray: Ray, low: vec3f, high: vec3f) -> Aim {
    let size = abs(ray.direction);
    var axis = 2u;
    if (size.x > size.y && size.x > size.z) {
        axis = 0u;
    } else if (size.y > size.z) {
        axis = 1u;
    }
    let d = turned(ray.direction, axis);
    let shear = vec3f(d.x / d.z, d.y / d.z, 1.0 / d.z);
    let least = abs(d.z) * 9.313226e-10;
    let inverse = vec3f(
        1.0 / apart(ray.direction.x, least),
        1.0 / apart(ray.direction.y, least),
        1.0 / apart(ray.direction.z, least),
    );
    let away = max(abs(low - ray.origin), abs(high - ray.origin));
    let reach = max(away.x, max(away.y, away.z));
    let per_side = abs(inverse) * reach;
    let octant = select(4u, 0u, ray.direction.x < 0.0) | select(2u, 0u, ray.direction.y < 0.0)
        | select(1u, 0u, ray.direction.z < 0.0);
    let own_bits = array(vec4u(0u, 1u, 2u, 3u) ^ vec4u(octant), vec4u(4u, 5u, 6u, 7u) ^ vec4u(octant));
    let may_have = array(
        vec4u(0x7u, 0x38u, 0x1c0u, 0xe00u) | (vec4u(0x1000000u) << own_bits[0]),
        vec4u(0x7000u, 0x38000u, 0x1c0000u, 0xe00000u) | (vec4u(0x1000000u) << own_bits[1]),
    );
    return Aim(axis, shear, inverse, per_side * 9.536743e-7, per_side * 3.8146973e-6, octant, may_have);
}
