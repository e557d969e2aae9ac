// a ray tree, a surface -> the light asked for there, and the next ray of the tree
#import "tables/slice.wgsl"
#import "tables/status.wgsl"
#import "tables/light.wgsl"
#import "trace/primary.wgsl"
#import "trace/scatter.wgsl"
#import "shade/phong.wgsl"

@group(0) @binding(6) var<uniform> slice: Slice;
@group(0) @binding(7) var<storage, read_write> paths: array<Path>;
// `settings.max_depth` places for each pixel.
@group(0) @binding(8) var<storage, read_write> waiting: array<Waiting>;
@group(0) @binding(9) var<storage, read_write> status: Status;

// Takes up a ray that leaves the primitive in hand.
fn take(path: ptr<function, Path>, origin: vec3f, branch: Branch, depth: u32, leaves: u32) {
    (*path).origin = origin;
    (*path).leaves = leaves;
    (*path).direction = branch.direction;
    (*path).weight = branch.weight;
    (*path).inside = branch.inside;
    (*path).depth = depth;
    (*path).t = FAR;
    (*path).hit = NONE;
    (*path).next = 0u;
    (*path).rays += 1u;
    (*path).state = SEEK;
}

// The next ray that waits, or the tree's end.
fn turn_back(path: ptr<function, Path>, i: u32) {
    if ((*path).waiting == 0u) {
        (*path).state = DONE;
        return;
    }
    (*path).waiting -= 1u;
    let back = waiting[i * settings.max_depth + (*path).waiting];
    take(path, back.origin, Branch(back.direction, back.weight, back.inside), back.depth, back.leaves);
}

// The two ways on from a surface, the heavier one and the lighter one.
struct Fork {
    heavy: Branch,
    light: Branch,
}

fn fork(path: ptr<function, Path>, i: u32, surface: Surface) -> Fork {
    let bits = pcg4d(vec4u(slice.first + i, (*path).sample, (*path).rays, view.seed));
    let random = vec2f(unit_float(bits.x), unit_float(bits.y));
    let branches = scatter((*path).direction, (*path).inside, surface, random);
    var heavy = branches.reflected;
    var light = branches.refracted;
    heavy.weight *= (*path).weight;
    light.weight *= (*path).weight;
    if (largest(light.weight) > largest(heavy.weight)) {
        return Fork(light, heavy);
    }
    return Fork(heavy, light);
}

// Lets a ray wait that leaves the primitive in hand.
fn put_aside(path: ptr<function, Path>, i: u32, point: vec3f, leaves: u32, light: Branch, depth: u32) {
    if ((*path).waiting >= settings.max_depth) {
        atomicOr(&status.flags, STACK_FULL);
    } else {
        waiting[i * settings.max_depth + (*path).waiting] =
            Waiting(point, leaves, light.direction, depth, light.weight, light.inside);
        (*path).waiting += 1u;
    }
}

// Follows the heavier branch and lets the lighter one wait: at most one waits for each level of the tree.
fn go_on(path: ptr<function, Path>, i: u32, surface: Surface) {
    let ways = fork(path, i, surface);
    if ((*path).depth >= settings.max_depth) {
        (*path).radiance += (ways.heavy.weight + ways.light.weight) * settings.background;
        turn_back(path, i);
        return;
    }
    if (largest(ways.light.weight) > settings.cutoff) {
        put_aside(path, i, start_of(surface, ways.light.direction), (*path).hit, ways.light, (*path).depth + 1u);
    }
    if (largest(ways.heavy.weight) > settings.cutoff) {
        take(path, start_of(surface, ways.heavy.direction), ways.heavy, (*path).depth + 1u, (*path).hit);
    } else {
        turn_back(path, i);
    }
}

// The light that reaches the eye from one light source, before anything that stands between.
struct Lit {
    color: vec3f,
    shadow: Ray,
    // The shadow ray counts up to here.
    reach: f32,
}

fn lit(path: ptr<function, Path>, surface: Surface, source: Light) -> Lit {
    let point_light = source.kind == POINT;
    // A light behind the surface is not asked: the ray starts before it.
    let origin = start_of(surface, surface.normal);
    let toward = select(source.place, source.place - origin, point_light);
    let shadow = Ray(origin, toward, (*path).hit);
    let l = unit(toward);
    if (!(dot(l, surface.normal) > 0.0 && dot(l, surface.shading) > 0.0)) {
        return Lit(vec3f(0.0), shadow, 0.0);
    }
    let terms = phong(surface.shading, l, -(*path).direction, surface.material.exponent);
    let strength = surface.material.local_weight * (vec3f(terms.x) + surface.specular * terms.y);
    let color = (*path).weight * (surface.material.color * (source.power * strength));
    return Lit(color, shadow, select(FAR, 1.0, point_light));
}
