// pixels of a scene of few primitives -> sums on the film: cast, follow and gather for sample after sample
#import "trace/tree.wgsl"
#import "trace/unrolled.wgsl"

@group(0) @binding(11) var<storage, read_write> sums: array<vec4f>;
@group(0) @binding(12) var<storage, read_write> ids: array<u32>;
@group(0) @binding(13) var<storage, read_write> squares: array<f32>;

// A ray's end, from where the next waiting ray is taken up; and a ray's fork, of which one branch has to wait.
// The stack is kept out of the innermost loop: lavapipe would pay for it at every turn.
const BACK: u32 = 4u;
const FORK: u32 = 5u;

// Follows one ray, with its shadow rays; returns the branch that has to wait if the path is at a FORK then.
fn step(path: ptr<function, Path>, i: u32) -> Branch {
    let ray = Ray((*path).origin, (*path).direction, (*path).leaves);
    let found = nearest(ray);
    if ((*path).rays == 0u) {
        (*path).seen = found.hit;
    }
    if (found.hit == NONE) {
        (*path).radiance += (*path).weight * settings.background;
        (*path).state = BACK;
        return Branch();
    }
    (*path).hit = found.hit;
    let surface = surface_of(ray, found.t, found.hit);
    #repeat lights
    {
        let asked = lit(path, surface, own.lights[$i]);
        // Inside an object no light is asked (spec 2.1, step 2).
        if ((*path).inside == 0u && asked.reach > 0.0 && free(asked.shadow, asked.reach)) {
            (*path).radiance += asked.color;
        }
    }
    #end
    let ways = fork(path, i, surface);
    if ((*path).depth >= settings.max_depth) {
        (*path).radiance += (ways.heavy.weight + ways.light.weight) * settings.background;
        (*path).state = BACK;
    } else if (largest(ways.heavy.weight) > settings.cutoff) {
        take(path, surface.point, ways.heavy, (*path).depth + 1u, (*path).hit);
        if (largest(ways.light.weight) > settings.cutoff) {
            (*path).state = FORK;
        }
    } else {
        (*path).state = BACK;
    }
    return ways.light;
}

fn follow(path: ptr<function, Path>, i: u32) {
    let corner = corner(slice.first + i);
    var turns = 0u;
    while ((*path).sample < slice.samples && turns < slice.budget) {
        turns += 1u;
        if ((*path).state == IDLE) {
            *path = seed((*path).sample, primary(corner, (*path).sample, settings.zero));
        }
        while ((*path).state == SEEK && turns < slice.budget) {
            var light: Branch;
            while ((*path).state == SEEK && turns < slice.budget) {
                turns += 1u;
                light = step(path, i);
            }
            if ((*path).state == FORK) {
                // The heavier branch has been taken up already, at the same point and depth.
                put_aside(path, i, (*path).origin, (*path).leaves, light, (*path).depth);
                (*path).state = SEEK;
            } else if ((*path).state == BACK) {
                turn_back(path, i);
            }
        }
        if ((*path).state == DONE) {
            sums[i] += vec4f((*path).radiance, 1.0);
            let light = luminance((*path).radiance);
            squares[i] += light * light;
            if ((*path).sample == 0u) {
                ids[i] = (*path).seen;
            }
            (*path).sample += 1u;
            (*path).state = IDLE;
            if ((*path).sample == slice.samples) {
                atomicAdd(&status.pixels, 1u);
            }
        }
    }
    if ((*path).sample < slice.samples && turns < slice.budget) {
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
    own = scene;
    let i = (group.y * groups.x + group.x) * GROUP + lane;
    if (i < slice.count) {
        var path = paths[i];
        if (path.sample < slice.samples) {
            follow(&path, i);
            paths[i] = path;
        }
    }
    if (lane == 0u) {
        atomicAdd(&status.groups, 1u);
    }
}
