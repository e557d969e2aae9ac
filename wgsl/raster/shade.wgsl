// runs that show a face -> each pixel's color, once
#import "tables/slice.wgsl"
#import "tables/mesh.wgsl"
#import "tables/piece.wgsl"
#import "raster/weights.wgsl"
#import "math/whole.wgsl"
#import "shade/look.wgsl"
#import "raster/shadow.wgsl"
#import "shade/phong.wgsl"

@group(0) @binding(0) var<uniform> lens: Lens;
@group(0) @binding(1) var<uniform> canvas: Canvas;
@group(0) @binding(2) var<uniform> part: Part;
@group(0) @binding(5) var lenses: Table;
@group(0) @binding(8) var<storage, read> shadows: array<u32>;
@group(0) @binding(9) var<storage, read> image: array<u32>;
@group(0) @binding(7) var<storage, read> runs: array<u32>;
@group(0) @binding(11) var<storage, read_write> tally: Tally;
// Red, green, blue and the number of samples in the sum: the proof that the pixel was colored.
@group(0) @binding(10) var<storage, read_write> sums: array<vec4f>;

const LAMPS: u32 = $lamps;
const SHOW: u32 = $show;

// Another color for every number.
fn color_of(id: u32) -> vec3f {
    let bits = id * 2654435769u;
    return vec3f(vec3u(bits >> 24u, (bits >> 16u) & 255u, (bits >> 8u) & 255u)) / 255.0 * 0.75 + 0.25;
}

// Column and row of a pixel.
fn place_of(pixel: u32) -> vec2u {
    let row = whole(pixel, lens.width);
    return vec2u(pixel - row * lens.width, row);
}

// How steeply a weight grows from a pixel to its neighbors, and so how many pixels from it the weight is zero.
fn away(w: f32, across: f32, below: f32) -> f32 {
    let x = hold(across - w);
    let y = hold(below - w);
    return w / max(sqrt(hold(x * x) + hold(y * y)), 1e-10);
}

// 0 on a face's edges, 1 from a pixel and a quarter away from them; from its weights in a pixel, right of it and below.
fn off_edges(w: vec3f, across: vec3f, below: vec3f) -> f32 {
    let nearest = min(away(w.x, across.x, below.x), min(away(w.y, across.y, below.y), away(w.z, across.z, below.z)));
    return clamp(hold(nearest) - 0.25, 0.0, 1.0);
}

fn color_at(pixel: u32, id: u32) -> vec3f {
    let start = vec2u(lens.left, lens.top) % REGION;
    let at = vec2f(start + place_of(pixel)) + 0.5;
    let face = face_at(id - part.first);
    let paint = paint_at(face.paint & ~(ONE_SIDED | CUT_OUT));
    let a = vertex_at(face.a);
    let b = vertex_at(face.b);
    let c = vertex_at(face.c);
    let ca = to_clip(a.position);
    let cb = to_clip(b.position);
    let cc = to_clip(c.position);
    let w = weights_inside(ca, cb, cc, at);
    let p = sum_by(w, a.position, b.position, c.position);
    let uv = uv_by(w, a, b, c);
    let across = weights(ca, cb, cc, at + vec2f(1.0, 0.0));
    let below = weights(ca, cb, cc, at + vec2f(0.0, 1.0));
    let right = uv_by(across, a, b, c);
    let down = uv_by(below, a, b, c);

    // The only lamp's map is read before the pictures are, so that both are on their way from memory at the same time.
    var only = 1.0;
    if (LAMPS == 1u) {
        only = reaches(lamp_at(0u), p);
    }
    let look = look_of(paint, uv, right, down);
    let albedo = paint.color * look.color;
    var n = unit(sum_by(w, a.normal, b.normal, c.normal));
    #repeat bumps
    if (paint.normal_map.first != NONE) {
        n = bumped(n, a, b, c, look.tangent);
    }
    #end
    let v = unit(canvas.eye - p);
    // A face that is seen from its back shows its back.
    if (dot(cross(b.position - a.position, c.position - a.position), v) < 0.0) {
        n = -n;
    }

    var diffuse = vec3f(0.0);
    var specular = vec3f(0.0);
    var open = 0.0;
    for (var i = 0u; i < LAMPS; i++) {
        let lamp = lamp_at(i);
        var l = lamp.place;
        if (lamp.kind == POINT) {
            l = unit(lamp.place - p);
        }
        var share = only;
        if (LAMPS > 1u) {
            share = reaches(lamp, p);
        }
        open += share / f32(LAMPS);
        if (dot(n, l) > 0.0) {
            let power = lamp.power * (canvas.shade + (1.0 - canvas.shade) * share);
            let terms = phong(n, l, v, look.exponent);
            diffuse += power * terms.x;
            specular += look.specular * power * terms.y;
        }
    }
    switch (SHOW) {
        case SHOW_DEPTH: {
            let gray = canvas.depth_times / sum_by(w, vec3f(ca.w), vec3f(cb.w), vec3f(cc.w)).x + canvas.depth_plus;
            return vec3f(min(max(gray, canvas.depth_least), canvas.depth_most));
        }
        case SHOW_SHADOW: { return vec3f(open); }
        case SHOW_NORMAL: { return n * 0.5 + 0.5; }
        case SHOW_UV: { return vec3f(within(uv.x, false), within(uv.y, false), 0.0); }
        case SHOW_ALBEDO: { return albedo; }
        case SHOW_AMBIENT: { return canvas.ambient; }
        case SHOW_DIFFUSE: { return diffuse * albedo; }
        case SHOW_SPECULAR: { return specular * albedo; }
        case SHOW_WIRE: { return vec3f((0.15 + 0.6 * max(dot(n, v), 0.0)) * off_edges(w, across, below)); }
        case SHOW_ID: { return color_of(id); }
        default: { return (diffuse + specular) * albedo + canvas.ambient; }
    }
}

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    let number = group.y * groups.x + group.x;
    if (number >= atomicLoad(&tally.shown)) {
        return;
    }
    let i = runs[number] * GROUP + lane;
    if (i < lens.width * lens.height) {
        let id = NONE - image[2u * i];
        let mine = id - part.first < part.faces;
        if (mine || (id == NONE && part.first == 0u)) {
            let sample = vec4f(select(canvas.background, color_at(i, id), mine), 1.0);
#if once
            sums[i] = sample;
#else
            sums[i] += sample;
#end
        }
    }
}
