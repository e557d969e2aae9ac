// how many pieces each list has -> where it begins, and the tiles that have any
#import "tables/lens.wgsl"
#import "tables/piece.wgsl"

@group(0) @binding(0) var<uniform> lens: Lens;
// Zero again when their sums are taken: the lists are still to be filled.
@group(0) @binding(1) var<storage, read_write> counts: array<u32>;
// One more than there are lists: the last one's end.
@group(0) @binding(2) var<storage, read_write> starts: array<u32>;
@group(0) @binding(3) var<storage, read_write> busy: array<u32>;
@group(0) @binding(4) var<storage, read_write> tally: Tally;

var<workgroup> sums: array<u32, 256>;

// One workgroup: each lane sums a run of tiles, and the runs' sums are scanned (Hillis and Steele).
@compute @workgroup_size(256)
fn main(@builtin(local_invocation_index) lane: u32) {
    let tiles = lens.columns * ((lens.height + TILE - 1u) / TILE);
    let run = (tiles + 255u) / 256u;
    let first = min(lane * run, tiles);
    let last = min(first + run, tiles);
    var sum = 0u;
    var longest = 0u;
    for (var i = first; i < last; i++) {
        let whole = counts[2u * i];
        let touched = counts[2u * i + 1u];
        sum += whole + touched;
        longest = max(longest, max(whole, touched));
    }
    sums[lane] = sum;
    workgroupBarrier();
    for (var step = 1u; step < 256u; step *= 2u) {
        var before = 0u;
        if (lane >= step) {
            before = sums[lane - step];
        }
        workgroupBarrier();
        sums[lane] += before;
        workgroupBarrier();
    }
    var start = sums[lane] - sum;
    for (var i = first; i < last; i++) {
        let whole = counts[2u * i];
        let both = whole + counts[2u * i + 1u];
        starts[2u * i] = start;
        starts[2u * i + 1u] = start + whole;
        start += both;
        counts[2u * i] = 0u;
        counts[2u * i + 1u] = 0u;
        if (both > 0u) {
            busy[atomicAdd(&tally.busy, 1u)] = i;
        }
    }
    atomicMax(&tally.longest, longest);
    if (lane == 255u) {
        starts[2u * tiles] = sums[255];
        tally.entries = sums[255];
    }
}
