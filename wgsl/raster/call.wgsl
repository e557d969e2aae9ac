// what is counted -> how many workgroups the stages have that work on it
#import "tables/slice.wgsl"
#import "tables/piece.wgsl"

@group(0) @binding(0) var<storage, read> late: array<u32>;
@group(0) @binding(1) var<storage, read> pieces: array<Piece>;
@group(0) @binding(2) var<storage, read_write> tally: Tally;
// Columns and rows of workgroups, 1, and nothing: for cut of whole faces and of torn ones, for count and fill, for cover, for shade and
// ground.
@group(0) @binding(3) var<storage, read_write> calls: array<vec4u>;

const MOST_GROUPS: u32 = 65535u;

// In two dimensions, since one holds no more than MOST_GROUPS.
fn fold(groups: u32) -> vec4u {
    return vec4u(min(groups, MOST_GROUPS), (groups + MOST_GROUPS - 1u) / MOST_GROUPS, 1u, 0u);
}

@compute @workgroup_size(1)
fn main() {
    let whole = atomicLoad(&tally.late[0]);
    let torn = atomicLoad(&tally.late[1]);
    // A list without room has torn faces among the whole ones: nothing is cut of it.
    let fits = whole + torn <= arrayLength(&late);
    let sorted = min(atomicLoad(&tally.pieces), arrayLength(&pieces));
    calls[0] = fold(select(0u, (whole + GROUP - 1u) / GROUP, fits));
    calls[1] = fold(select(0u, (torn + GROUP - 1u) / GROUP, fits));
    calls[2] = fold((sorted + GROUP - 1u) / GROUP);
    calls[3] = fold(atomicLoad(&tally.busy));
    calls[4] = fold(atomicLoad(&tally.shown));
    calls[5] = fold(atomicLoad(&tally.bare));
    // Work that is killed takes all that comes after it along: who counts last has seen the rest done.
    atomicAdd(&tally.groups, 1u);
}
