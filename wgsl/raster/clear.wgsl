// nothing -> words that are larger than any depth and any id
#import "tables/slice.wgsl"

@group(0) @binding(0) var<storage, read_write> words: array<u32>;

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    let i = (group.y * groups.x + group.x) * GROUP + lane;
    if (i < arrayLength(&words)) {
        words[i] = 0xffffffffu;
    }
}
