// a walk's nodes with children still to be asked -> the last of them, taken up again
#import "tables/status.wgsl"

// Nodes on the longest way from the root down.
const DEEP: u32 = $deep;
// Places for what is to be asked: where there are instances, the last says in which of them the walk is.
const ROOM: u32 = DEEP - u32($copies);

// The children of nodes that are still to be asked: where a node's places begin; and a bit for each of them, at `place ^
// octant`. Or instances that are still to be asked: where a node's leaves begin, with INSTANCES, and a bit for each.
var<private> stack: array<vec2u, DEEP>;

const INSTANCES: u32 = 0x80000000u;

// Whether there is anything left to ask.
fn is_open(group: vec2u) -> bool {
    return group.y != 0u;
}

// Keeps what is left of a group for later; how much is on the stack then.
fn put(group: vec2u, size: u32, walk: ptr<function, Walk>) -> u32 {
    let fits = is_open(group) && size < ROOM;
    if (fits) {
        stack[size] = group;
    }
    (*walk).flags |= select(0u, STACK_FULL, is_open(group) && !fits);
    return size + select(0u, 1u, fits);
}
