// a point of a primitive -> the normal that it is lit by there, and what its pictures say
#import "math/angle.wgsl"
#import "math/fence.wgsl"
#import "shade/look.wgsl"
#import "trace/hold.wgsl"
#import "trace/primary.wgsl"
#import "trace/walk.wgsl"

// Where the eye's rays one pixel to the right and one down meet the plane of a surface that it sees: a pixel's
// footprint. What mirrors and glass show has none, and so is read from the finest level.
struct Beside {
    right: vec3f,
    down: vec3f,
}

fn on_plane(way: vec3f, above: f32, normal: vec3f, most: f32) -> vec3f {
    let t = above / dot(normal, way);
    // Beyond the horizon it is far away.
    return fence(view.eye + way * select(most, t, t > 0.0 && t < most), settings.zero);
}

fn beside(ray: Ray, point: vec3f, normal: vec3f) -> Beside {
    let away = point - view.eye;
    let depth = -dot(away, view.back);
    if (ray.leaves != NONE || !(depth > 0.0)) {
        return Beside(point, point);
    }
    let way = away / depth;
    let above = dot(normal, away);
    let most = depth * 1e4;
    let right = on_plane(way + view.right / f32(view.width), above, normal, most);
    return Beside(right, on_plane(way - view.up / f32(view.height), above, normal, most));
}

// What each corner of a triangle counts for at a point of its plane; they sum to one.
fn weights_at(p: vec3f, normal: vec3f, a: vec3f, b: vec3f, c: vec3f) -> vec3f {
    let areas = vec3f(
        dot(cross(b - p, c - p), normal), dot(cross(c - p, a - p), normal), dot(cross(a - p, b - p), normal),
    );
    let sum = (areas.x + areas.y) + areas.z;
    if (sum == 0.0) {
        return vec3f(1.0, 0.0, 0.0);
    }
    return areas / sum;
}

// Once around y, and from the bottom up.
fn uv_of_sphere(away: vec3f) -> vec2f {
    let ring = sqrt(away.x * away.x + away.z * away.z);
    return vec2f(turns(away.x, -away.z), 1.0 - 2.0 * turns(away.y, ring));
}

// The same, without the jump at the seam.
fn uv_near(away: vec3f, uv: vec2f) -> vec2f {
    let near = uv_of_sphere(away);
    return vec2f(near.x + floor(uv.x - near.x + 0.5), near.y);
}

struct Detail {
    // Of length one; on the outer side.
    normal: vec3f,
    look: Look,
}

// `normal`: the primitive's own, on its outer side.
fn detail_at(ray: Ray, primitive: Primitive, point: vec3f, normal: vec3f) -> Detail {
    let leaf = primitive.leaf;
    let paint = paint_at(leaf.material);
    let p = fence(point, settings.zero);
    var sides = Beside(p, p);
    if (FILTERING == MIPMAP) {
        sides = beside(ray, p, normal);
    }
    var uv = vec2f(0.0);
    var right = uv;
    var down = uv;
    // The ways in which u and v grow.
    var along_u = vec3f(0.0);
    var along_v = vec3f(0.0);
    var n = normal;
    var a: Vertex;
    var b: Vertex;
    var c: Vertex;
    if (leaf.kind == SPHERE) {
        uv = uv_of_sphere(p - leaf.a);
        right = uv_near(sides.right - leaf.a, uv);
        down = uv_near(sides.down - leaf.a, uv);
        along_u = vec3f(normal.z, 0.0, -normal.x);
        along_v = cross(normal, along_u);
    } else if (leaf.kind == PLANE) {
        along_u = leaf.c;
        along_v = cross(normal, along_u);
        uv = vec2f(dot(p - leaf.a, along_u), dot(p - leaf.a, along_v));
        right = vec2f(dot(sides.right - leaf.a, along_u), dot(sides.right - leaf.a, along_v));
        down = vec2f(dot(sides.down - leaf.a, along_u), dot(sides.down - leaf.a, along_v));
    } else {
        let face = face_at(primitive.face);
        a = corner_of(face.a, primitive.holder);
        b = corner_of(face.b, primitive.holder);
        c = corner_of(face.c, primitive.holder);
        // Rounding may put the point a trifle outside.
        let inside = max(weights_at(p, normal, leaf.a, leaf.b, leaf.c), vec3f(0.0));
        let w = inside / ((inside.x + inside.y) + inside.z);
        let between = sum_by(w, a.normal, b.normal, c.normal);
        if (dot(between, between) > 0.0) {
            n = unit(between);
        }
        uv = uv_by(w, a, b, c);
        right = uv;
        down = uv;
        if (FILTERING == MIPMAP) {
            right = uv_by(weights_at(sides.right, normal, leaf.a, leaf.b, leaf.c), a, b, c);
            down = uv_by(weights_at(sides.down, normal, leaf.a, leaf.b, leaf.c), a, b, c);
        }
    }
    let look = look_of(paint, uv, right, down);
    #repeat bumps
    if (paint.normal_map.first != NONE) {
        if (leaf.kind != SPHERE && leaf.kind != PLANE) {
            n = bumped(n, a, b, c, look.tangent);
        } else if (dot(along_u, along_u) > 0.0) {
            n = unit(sum_by(look.tangent, unit(along_u), unit(along_v), n));
        }
    }
    #end
    return Detail(n, look);
}
