// the list of each tile -> the least (depth, id) of its pixels
#import "raster/plan.wgsl"
#import "tables/piece.wgsl"
#import "tables/settings.wgsl"

@group(0) @binding(0) var<uniform> lens: Lens;
@group(0) @binding(1) var<storage, read> pieces: array<Piece>;
@group(0) @binding(2) var<storage, read> starts: array<u32>;
@group(0) @binding(3) var<storage, read> counts: array<u32>;
@group(0) @binding(4) var<storage, read> entries: array<u32>;
@group(0) @binding(5) var<storage, read_write> depths: array<u32>;
// Too short for any pixel where ids are not wanted.
@group(0) @binding(6) var<storage, read_write> ids: array<u32>;
@group(0) @binding(7) var<storage, read_write> tally: Tally;

const BATCH: u32 = 64u;

var<workgroup> plans: array<Plan, 64>;
var<workgroup> plan_ids: array<u32, 64>;

// One workgroup owns a tile, and each lane a pixel: nobody else writes it.
@compute @workgroup_size(256)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    let number = group.y * groups.x + group.x;
    let tile = vec2u(number % lens.columns, number / lens.columns);
    let here = vec2u(lane % TILE, lane / TILE);
    let pixel = tile * TILE + here;
    let on_film = pixel.x < lens.width && pixel.y < lens.height;
    let at = pixel.y * lens.width + pixel.x;
    let list_end = starts[number] + counts[number];
    let first = min(starts[number] + lens.round * MOST_ENTRIES, list_end);
    let last = min(first + MOST_ENTRIES, list_end);

    var depth = NO_DEPTH;
    var id = NONE;
    if (on_film && first < last) {
        depth = depths[lens.first + at];
        if (at < arrayLength(&ids)) {
            id = ids[at];
        }
    }
    for (var batch = first; batch < last; batch += BATCH) {
        let full = min(BATCH, last - batch);
        if (lane < full) {
            let piece = pieces[entries[batch + lane]];
            plans[lane] = plan(piece.a, piece.b, piece.c, vec2i(tile * TILE));
            plan_ids[lane] = piece.id;
        }
        workgroupBarrier();
        for (var k = 0u; k < full; k++) {
            let e = plans[k].e + plans[k].a * i32(here.x) + plans[k].b * i32(here.y);
            if ((e.x | e.y | e.z) >= 0) {
                let d = depth_at(plans[k], i32(here.x), i32(here.y));
                if (d < depth || (d == depth && plan_ids[k] < id)) {
                    depth = d;
                    id = plan_ids[k];
                }
            }
        }
        workgroupBarrier();
    }
    if (on_film && first < last) {
        depths[lens.first + at] = depth;
        if (at < arrayLength(&ids)) {
            ids[at] = id;
        }
    }
    if (lane == 0u) {
        atomicAdd(&tally.groups, 1u);
    }
}
