// three corners in fixed point -> integer planes: coverage and depth at any pixel, exactly
#import "raster/hold.wgsl"
#import "math/quotient.wgsl"

// The plane of nearness of a triangle, as seen from a pixel near it, its origin. What is nearer is more; all numbers of
// nearness are below zero, taken for signed ones.
struct Nears {
    // Nearness at the origin is `at`; from column to column it grows by `x`, from row to row by `y`, modulo 2^32.
    x: i32,
    y: i32,
    at: i32,
    // What the corners span; no sample leaves it.
    least: i32,
    most: i32,
}

// Of a triangle whose area is above zero. A pixel (x, y) from the origin is covered where a * x + b * y + e >= 0 for
// all three edges.
struct Plan {
    a: vec3i,
    b: vec3i,
    e: vec3i,
    nears: Nears,
}

// Twice the signed area in 1/65536 pixel, in base 4096: x * 2^24 + y * 2^12 + z with y and z in 0 ... 4095.
//
// Sides are below 2^23, so the halves' products are below 2^25 and nothing overflows.
fn area(p: vec3i, q: vec3i, r: vec3i) -> vec3i {
    let u = q.xy - p.xy;
    let v = r.xy - p.xy;
    let uh = u >> vec2u(12u);
    let ul = u & vec2i(4095);
    let vh = v >> vec2u(12u);
    let vl = v & vec2i(4095);
    var high = uh.x * vh.y - uh.y * vh.x;
    var middle = (uh.x * vl.y + ul.x * vh.y) - (uh.y * vl.x + ul.y * vh.x);
    var low = ul.x * vl.y - ul.y * vl.x;
    middle += low >> 12u;
    low &= 4095;
    high += middle >> 12u;
    middle &= 4095;
    return vec3i(high, middle, low);
}

// -1, 0 or 1.
fn area_sign(area: vec3i) -> i32 {
    if (area.x != 0) {
        return select(1, -1, area.x < 0);
    }
    return select(0, 1, (area.y | area.z) != 0);
}

// a * x + b * y + e, held within +-2^30: a bin's width from there it has the same sign, and nothing overflows.
//
// In base 256: |a|, |b| <= 2^22, |x|, |y| < 2^15.
fn edge_at(a: i32, b: i32, e: i32, x: i32, y: i32) -> i32 {
    let low = (a & 255) * x + (b & 255) * y + e;
    let high = (a >> 8u) * x + (b >> 8u) * y + (low >> 8u);
    if (high >= 4194304) {
        return 1073741824;
    }
    if (high < -4194304) {
        return -1073741824;
    }
    return high * 256 + (low & 255);
}

// A sample on an edge (a, b) belongs to the triangle whose left or top edge it is.
fn owned(a: i32, b: i32) -> bool {
    return a > 0 || (a == 0 && b > 0);
}

// The edge from p to q, as seen from the pixel `origin`: (a, b, e).
//
// The floor of the constant keeps every sign, since the rest of the sum is a multiple of 256.
fn edge(p: vec3i, q: vec3i, origin: vec2i) -> vec3i {
    let a = p.y - q.y;
    let b = q.x - p.x;
    let from_center = p.xy - vec2i(128);
    let whole = from_center >> vec2u(8u);
    let part = from_center & vec2i(255);
    let constant = (select(-1, 0, owned(a, b)) - (a * part.x + b * part.y)) >> 8u;
    return vec3i(a, b, edge_at(a, b, constant, origin.x - whole.x, origin.y - whole.y));
}

// A slope in depths a pixel, from its numerator and twice the area.
fn slope(numerator: f32, area: f32) -> i32 {
    return i32(clamp(floor(quotient(hold(numerator * 256.0), area) + 0.5), -1073741824.0, 1073741824.0));
}

// The nearness of p, q, r, whose area, doubled, is `size`, as seen from the pixel `origin`.
fn nears_of(p: vec3i, q: vec3i, r: vec3i, size: f32, origin: vec2i) -> Nears {
    let u = vec3f(q - p);
    let v = vec3f(r - p);
    let zx = slope(hold(u.z * v.y) - hold(v.z * u.y), size);
    let zy = slope(hold(v.z * u.x) - hold(u.z * v.x), size);
    let from_center = p.xy - vec2i(128);
    let whole = from_center >> vec2u(8u);
    let part = from_center & vec2i(255);
    let back = ((zx >> 8u) * part.x + (((zx & 255) * part.x) >> 8u)) + ((zy >> 8u) * part.y + (((zy & 255) * part.y) >> 8u));
    let z = p.z - back + zx * (origin.x - whole.x) + zy * (origin.y - whole.y);
    let steep = min(u32(abs(zx)) + u32(abs(zy)), STEEPEST);
    // At most as much as there is of depth, so that nearness stays below zero.
    let bias = min((steep >> 8u) * lens.slope, DEEP - 1u);
    let none = bitcast<i32>(NO_DEPTH - bias);
    return Nears(-zx, -zy, none - z, none - max(p.z, max(q.z, r.z)), none - min(p.z, min(q.z, r.z)));
}

// p, q, r with an area above zero, as seen from the pixel `origin`.
fn plan(p: vec3i, q: vec3i, r: vec3i, origin: vec2i) -> Plan {
    let pq = edge(p, q, origin);
    let qr = edge(q, r, origin);
    let rp = edge(r, p, origin);
    let parts = area(p, q, r);
    let size = (hold(f32(parts.x) * 16777216.0) + hold(f32(parts.y) * 4096.0)) + f32(parts.z);
    return Plan(
        vec3i(pq.x, qr.x, rp.x), vec3i(pq.y, qr.y, rp.y), vec3i(pq.z, qr.z, rp.z), nears_of(p, q, r, size, origin),
    );
}

// NO_DEPTH less the depth of a pixel: the larger, the nearer, and zero is nothing.
fn nearness(n: Nears, x: i32, y: i32) -> u32 {
    return bitcast<u32>(clamp(n.at + n.x * x + n.y * y, n.least, n.most));
}

// The pixels whose centers the bounding box holds: first and last column and row, however far off the film.
fn span(p: vec3i, q: vec3i, r: vec3i) -> vec4i {
    let low = (min(p.xy, min(q.xy, r.xy)) + vec2i(127)) >> vec2u(8u);
    let high = (max(p.xy, max(q.xy, r.xy)) - vec2i(128)) >> vec2u(8u);
    return vec4i(low, high);
}

// The same, on the film.
fn on_film(span: vec4i) -> vec4i {
    return vec4i(max(span.xy, vec2i(0)), min(span.zw, vec2i(i32(lens.width) - 1, i32(lens.height) - 1)));
}
