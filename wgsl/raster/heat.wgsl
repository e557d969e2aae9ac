// how many faces each tile has -> the color of its pixels
#import "tables/slice.wgsl"
#import "tables/lens.wgsl"
#import "shade/scale.wgsl"

@group(0) @binding(0) var<uniform> lens: Lens;
@group(0) @binding(1) var<storage, read> counts: array<u32>;
@group(0) @binding(2) var<storage, read_write> sums: array<vec4f>;

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    let i = (group.y * groups.x + group.x) * GROUP + lane;
    if (i < lens.width * lens.height) {
        let tile = vec2u(i % lens.width, i / lens.width) / TILE;
        let at = 2u * (tile.y * lens.columns + tile.x);
        sums[i] += vec4f(heat_of(counts[at] + counts[at + 1u]), 1.0);
    }
}
