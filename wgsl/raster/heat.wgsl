// how many faces each tile has -> the color of its pixels
#import "tables/slice.wgsl"
#import "tables/lens.wgsl"

@group(0) @binding(0) var<uniform> lens: Lens;
@group(0) @binding(1) var<storage, read> counts: array<u32>;
@group(0) @binding(2) var<storage, read_write> sums: array<vec4f>;

// None, 1, 2 and 3, and so on: each begins at twice the number of the one before, and the last has no end.
const HEATS = array<vec3f, 12>(
    vec3f(0.0, 0.0, 0.0),
    vec3f(0.01, 0.01, 0.06),
    vec3f(0.02, 0.03, 0.2),
    vec3f(0.03, 0.1, 0.5),
    vec3f(0.02, 0.3, 0.6),
    vec3f(0.02, 0.45, 0.3),
    vec3f(0.15, 0.6, 0.05),
    vec3f(0.6, 0.7, 0.02),
    vec3f(0.9, 0.45, 0.02),
    vec3f(0.9, 0.15, 0.02),
    vec3f(0.7, 0.02, 0.15),
    vec3f(1.0, 0.75, 0.9),
);

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
        let doublings = 32u - countLeadingZeros(counts[at] + counts[at + 1u]);
        var heats = HEATS;
        sums[i] += vec4f(heats[min(doublings, 11u)], 1.0);
    }
}
