// a ray and a triangle -> the distance to where they meet, in lengths of the direction, or FAR
#import "tables/leaf.wgsl"
#import "trace/aim.wgsl"
#import "trace/meet.wgsl"

// Edge functions that neighbors share to the bit, so that no ray slips between them: Woop, Benthin and Wald,
// "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013. Of corners seen from the ray, in the frame of its aim.
fn edges(a: vec3f, b: vec3f, c: vec3f, aim: Aim) -> vec3f {
    let ax = a.x - aim.shear.x * a.z;
    let ay = a.y - aim.shear.y * a.z;
    let bx = b.x - aim.shear.x * b.z;
    let by = b.y - aim.shear.y * b.z;
    let cx = c.x - aim.shear.x * c.z;
    let cy = c.y - aim.shear.y * c.z;
    return vec3f(cx * by - cy * bx, ax * cy - ay * cx, bx * ay - by * ax);
}

// As processors have them; lavapipe's `min` and `max` ask of both whether they are numbers, and take three steps for one.
fn lesser(a: f32, b: f32) -> f32 {
    return select(b, a, a < b);
}

fn larger(a: f32, b: f32) -> f32 {
    return select(b, a, a > b);
}

fn lower(a: vec3f, b: vec3f) -> vec3f {
    return select(b, a, a < b);
}

fn upper(a: vec3f, b: vec3f) -> vec3f {
    return select(b, a, a > b);
}

fn least(v: vec3f) -> f32 {
    return lesser(v.x, lesser(v.y, v.z));
}

fn most(v: vec3f) -> f32 {
    return larger(v.x, larger(v.y, v.z));
}

// The spec's inside test (2.3).
fn meet_triangle(ray: Ray, triangle: Leaf, aim: Aim) -> f32 {
    let from_a = triangle.a - ray.origin;
    let from_b = triangle.b - ray.origin;
    let from_c = triangle.c - ray.origin;
    let a = turned(from_a, aim.axis);
    let b = turned(from_b, aim.axis);
    let c = turned(from_c, aim.axis);
    let e = edges(a, b, c, aim);
    // The same either way round, but for its sign.
    let area = e.x + (e.y + e.z);
    let outside = (least(e) < 0.0 && most(e) > 0.0) || area == 0.0;
    let scaled = e.x * a.z + (e.y * b.z + e.z * c.z);
    // Seen from its edge or from very far, a triangle of f32 is met where it is not: never outside of its box,
    // so that no node hides what a test would find.
    let low = lower(from_a, lower(from_b, from_c));
    let high = upper(from_a, upper(from_b, from_c));
    let back = aim.inverse < vec3f(0.0);
    let near = select(low, high, back) * aim.inverse - aim.own;
    let far = select(high, low, back) * aim.inverse + aim.own;
    let enter = most(near);
    let leave = least(far);
    let t = ahead(larger(enter, lesser(leave, scaled * aim.shear.z / area)));
    // By choice: a software adapter goes both ways of every branch.
    return select(t, FAR, outside || enter > leave);
}
