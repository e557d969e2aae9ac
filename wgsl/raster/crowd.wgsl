// small faces -> how many of them each tile has, beside those of its lists
#import "tables/slice.wgsl"
#import "raster/speck.wgsl"

@group(0) @binding(0) var<uniform> lens: Lens;
// Two numbers a tile; a small face that touches it counts as a piece that does.
@group(0) @binding(4) var<storage, read_write> counts: array<atomic<u32>>;

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    let i = (group.y * groups.x + group.x) * GROUP + lane;
    let s = speck(i);
    if (s.kind == SMALL) {
        let tiles = vec4u(vec2u(s.first), vec2u(s.last)) / TILE;
        for (var row = tiles.y; row <= tiles.w; row++) {
            for (var column = tiles.x; column <= tiles.z; column++) {
                atomicAdd(&counts[2u * (row * lens.columns + column) + 1u], 1u);
            }
        }
    }
}
