// the lists of each tile -> the nearest of its pixels, and the least id of those
#import "raster/pixels.wgsl"
#import "tables/piece.wgsl"
#import "tables/settings.wgsl"

@group(0) @binding(0) var<uniform> lens: Lens;
@group(0) @binding(1) var<storage, read> pieces: array<Piece>;
@group(0) @binding(2) var<storage, read> starts: array<u32>;
@group(0) @binding(3) var<storage, read> entries: array<u32>;
@group(0) @binding(4) var<storage, read> busy: array<u32>;
@group(0) @binding(6) var<storage, read_write> tally: Tally;

fn plan_of(entry: u32, origin: vec2i) -> Plan {
    let piece = pieces[entries[entry]];
    return plan(piece.a, piece.b, piece.c, origin);
}

fn id_of(entry: u32) -> u32 {
    return NONE - pieces[entries[entry]].id;
}

#if subgroups
// What a lane of the subgroup has planned.
fn nears_of_seat(n: Nears, k: u32) -> Nears {
    return Nears(
        subgroupShuffle(n.x, k), subgroupShuffle(n.y, k), subgroupShuffle(n.at, k),
        subgroupShuffle(n.least, k), subgroupShuffle(n.most, k),
    );
}

fn plan_of_seat(p: Plan, k: u32) -> Plan {
    return Plan(
        subgroupShuffle(p.a, k), subgroupShuffle(p.b, k), subgroupShuffle(p.e, k), nears_of_seat(p.nears, k),
    );
}
#else
var<workgroup> plans: array<Plan, LANES>;
var<workgroup> ids: array<u32, LANES>;
#end

// One workgroup owns a tile, and each lane some of its pixels: nobody else writes them.
@compute @workgroup_size(LANES)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
#if subgroups
    @builtin(subgroup_invocation_id) seat: u32,
    @builtin(subgroup_size) seats: u32,
#end
) {
    // The last row of workgroups may be longer than there are tiles: what they then draw again stays what it is.
    let number = min(group.y * groups.x + group.x, arrayLength(&busy) - 1u);
    let tile_number = min(busy[number], arrayLength(&starts) / 2u - 1u);
    let tile = vec2u(tile_number % lens.columns, tile_number / lens.columns);
    let origin = vec2i(tile * TILE);
    let here = vec2i(vec2u(lane % 4u * 4u, lane / 4u));
    let pixel = tile * TILE + vec2u(here);
    let limit = arrayLength(&entries);
    let begin = starts[2u * tile_number];
    let middle = starts[2u * tile_number + 1u];
    let end = starts[2u * tile_number + 2u];
    let skip = lens.round * MOST_ENTRIES;
    let whole_first = min(begin + skip, middle);
    let whole_last = min(min(whole_first + MOST_ENTRIES, middle), limit);
    let some_first = min(middle + skip, end);
    let some_last = min(min(some_first + MOST_ENTRIES, end), limit);

    var px: Pixels;
#repeat rows
    px.row_$i = load_quad(pixel + vec2u(0u, $iu * u32(STRIDE)));
#end
#if subgroups
    // Plans are made at a time, one by each lane, and then drawn by all. A plan of nothing is never nearer, so that each
    // loop may end at its end: lavapipe runs its body once more after a break at its head.
    let size = min(seats, LANES);
    var batch = whole_first;
    loop {
        var n: Nears;
        var id = 0u;
        if (batch + seat < whole_last) {
            n = plan_of(batch + seat, origin).nears;
            id = id_of(batch + seat);
        }
        let next = min(batch + size, whole_last);
        var k = 0u;
        loop {
            put_whole(&px, here, nears_of_seat(n, k), subgroupShuffle(id, k));
            k++;
            continuing {
                break if batch + k >= next;
            }
        }
        batch = next;
        continuing {
            break if batch >= whole_last;
        }
    }
    batch = some_first;
    loop {
        var p: Plan;
        var id = 0u;
        if (batch + seat < some_last) {
            p = plan_of(batch + seat, origin);
            id = id_of(batch + seat);
        }
        let next = min(batch + size, some_last);
        var k = 0u;
        loop {
            put_some(&px, here, plan_of_seat(p, k), subgroupShuffle(id, k));
            k++;
            continuing {
                break if batch + k >= next;
            }
        }
        batch = next;
        continuing {
            break if batch >= some_last;
        }
    }
#else
    for (var batch = whole_first; batch < whole_last; batch += LANES) {
        let full = min(LANES, whole_last - batch);
        if (lane < full) {
            plans[lane] = plan_of(batch + lane, origin);
            ids[lane] = id_of(batch + lane);
        }
        workgroupBarrier();
        for (var k = 0u; k < full; k++) {
            put_whole(&px, here, plans[k].nears, ids[k]);
        }
        workgroupBarrier();
    }
    for (var batch = some_first; batch < some_last; batch += LANES) {
        let full = min(LANES, some_last - batch);
        if (lane < full) {
            plans[lane] = plan_of(batch + lane, origin);
            ids[lane] = id_of(batch + lane);
        }
        workgroupBarrier();
        for (var k = 0u; k < full; k++) {
            put_some(&px, here, plans[k], ids[k]);
        }
        workgroupBarrier();
    }
#end
#repeat rows
    store_quad(pixel + vec2u(0u, $iu * u32(STRIDE)), px.row_$i);
#end
    if (lane == 0u) {
        atomicAdd(&tally.groups, 1u);
    }
}
