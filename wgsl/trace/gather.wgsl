// finished ray trees -> sums on the film
#import "tables/slice.wgsl"
#import "tables/status.wgsl"
#import "tables/path.wgsl"
#import "math/vector.wgsl"

@group(0) @binding(0) var<uniform> slice: Slice;
@group(0) @binding(1) var<storage, read_write> paths: array<Path>;
// Red, green, blue and the number of samples in the sum.
@group(0) @binding(2) var<storage, read_write> sums: array<vec4f>;
@group(0) @binding(3) var<storage, read_write> ids: array<u32>;
// Of the samples' luminances: with the sums, how far the samples lie apart.
@group(0) @binding(5) var<storage, read_write> squares: array<f32>;
@group(0) @binding(4) var<storage, read_write> status: Status;

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    let i = (group.y * groups.x + group.x) * GROUP + lane;
    if (i < slice.count) {
        let path = &paths[i];
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
    if (lane == 0u) {
        atomicAdd(&status.groups, 1u);
    }
}
