// rays -> ray trees that end at once, in the color of how many steps their walk takes
#import "tables/slice.wgsl"
#import "shade/scale.wgsl"
#import "trace/walk.wgsl"

@group(0) @binding(6) var<uniform> slice: Slice;
@group(0) @binding(7) var<storage, read_write> paths: array<Path>;
@group(0) @binding(9) var<storage, read_write> status: Status;

// The scale's last color: more steps look the same, and so no walk has to be put down.
const MOST_STEPS: u32 = 1024u;

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    let i = (group.y * groups.x + group.x) * GROUP + lane;
    if (i < slice.count) {
        let path = &paths[i];
        if ((*path).state == SEEK) {
            let ray = Ray((*path).origin, (*path).direction, (*path).leaves);
            let found = walk(ray, Walk((*path).t, (*path).hit, 0u, 0u, 0u), MOST_STEPS, false);
            if (found.hit != NONE) {
                (*path).seen = primitive_at(found.hit).leaf.id;
            }
            (*path).radiance = heat_of(found.turns);
            (*path).state = DONE;
            atomicOr(&status.flags, found.flags);
            atomicMax(&status.turns, found.turns);
        }
    }
    if (lane == 0u) {
        atomicAdd(&status.groups, 1u);
    }
}
