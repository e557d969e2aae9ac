// rays -> ray trees followed to their end, or for as long as the budget lasts
#import "trace/tree.wgsl"

@group(0) @binding(5) var<storage, read> lights: array<Light>;

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
