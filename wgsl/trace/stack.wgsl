// a walk's nodes with children still to be asked -> the last of them, taken up again
#import "tables/status.wgsl"

// Nodes on the longest way from the root down.
const DEEP: u32 = $deep;
// Places for what is to be asked: where there are instances, the last says in which of them the walk is.
const ROOM: u32 = DEEP - u32($copies);

// The children of nodes that are still to be asked: where all of a node's begin; a bit for each from bit 24 up, the
// next one the highest; and below bit 8, which of the places hold nodes. Or instances that are still to be asked: where
// a node's leaves begin, with INSTANCES, and a bit for each.
var<private> stack: array<vec2u, DEEP>;

const NODES: u32 = 0xff000000u;
const INSTANCES: u32 = 0x80000000u;

// Whether there is anything left to ask.
fn is_open(group: vec2u) -> bool {
    var open = group.y >= 1u << 24u;
    #repeat copies
    open = open || (group.x >= INSTANCES && group.y != 0u);
    #end
    return open;
}

// The group in hand, or what lies at a place of the stack. On a processor an index of each lane's own is followed lane
// by lane: where there are few places, each is asked instead whether it is the one.
fn in_hand(group: vec2u, closed: bool, place: u32) -> vec2u {
    var next = group;
#if shallow
    #repeat deep
    next = select(next, stack[$i], closed && place == $iu);
    #end
#else
    if (closed) {
        next = stack[place];
    }
#end
    return next;
}

// Keeps what is left of a group for later; how much is on the stack then.
fn put(group: vec2u, size: u32, walk: ptr<function, Walk>) -> u32 {
    let fits = is_open(group) && size < ROOM;
#if shallow
    // What is not open too: the next one will lie over it.
    #repeat deep
    stack[$i] = select(stack[$i], group, size == $iu);
    #end
#else
    if (fits) {
        stack[size] = group;
    }
#end
    (*walk).flags |= select(0u, STACK_FULL, is_open(group) && !fits);
    return size + select(0u, 1u, fits);
}
