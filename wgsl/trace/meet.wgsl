// a ray and a sphere or a plane -> the distance to where they meet, in lengths of the direction, or FAR
#import "tables/leaf.wgsl"
#import "trace/aim.wgsl"

// Nothing is met behind a ray.
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
