// pixels -> primary rays
#import "tables/slice.wgsl"
#import "tables/status.wgsl"
#import "tables/settings.wgsl"
#import "tables/path.wgsl"
#import "trace/primary.wgsl"

@group(0) @binding(0) var<uniform> settings: Settings;
@group(0) @binding(1) var<uniform> slice: Slice;
@group(0) @binding(2) var<storage, read_write> paths: array<Path>;
@group(0) @binding(3) var<storage, read_write> status: Status;

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    let i = (group.y * groups.x + group.x) * GROUP + lane;
    if (i < slice.count) {
        let sample = paths[i].sample;
        if (paths[i].state == IDLE && sample < slice.samples) {
            paths[i] = seed(sample, primary(corner(slice.first + i), sample, settings.zero));
        }
    }
    if (lane == 0u) {
        atomicAdd(&status.groups, 1u);
    }
}
