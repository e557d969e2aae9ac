// a ray and a primitive -> the distance to where they meet, in lengths of the direction, or FAR

struct Ray {
    origin: vec3f,
    direction: vec3f,
    // The primitive that the ray leaves, or NONE.
    leaves: u32,
}

// The positive root nearest to the eye, or FAR.
fn ahead(t: f32) -> f32 {
    return select(FAR, t, t > 0.0);
}

// Eq. 2.1 - 2.3 (whose root should read (d.e)^2 - |d|^2 (e.e - R^2)), in the stable form of
// Haines et al., "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems, ch. 7.
fn meet_sphere(ray: Ray, sphere: Sphere, per_length_squared: f32, leaving: bool) -> f32 {
    let e = ray.origin - sphere.center;
    let b = dot(ray.direction, e);
    if (leaving) {
        // From a point of the sphere one root is zero, and only the chord's other end is left.
        return ahead(-2.0 * b * per_length_squared);
    }
    let r2 = sphere.radius * sphere.radius;
    let nearest = e - ray.direction * (b * per_length_squared);
    let spare = r2 - dot(nearest, nearest);
    if (spare < 0.0) {
        return FAR;
    }
    let half_chord = sqrt(spare / per_length_squared);
    let q = select(half_chord - b, -half_chord - b, b > 0.0);
    if (q == 0.0) {
        return FAR;
    }
    let near = (dot(e, e) - r2) / q;
    return select(ahead(q * per_length_squared), near, near > 0.0);
}

// Eq. 2.4 and 2.5.
fn meet_plane(ray: Ray, plane: Plane) -> f32 {
    let across = dot(plane.normal, ray.direction);
    if (across == 0.0) {
        return FAR;
    }
    return ahead(dot(plane.normal, plane.point - ray.origin) / across);
}

// The ray in a frame in which it runs along the third axis from zero.
struct Sheared {
    axis: u32,
    shear: vec3f,
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

fn shear_of(direction: vec3f) -> Sheared {
    let size = abs(direction);
    var axis = 2u;
    if (size.x > size.y && size.x > size.z) {
        axis = 0u;
    } else if (size.y > size.z) {
        axis = 1u;
    }
    let d = turned(direction, axis);
    return Sheared(axis, vec3f(d.x / d.z, d.y / d.z, 1.0 / d.z));
}

// The spec's inside test (2.3) on edge functions that neighbors share to the bit, so that no ray slips
// between them: Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013.
fn meet_triangle(ray: Ray, triangle: Triangle, sheared: Sheared) -> f32 {
    let a = turned(triangle.a - ray.origin, sheared.axis);
    let b = turned(triangle.b - ray.origin, sheared.axis);
    let c = turned(triangle.c - ray.origin, sheared.axis);
    let ax = a.x - sheared.shear.x * a.z;
    let ay = a.y - sheared.shear.y * a.z;
    let bx = b.x - sheared.shear.x * b.z;
    let by = b.y - sheared.shear.y * b.z;
    let cx = c.x - sheared.shear.x * c.z;
    let cy = c.y - sheared.shear.y * c.z;
    let u = cx * by - cy * bx;
    let v = ax * cy - ay * cx;
    let w = bx * ay - by * ax;
    let area = u + v + w;
    if ((min(u, min(v, w)) < 0.0 && max(u, max(v, w)) > 0.0) || area == 0.0) {
        return FAR;
    }
    let scaled = u * a.z + v * b.z + w * c.z;
    return ahead(scaled * sheared.shear.z / area);
}
