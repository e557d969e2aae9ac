// the lists of each tile -> the nearest of its pixels, and the least id of those
#import "raster/pixels.wgsl"
#import "tables/piece.wgsl"
#import "tables/settings.wgsl"

@group(0) @binding(0) var<uniform> lens: Lens;
@group(0) @binding(1) var<storage, read> pieces: array<Piece>;
@group(0) @binding(2) var<storage, read> starts: array<u32>;
@group(0) @binding(3) var<storage, read> entries: array<u32>;
@group(0) @binding(4) var<storage, read> busy: array<u32>;
// Of a pixel: for an eye NONE less the id, and then the nearness.
@group(0) @binding(5) var<storage, read_write> image: array<u32>;
@group(0) @binding(6) var<storage, read_write> tally: Tally;

#if eye
const WORDS: u32 = 2u;
#else
const WORDS: u32 = 1u;
#end
// Plans that are made at a time, one by each lane, and then drawn by all.
#if subgroups
const BATCH: u32 = $batch;
#else
const BATCH: u32 = LANES;
#end

fn plan_of(entry: u32, origin: vec2i) -> Plan {
    let piece = pieces[entries[entry]];
    return plan(piece.a, piece.b, piece.c, origin);
}

fn id_of(entry: u32) -> u32 {
    return NONE - pieces[entries[entry]].id;
}

// The words of a pixel, if it is on the film.
fn word_at(pixel: vec2u) -> u32 {
    return select(NONE, lens.first + (pixel.y * lens.width + pixel.x) * WORDS, all(pixel < vec2u(lens.width, lens.height)));
}

fn load(at: u32) -> vec2u {
    if (at == NONE) {
        return vec2u(0u);
    }
#if eye
    return vec2u(image[at + 1u], image[at]);
#else
    return vec2u(image[at], 0u);
#end
}

fn store(at: u32, near: u32, id: u32) {
    if (at != NONE) {
#if eye
        image[at] = id;
        image[at + 1u] = near;
#else
        image[at] = near;
#end
    }
}

fn load_pair(pixel: vec2u) -> Pair {
    let p = load(word_at(pixel));
    let q = load(word_at(pixel + vec2u(1u, 0u)));
    return Pair(vec2u(p.x, q.x), vec2u(p.y, q.y));
}

fn store_pair(pixel: vec2u, pair: Pair) {
    store(word_at(pixel), pair.near.x, pair.id.x);
    store(word_at(pixel + vec2u(1u, 0u)), pair.near.y, pair.id.y);
}

#if subgroups
#else
var<workgroup> plans: array<Plan, BATCH>;
var<workgroup> ids: array<u32, BATCH>;
#end

// One workgroup owns a tile, and each lane some of its pixels: nobody else writes them.
@compute @workgroup_size(LANES)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
#if subgroups
    @builtin(subgroup_invocation_id) seat: u32,
#end
) {
    // The last row of workgroups may be longer than there are tiles: what they then draw again stays what it is.
    let number = min(group.y * groups.x + group.x, arrayLength(&busy) - 1u);
    let tile_number = min(busy[number], arrayLength(&starts) / 2u - 1u);
    let tile = vec2u(tile_number % lens.columns, tile_number / lens.columns);
    let origin = vec2i(tile * TILE);
    let here = vec2i(vec2u(lane % 8u * 2u, lane / 8u));
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
    px.row_$i = load_pair(pixel + vec2u(0u, $iu * u32(STRIDE)));
#end
#if subgroups
    for (var batch = whole_first; batch < whole_last; batch += BATCH) {
        // The last ones may be drawn more than once, which shows nowhere.
        let entry = min(batch + seat % BATCH, whole_last - 1u);
        let d = plan_of(entry, origin).depths;
        let id = id_of(entry);
#repeat batch
        put_whole(
            &px, here,
            Depths(
                subgroupBroadcast(d.zx, $iu), subgroupBroadcast(d.zy, $iu), subgroupBroadcast(d.z, $iu),
                subgroupBroadcast(d.low, $iu), subgroupBroadcast(d.high, $iu), subgroupBroadcast(d.most, $iu),
            ),
            subgroupBroadcast(id, $iu),
        );
#end
    }
    for (var batch = some_first; batch < some_last; batch += BATCH) {
        let entry = min(batch + seat % BATCH, some_last - 1u);
        let p = plan_of(entry, origin);
        let d = p.depths;
        let id = id_of(entry);
#repeat batch
        put_some(
            &px, here,
            Plan(
                subgroupBroadcast(p.a, $iu), subgroupBroadcast(p.b, $iu), subgroupBroadcast(p.e, $iu),
                Depths(
                    subgroupBroadcast(d.zx, $iu), subgroupBroadcast(d.zy, $iu), subgroupBroadcast(d.z, $iu),
                    subgroupBroadcast(d.low, $iu), subgroupBroadcast(d.high, $iu), subgroupBroadcast(d.most, $iu),
                ),
            ),
            subgroupBroadcast(id, $iu),
        );
#end
    }
#else
    for (var batch = whole_first; batch < whole_last; batch += BATCH) {
        let full = min(BATCH, whole_last - batch);
        if (lane < full) {
            plans[lane] = plan_of(batch + lane, origin);
            ids[lane] = id_of(batch + lane);
        }
        workgroupBarrier();
        for (var k = 0u; k < full; k++) {
            put_whole(&px, here, plans[k].depths, ids[k]);
        }
        workgroupBarrier();
    }
    for (var batch = some_first; batch < some_last; batch += BATCH) {
        let full = min(BATCH, some_last - batch);
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
    store_pair(pixel + vec2u(0u, $iu * u32(STRIDE)), px.row_$i);
#end
    if (lane == 0u) {
        atomicAdd(&tally.groups, 1u);
    }
}
