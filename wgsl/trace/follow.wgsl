// rays -> ray trees followed to their end, or for as long as the budget lasts
#import "trace/tree.wgsl"

@group(0) @binding(5) var<storage, read> lights: array<Light>;

// The stacks of walks that are put down, DEEP places for each pixel.
@group(0) @binding(3) var<storage, read_write> walks: array<vec2u>;

fn follow(path: ptr<function, Path>, i: u32) {
    var turns = 0u;
    var spent = false;
    var flags = 0u;
    // Of the hit in hand: its pictures are read once, however many lights are asked.
    var surface: Surface;
    var known = false;
    while (((*path).state == SEEK || (*path).state == LIT) && turns < slice.budget && !spent) {
        var asked = Lit();
        if ((*path).state == LIT) {
            if (!known) {
                let ray = Ray((*path).origin, (*path).direction, (*path).leaves);
                surface = surface_at(ray, (*path).t, (*path).hit);
                known = true;
            }
            while ((*path).light < settings.lights && turns < slice.budget && asked.reach == 0.0) {
                turns += 1u;
                asked = lit(path, surface, lights[(*path).light]);
                if (asked.reach == 0.0) {
                    (*path).light += 1u;
                }
            }
            if (asked.reach == 0.0 && (*path).light < settings.lights) {
                if (turns < slice.budget) {
                    flags |= CUT_SHORT;
                }
                break;
            }
            if (asked.reach == 0.0) {
                go_on(path, i, surface);
                known = false;
            }
        }
        // The tree's own ray, or a shadow ray of its hit.
        let own = (*path).state == SEEK;
        var ray = asked.shadow;
        var start = Walk(asked.reach, NONE, (*path).next, turns, 0u);
        if (own) {
            ray = Ray((*path).origin, (*path).direction, (*path).leaves);
            start = Walk((*path).t, (*path).hit, (*path).next, turns, 0u);
        } else if ((*path).state == DONE) {
            break;
        }
        let put_down = i * DEEP;
        for (var k = 0u; k + settings.planes + 1u < start.next; k += 1u) {
            stack[k] = walks[put_down + k];
        }
        #repeat copies
        stack[DEEP - 1u] = walks[put_down + DEEP - 1u];
        #end
        let found = walk(ray, start, slice.budget, !own);
        turns = found.turns;
        flags |= found.flags;
        if (own) {
            (*path).t = found.t;
            (*path).hit = found.hit;
        }
        if (!over(found, !own)) {
            for (var k = 0u; k + settings.planes + 1u < found.next; k += 1u) {
                walks[put_down + k] = stack[k];
            }
            #repeat copies
            walks[put_down + DEEP - 1u] = stack[DEEP - 1u];
            #end
            (*path).next = found.next;
            spent = true;
            continue;
        }
        (*path).next = 0u;
        if (own) {
            if ((*path).rays == 0u && found.hit != NONE) {
                (*path).seen = primitive_at(found.hit).leaf.id;
            }
            if (found.hit == NONE) {
                (*path).radiance += (*path).weight * settings.background;
                turn_back(path, i);
            } else {
                (*path).state = LIT;
                // Inside an object no light is asked (spec 2.1, step 2).
                (*path).light = select(0u, settings.lights, (*path).inside == 1u);
            }
        } else {
            if (found.hit == NONE) {
                (*path).radiance += asked.color;
            }
            (*path).light += 1u;
        }
    }
    if (((*path).state == SEEK || (*path).state == LIT) && turns < slice.budget && !spent) {
        flags |= CUT_SHORT;
    }
    if (flags != 0u) {
        atomicOr(&status.flags, flags);
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
