// a walk's nodes with children still to be asked -> the last of them, taken up again
#import "tables/status.wgsl"

// Nodes on the longest way from the root down.
const DEEP: u32 = $deep;
// Places for what is to be asked: where there are instances, the last says in which of them the walk is.
const ROOM: u32 = DEEP - u32($copies);

// The children of nodes that are still to be asked: where all of a node's begin; a bit for each from bit 24 up; and
// below bit 8, which of the places hold nodes. Or instances that are still to be asked: where a node's leaves begin, with
// INSTANCES, and a bit for each.
var<private> stack: array<vec2u, DEEP>;

// The children that are nodes, and the primitives of the others.
const NODES: u32 = 0xff000000u;
const PRIMITIVES: u32 = 0x00ffffffu;
const INSTANCES: u32 = 0x80000000u;

// Whether there is anything left to ask.
fn is_open(group: vec2u) -> bool {
    var open = group.y >= 1u << 24u;
    #repeat copies
    open = open || (group.x >= INSTANCES && group.y != 0u);
    #end
    return open;
}

// The place of the child that is asked first, of a group of nodes: the one whose `place ^ octant` is the highest.
fn first_of(group: vec2u, octant: u32) -> u32 {
    var x = group.y & NODES;
    x = select(x, ((x & 0x55000000u) << 1u) | ((x >> 1u) & 0x55000000u), (octant & 1u) != 0u);
    x = select(x, ((x & 0x33000000u) << 2u) | ((x >> 2u) & 0x33000000u), (octant & 2u) != 0u);
    x = select(x, (x << 4u) | ((x >> 4u) & 0x0f000000u), (octant & 4u) != 0u);
    return (firstLeadingBit(x) - 24u) ^ octant;
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
