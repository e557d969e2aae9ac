// The peer's whole frame, written as one would for a graphics pipeline.
struct Frame {
    eye_x: vec4f, eye_y: vec4f, eye_z: vec4f, eye_w: vec4f,
    sun_x: vec4f, sun_y: vec4f, sun_z: vec4f, sun_w: vec4f,
    eye: vec3f, shade: f32,
    toward: vec3f, bias: f32,
    power: vec3f, pad: f32,
    ambient: vec3f, pad2: f32,
}
struct Paint { color: vec3f, exponent: f32, specular: vec3f, bump: f32, scale: vec2f, shift: vec2f }

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var shadows: texture_depth_2d;
@group(1) @binding(0) var<uniform> paint: Paint;
@group(1) @binding(1) var diffuse_map: texture_2d<f32>;
@group(1) @binding(2) var normal_map: texture_2d<f32>;
@group(1) @binding(3) var specular_map: texture_2d<f32>;
@group(1) @binding(4) var bilinear: sampler;

struct Seen {
    @builtin(position) at: vec4f,
    @location(0) p: vec3f,
    @location(1) uv: vec2f,
    @location(2) n: vec3f,
}

fn through(x: vec4f, y: vec4f, z: vec4f, w: vec4f, p: vec3f) -> vec4f {
    let at = vec4f(p, 1.0);
    return vec4f(dot(x, at), dot(y, at), dot(z, at), dot(w, at));
}

@vertex fn by_sun(@location(0) p: vec3f) -> @builtin(position) vec4f {
    return through(frame.sun_x, frame.sun_y, frame.sun_z, frame.sun_w, p);
}

@vertex fn by_eye(@location(0) p: vec3f, @location(1) u: f32, @location(2) n: vec3f, @location(3) v: f32) -> Seen {
    return Seen(through(frame.eye_x, frame.eye_y, frame.eye_z, frame.eye_w, p), p, vec2f(u, v), n);
}

@fragment fn color(seen: Seen) -> @location(0) vec4f {
    let place = seen.uv * paint.scale + paint.shift;
    let uv = vec2f(place.x, 1.0 - place.y);
    let albedo = paint.color * textureSampleLevel(diffuse_map, bilinear, uv, 0.0).rgb;
    let weight = paint.specular * textureSampleLevel(specular_map, bilinear, uv, 0.0).rgb;
    let map = textureSampleLevel(normal_map, bilinear, uv, 0.0).xyz * 2.0 - 1.0;
    // A face's tangents from what changes between pixels.
    let px = dpdx(seen.p);
    let py = dpdy(seen.p);
    let ux = dpdx(seen.uv);
    let uy = dpdy(seen.uv);
    let turn = select(1.0, -1.0, ux.x * uy.y - ux.y * uy.x < 0.0);
    let t = normalize((px * uy.y - py * ux.y) * turn);
    let b = normalize((py * ux.x - px * uy.x) * turn);
    var n = normalize(seen.n);
    n = normalize(t * map.x * paint.bump + b * map.y * paint.bump + n * map.z);
    let v = normalize(frame.eye - seen.p);
    if (dot(cross(px, py), v) > 0.0) {
        n = select(n, -n, dot(n, v) < 0.0 && dot(seen.n, v) < 0.0);
    }
    let by_sun = through(frame.sun_x, frame.sun_y, frame.sun_z, frame.sun_w, seen.p);
    let on_map = by_sun.xy * vec2f(0.5, -0.5) + 0.5;
    let size = vec2f(textureDimensions(shadows));
    let nearest = textureLoad(shadows, vec2i(on_map * size), 0);
    let share = select(0.0, 1.0, by_sun.z - frame.bias <= nearest);
    let l = frame.toward;
    let power = frame.power * (frame.shade + (1.0 - frame.shade) * share);
    let facing = dot(n, l);
    let glint = pow(max(0.0, dot(2.0 * facing * n - l, v)), paint.exponent);
    let lit = select(vec3f(0.0), power * facing + weight * power * glint, facing > 0.0);
    return vec4f(lit * albedo + frame.ambient, 1.0);
}
