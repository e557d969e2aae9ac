// a paint and a place on it -> the color, the highlight and the bump that its pictures give it there
#import "tables/mesh.wgsl"
#import "math/vector.wgsl"
#import "shade/texture.wgsl"

// Products fenced one by one, summed in one order.
fn sum_by(w: vec3f, a: vec3f, b: vec3f, c: vec3f) -> vec3f {
    return vec3f(
        (hold(a.x * w.x) + hold(b.x * w.y)) + hold(c.x * w.z),
        (hold(a.y * w.x) + hold(b.y * w.y)) + hold(c.y * w.z),
        (hold(a.z * w.x) + hold(b.z * w.y)) + hold(c.z * w.z),
    );
}

fn uv_by(w: vec3f, a: Vertex, b: Vertex, c: Vertex) -> vec2f {
    return sum_by(w, vec3f(a.u, a.v, 0.0), vec3f(b.u, b.v, 0.0), vec3f(c.u, c.v, 0.0)).xy;
}

// The normal of a map in world space: T and B are what an edge's u and v stand for (spec, "Get the normal for a
// fragment"), N is interpolated.
fn bumped(n: vec3f, a: Vertex, b: Vertex, c: Vertex, tangent: vec3f) -> vec3f {
    let e = b.position - a.position;
    let f = c.position - a.position;
    let du = vec2f(b.u - a.u, c.u - a.u);
    let dv = vec2f(b.v - a.v, c.v - a.v);
    let turn = hold(du.x * dv.y) - hold(du.y * dv.x);
    if (turn == 0.0) {
        return n;
    }
    let side = select(1.0, -1.0, turn < 0.0);
    let along_u = sum_by(vec3f(dv.y * side, -(dv.x * side), 0.0), e, f, vec3f(0.0));
    let along_v = sum_by(vec3f(-(du.y * side), du.x * side, 0.0), e, f, vec3f(0.0));
    if (dot(along_u, along_u) == 0.0 || dot(along_v, along_v) == 0.0) {
        return n;
    }
    let bent = unit(sum_by(tangent, unit(along_u), unit(along_v), n));
    // Coordinates too large to be told apart, and a picture's zero, bend nothing.
    return select(n, bent, dot(bent, bent) > 0.0);
}

struct Look {
    // Times the surface's own.
    color: vec3f,
    specular: vec3f,
    exponent: f32,
    // The normal in tangent space; of any length.
    tangent: vec3f,
}

fn look_of(paint: Paint, uv: vec2f, right: vec2f, down: vec2f) -> Look {
    var look = Look(vec3f(1.0), paint.specular, paint.exponent, vec3f(0.0, 0.0, 1.0));
    #repeat colors
    var color: Sample;
    if (paint.diffuse_map.first != NONE) {
        color = sample_at(paint.diffuse_map, uv, right, down);
    }
    #end
    #repeat gloss
    var gloss: Sample;
    if (paint.specular_map.first != NONE) {
        gloss = sample_at(paint.specular_map, uv, right, down);
    }
    #end
    #repeat sharpness
    var sharpness: Sample;
    if (paint.exponent_map.first != NONE) {
        sharpness = sample_at(paint.exponent_map, uv, right, down);
    }
    #end
    #repeat bumps
    var bump: Sample;
    if (paint.normal_map.first != NONE) {
        bump = sample_at(paint.normal_map, uv, right, down);
    }
    #end
    #repeat colors
    if (paint.diffuse_map.first != NONE) {
        look.color = color_of_sample(color, true);
    }
    #end
    #repeat gloss
    if (paint.specular_map.first != NONE) {
        look.specular *= color_of_sample(gloss, false);
    }
    #end
    #repeat sharpness
    if (paint.exponent_map.first != NONE) {
        look.exponent *= color_of_sample(sharpness, false).x;
    }
    #end
    #repeat bumps
    if (paint.normal_map.first != NONE) {
        let map = color_of_sample(bump, false) * 2.0 - 1.0;
        // A picture that is turned over slopes the other way, too.
        let way = select(vec2f(paint.bump), vec2f(-paint.bump), paint.normal_map.scale < vec2f(0.0));
        look.tangent = vec3f(map.xy * way, map.z);
    }
    #end
    return look;
}
