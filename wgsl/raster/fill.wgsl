// pieces -> the list of each tile, in any order
#import "tables/slice.wgsl"
#import "raster/reach.wgsl"

@group(0) @binding(0) var<uniform> lens: Lens;
@group(0) @binding(1) var<storage, read> pieces: array<Piece>;
@group(0) @binding(2) var<storage, read> starts: array<u32>;
// How much of each list is filled so far.
@group(0) @binding(3) var<storage, read_write> counts: array<atomic<u32>>;
@group(0) @binding(4) var<storage, read_write> entries: array<u32>;
@group(0) @binding(5) var<storage, read_write> tally: Tally;

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    let number = (group.y * groups.x + group.x) * GROUP + lane;
    let i = number / SHARE;
    if (i < lens.pieces) {
        let piece = pieces[i];
        let under = tiles_of(piece);
        let columns = under.z - under.x + 1u;
        let all = columns * (under.w - under.y + 1u);
        for (var k = number % SHARE; k < all; k += SHARE) {
            let tile = under.xy + vec2u(k % columns, k / columns);
            if (touches(piece, tile)) {
                let number = tile.y * lens.columns + tile.x;
                entries[starts[number] + atomicAdd(&counts[number], 1u)] = i;
            }
        }
    }
    if (lane == 0u) {
        atomicAdd(&tally.groups, 1u);
    }
}
