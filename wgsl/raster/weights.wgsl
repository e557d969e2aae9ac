// a pixel of a face -> what each corner counts for there, in perspective (Eq. 1.1 - 1.5)
#import "tables/mesh.wgsl"
#import "raster/snap.wgsl"

// alpha, beta, gamma of Eq. 1.5 at a place of what the lens spans, in pixels; they sum to one.
//
// Seen from the pixel's line of sight, each is the area that the other two corners span: the same as Z * alpha' / Z_A,
// and true behind the eye as well.
fn weights(a: vec4f, b: vec4f, c: vec4f, at: vec2f) -> vec3f {
    let x = at.x * 2.0 / f32(lens.span_x) - 1.0;
    let y = 1.0 - at.y * 2.0 / f32(lens.span_y);
    let p = a.xy - vec2f(hold(x * a.w), hold(y * a.w));
    let q = b.xy - vec2f(hold(x * b.w), hold(y * b.w));
    let r = c.xy - vec2f(hold(x * c.w), hold(y * c.w));
    let areas = vec3f(
        hold(q.x * r.y) - hold(q.y * r.x),
        hold(r.x * p.y) - hold(r.y * p.x),
        hold(p.x * q.y) - hold(p.y * q.x),
    );
    let sum = (areas.x + areas.y) + areas.z;
    if (sum == 0.0) {
        return vec3f(1.0, 0.0, 0.0);
    }
    return areas / sum;
}

// The same, held inside the face: a covered pixel's center may lie a trifle outside before it is snapped.
fn weights_inside(a: vec4f, b: vec4f, c: vec4f, at: vec2f) -> vec3f {
    let inside = max(weights(a, b, c, at), vec3f(0.0));
    return inside / ((inside.x + inside.y) + inside.z);
}
