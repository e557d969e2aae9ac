// rays -> ray trees followed to their end, or for as long as the budget lasts
#import "tables/slice.wgsl"
#import "tables/status.wgsl"
#import "tables/light.wgsl"
#import "tables/view.wgsl"
#import "trace/scatter.wgsl"
#import "shade/phong.wgsl"

@group(0) @binding(5) var<storage, read> lights: array<Light>;
@group(0) @binding(6) var<uniform> slice: Slice;
@group(0) @binding(7) var<storage, read_write> paths: array<Path>;
// `settings.max_depth` places for each pixel.
@group(0) @binding(8) var<storage, read_write> waiting: array<Waiting>;
@group(0) @binding(9) var<storage, read_write> status: Status;
@group(0) @binding(10) var<uniform> view: View;

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

// Follows the heavier branch and lets the lighter one wait: at most one waits for each level of the tree.
fn go_on(path: ptr<function, Path>, i: u32, surface: Surface) {
    let bits = pcg4d(vec4u(slice.first + i, (*path).sample, (*path).rays, view.seed));
    let random = vec2f(unit_float(bits.x), unit_float(bits.y));
    let branches = scatter((*path).direction, (*path).inside, surface, random);
    var heavy = branches.reflected;
    var light = branches.refracted;
    heavy.weight *= (*path).weight;
    light.weight *= (*path).weight;
    if (largest(light.weight) > largest(heavy.weight)) {
        let other = heavy;
        heavy = light;
        light = other;
    }
    if ((*path).depth >= settings.max_depth) {
        (*path).radiance += (heavy.weight + light.weight) * settings.background;
        turn_back(path, i);
        return;
    }
    if (largest(light.weight) > settings.cutoff) {
        if ((*path).waiting >= settings.max_depth) {
            atomicOr(&status.flags, STACK_FULL);
        } else {
            waiting[i * settings.max_depth + (*path).waiting] = Waiting(
                surface.point, (*path).hit, light.direction, (*path).depth + 1u, light.weight, light.inside,
            );
            (*path).waiting += 1u;
        }
    }
    if (largest(heavy.weight) > settings.cutoff) {
        take(path, surface.point, heavy, (*path).depth + 1u, (*path).hit);
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
    let toward = select(source.place, source.place - surface.point, point_light);
    let shadow = Ray(surface.point, toward, (*path).hit);
    let l = unit(toward);
    if (!(dot(l, surface.normal) > 0.0)) {
        return Lit(vec3f(0.0), shadow, 0.0);
    }
    let terms = phong(surface.normal, l, -(*path).direction, surface.material.exponent, settings.specular);
    let strength = surface.material.local_weight * (terms.x + terms.y);
    let color = (*path).weight * (surface.material.color * (source.power * strength));
    return Lit(color, shadow, select(FAR, 1.0, point_light));
}

fn follow(path: ptr<function, Path>, i: u32) {
    var turns = 0u;
    var spent = false;
    while ((*path).state == SEEK || (*path).state == LIT) {
        turns += 1u;
        if (turns >= slice.budget) {
            spent = true;
            break;
        }
        let ray = Ray((*path).origin, (*path).direction, (*path).leaves);
        if ((*path).state == SEEK) {
            let from_here = (*path).next;
            let end = min(primitives(), from_here + (slice.budget - turns));
            let found = walk(ray, Found((*path).t, (*path).hit, from_here), end, false);
            (*path).t = found.t;
            (*path).hit = found.hit;
            (*path).next = found.next;
            turns += found.next - from_here;
            if (found.next < end) {
                atomicOr(&status.flags, CUT_SHORT);
            }
            if (found.next < primitives()) {
                spent = true;
                break;
            }
            if ((*path).rays == 0u) {
                (*path).seen = found.hit;
            }
            if (found.hit == NONE) {
                (*path).radiance += (*path).weight * settings.background;
                turn_back(path, i);
                continue;
            }
            (*path).state = LIT;
            (*path).next = 0u;
            // Inside an object no light is asked (spec 2.1, step 2).
            (*path).light = select(0u, settings.lights, (*path).inside == 1u);
        }

        let surface = surface_at(ray, (*path).t, (*path).hit);
        while ((*path).light < settings.lights) {
            turns += 1u;
            if (turns >= slice.budget) {
                spent = true;
                break;
            }
            let asked = lit(path, surface, lights[(*path).light]);
            if (asked.reach > 0.0) {
                let from_here = (*path).next;
                let end = min(primitives(), from_here + (slice.budget - turns));
                let found = walk(asked.shadow, Found(asked.reach, NONE, from_here), end, true);
                turns += found.next - from_here;
                if (found.hit == NONE && found.next < end) {
                    atomicOr(&status.flags, CUT_SHORT);
                }
                if (found.hit == NONE && found.next < primitives()) {
                    (*path).next = found.next;
                    spent = true;
                    break;
                }
                if (found.hit == NONE) {
                    (*path).radiance += asked.color;
                }
            }
            (*path).light += 1u;
            (*path).next = 0u;
        }
        if (spent) {
            break;
        }
        if ((*path).light < settings.lights) {
            atomicOr(&status.flags, CUT_SHORT);
            break;
        }
        go_on(path, i, surface);
    }
    if (!spent && ((*path).state == SEEK || (*path).state == LIT)) {
        atomicOr(&status.flags, CUT_SHORT);
    }
    // Read before the atomic, which many would otherwise wait for.
    if (turns > atomicLoad(&status.turns)) {
        atomicMax(&status.turns, turns);
    }
}

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    let i = (group.y * groups.x + group.x) * GROUP + lane;
    if (i < slice.count) {
        var path = paths[i];
        if (path.state == SEEK || path.state == LIT) {
            follow(&path, i);
            paths[i] = path;
        }
    }
    if (lane == 0u) {
        atomicAdd(&status.groups, 1u);
    }
}
