// pieces -> how many of them each list has
#import "tables/slice.wgsl"
#import "raster/reach.wgsl"

@group(0) @binding(0) var<uniform> lens: Lens;
@group(0) @binding(1) var<storage, read> pieces: array<Piece>;
@group(0) @binding(2) var<storage, read_write> counts: array<atomic<u32>>;
@group(0) @binding(3) var<storage, read_write> tally: Tally;

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    let i = (group.y * groups.x + group.x) * GROUP + lane;
    if (i < min(atomicLoad(&tally.pieces), arrayLength(&pieces))) {
        let piece = pieces[i];
        let r = reach(piece);
        for (var tile = r.tiles.xy; tile.y <= r.tiles.w; tile = after(r, tile)) {
            let way = how(r, tile, TILE);
            if (way != MISSED) {
                atomicAdd(&counts[list_of(piece, tile, way)], 1u);
            }
        }
    }
}
