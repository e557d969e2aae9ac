// pixels -> primary rays
#import "tables/view.wgsl"
#import "tables/slice.wgsl"
#import "tables/status.wgsl"
#import "tables/settings.wgsl"
#import "tables/path.wgsl"
#import "math/fence.wgsl"
#import "math/vector.wgsl"

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> slice: Slice;
@group(0) @binding(2) var<storage, read_write> paths: array<Path>;
@group(0) @binding(3) var<storage, read_write> status: Status;
@group(0) @binding(4) var<uniform> settings: Settings;

// Where in its pixel a sample lies, in [0, 1)^2 from the lower left corner.
fn place(sample: u32) -> vec2f {
    if (view.grid > 0u) {
        return vec2f(vec2u(sample % view.grid, sample / view.grid)) / f32(view.grid);
    }
    // The R2 sequence (Roberts, 2018): multiples of 1/p and 1/p^2, p = 1.3247..., as fractions of 2^32.
    return vec2f(
        f32((sample * 3242174889u) >> 8u) * 5.9604645e-8,
        f32((sample * 2447445414u) >> 8u) * 5.9604645e-8,
    );
}

// Spec 2.2, with the film plane at distance one and rows counted from the top.
fn primary(pixel: u32, sample: u32) -> vec3f {
    let at = place(sample);
    let x = (f32(pixel % view.width) + at.x) / f32(view.width) - 0.5;
    let y = (f32(view.height - 1u - pixel / view.width) + at.y) / f32(view.height) - 0.5;
    return unit(fence(view.right * x + view.up * y, settings.zero) - view.back);
}

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    let i = (group.y * groups.x + group.x) * GROUP + lane;
    if (i < slice.count) {
        let path = &paths[i];
        if ((*path).state == IDLE && (*path).sample < slice.samples) {
            (*path).origin = view.eye;
            (*path).leaves = NONE;
            (*path).direction = primary(slice.first + i, (*path).sample);
            (*path).t = FAR;
            (*path).weight = vec3f(1.0);
            (*path).depth = 1u;
            (*path).radiance = vec3f(0.0);
            (*path).inside = 0u;
            (*path).state = SEEK;
            (*path).hit = NONE;
            (*path).next = 0u;
            (*path).light = 0u;
            (*path).waiting = 0u;
            (*path).rays = 0u;
            (*path).seen = NONE;
        }
    }
    if (lane == 0u) {
        atomicAdd(&status.groups, 1u);
    }
}
