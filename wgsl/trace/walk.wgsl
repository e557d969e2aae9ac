// a ray and the scene -> its nearest hit, or the first that stands in its way
#import "tables/sphere.wgsl"
#import "tables/plane.wgsl"
#import "tables/settings.wgsl"
#import "tables/path.wgsl"
#import "tables/status.wgsl"
#import "tables/texel.wgsl"
#import "trace/meet.wgsl"
#import "trace/seat.wgsl"
#import "trace/solid.wgsl"
#import "trace/triangle.wgsl"
#import "trace/boxes.wgsl"
#import "trace/instanced.wgsl"
#import "trace/stack.wgsl"

@group(0) @binding(0) var<uniform> settings: Settings;
// Tables in textures: a software adapter reads these four words at a time, and buffers word by word.
@group(0) @binding(1) var nodes: Table;
// Planes, then the others in the order of the tree.
@group(0) @binding(2) var leaves: Table;

fn node_at(i: u32) -> Node {
    let begin = begin_of(i, 5u);
    let a = texel_at(nodes, begin, 0u);
    let b = texel_at(nodes, begin, 1u);
    let c = texel_at(nodes, begin, 2u);
    let d = texel_at(nodes, begin, 3u);
    let e = texel_at(nodes, begin, 4u);
    return Node(bitcast<vec3f>(a.xyz), a.w, b.x, b.y, b.z, b.w, c.xy, c.zw, d.xy, d.zw, e.xy, e.zw);
}

fn leaf_at(i: u32) -> Leaf {
    let begin = begin_of(i, 3u);
    let a = texel_at(leaves, begin, 0u);
    let b = texel_at(leaves, begin, 1u);
    let c = texel_at(leaves, begin, 2u);
    return Leaf(bitcast<vec3f>(a.xyz), a.w, bitcast<vec3f>(b.xyz), b.w, bitcast<vec3f>(c.xyz), c.w);
}

// Where a walk is, and what it has found.
struct Walk {
    // Only what is nearer than this counts; the distance to the hit once there is one.
    t: f32,
    // The leaf, or NONE; of two at one distance the one whose number is lower.
    hit: u32,
    // See Path.
    next: u32,
    // Steps taken: a node or a primitive asked is one.
    turns: u32,
    // CUT_SHORT and STACK_FULL.
    flags: u32,
}

fn over(walk: Walk, any: bool) -> bool {
    return walk.next == settings.planes + 1u || (any && walk.hit != NONE);
}

fn meet(ray: Ray, aim: Aim, per_length_squared: f32, leaf: Leaf, i: u32) -> f32 {
    #repeat spheres_below
    if (leaf.kind == SPHERE) {
        let sphere = Sphere(leaf.a, leaf.b.x, 0u, 0u, vec2u(0u));
        return meet_sphere(ray, sphere, per_length_squared, ray.leaves == i);
    }
    #end
    return select(meet_triangle(ray, leaf, aim), FAR, ray.leaves == i);
}

// Nodes in a row, at most, before the lanes that have found primitives ask them, while others are still looking for
// some: a software adapter goes through the loop over primitives even where no lane has any.
const IN_A_ROW: u32 = 4u;

// Goes on from `start` until `most` steps are taken, or a few more: all primitives of a node are asked in one go.
// With `any`, stops at the first that is met.
fn walk(ray: Ray, start: Walk, most: u32, any: bool) -> Walk {
    var walk = start;
    while (walk.next < settings.planes && walk.turns < most && !(any && walk.hit != NONE)) {
        let i = walk.next;
        let leaf = leaf_at(i);
        let t = meet_plane(ray, Plane(leaf.a, 0u, leaf.b, 0u));
        if (t < walk.t && ray.leaves != i) {
            walk.t = t;
            walk.hit = i;
        }
        walk.next = i + 1u;
        walk.turns += 1u;
    }
    if (walk.next < settings.planes) {
        if (walk.turns < most && !(any && walk.hit != NONE)) {
            walk.flags |= CUT_SHORT;
        }
        return walk;
    }

    var seat = in_world(ray);
    // The instance that the walk is in, or NONE, and how much of the stack is the world's then.
    var within = NONE;
    var base = 0u;
    // The number of the hit; nothing wins a tie against the reach of a ray.
    var id = 0u;
    if (walk.hit != NONE) {
        id = primitive_at(walk.hit).leaf.id;
    }
    // What of the stack is in hand; the root is the only child of nothing, in place 0.
    var group = vec2u(0u, select(0u, 1u << seat.aim.octant, walk.next == settings.planes));
    var size = max(walk.next, settings.planes + 1u) - settings.planes - 1u;
    #repeat copies
    if (size > 0u) {
        within = stack[ROOM].x;
        base = stack[ROOM].y;
    }
    var entered = within;
    #end
    while (walk.turns < most && !(any && walk.hit != NONE) && (size > 0u || is_open(group))) {
        // The first of a node's primitives, which there are, and which of those are to be asked.
        var first = 0u;
        var held = 0u;
        var met = 0u;
        var nodes = 0u;
        loop {
            #repeat copies
            if (within != NONE && size == base && !is_open(group)) {
                // Back to the world.
                within = NONE;
                entered = NONE;
                seat = in_world(ray);
            }
            #end
            let closed = !is_open(group);
            size -= select(0u, 1u, closed);
            if (closed) {
                group = stack[size];
            }
            #repeat copies
            if (group.x >= INSTANCES) {
                // The next of some instances.
                within = leaf_at((group.x ^ INSTANCES) + firstTrailingBit(group.y)).material;
                group.y &= group.y - 1u;
                size = put(group, size, &walk);
                base = size;
                entered = within;
                group = vec2u(instance_at(within).root, 0u);
            }
            if (entered != NONE) {
                seat = in_instance(ray, entered);
                entered = NONE;
                // Its root, the only child of nothing, unless the walk goes on within.
                group.y = select(group.y, 1u << seat.aim.octant, !is_open(group));
            }
            #end
            let first_bit = firstLeadingBit(group.y);
            group.y ^= 1u << first_bit;
            let node = node_at(group.x + (first_bit ^ seat.aim.octant));
            met = boxes_met(node, seat.ray, seat.aim, walk.t);
            // What is left of a group stays in hand, unless there is more below.
            let below = met >> 24u;
            if (below != 0u) {
                size = put(group, size, &walk);
                group = vec2u(node.children, below);
            }
            met &= 0x00ffffffu;
            first = node.leaves;
            held = node.held;
            walk.turns += 1u;
            nodes += 1u;
            continuing {
                break if met != 0u || nodes == IN_A_ROW || walk.turns >= most || !(size > 0u || is_open(group));
            }
        }
        // Those of the primitives that are instances.
        var later = 0u;
        while (met != 0u && !(any && walk.hit != NONE)) {
            let place = countOneBits(held & ~met & (met - 1u));
            let i = first + place;
            met &= met - 1u;
            let leaf = leaf_at(i);
            walk.turns += 1u;
            #repeat copies
            if (leaf.kind == INSTANCE) {
                later |= 1u << place;
                continue;
            }
            #end
            let t = meet(seat.ray, seat.aim, seat.per_length_squared, leaf, i + seat.numbers);
            var nearer = t < walk.t || (t == walk.t && leaf.id + seat.ids < id);
            #repeat pierced
            if (nearer && leaf.kind > PLANE) {
                nearer = is_solid(seat.ray, seat.aim, leaf, leaf.id + seat.faces, leaf.material + seat.materials, any);
            }
            #end
            walk.t = select(walk.t, t, nearer);
            walk.hit = select(walk.hit, i + seat.numbers, nearer);
            id = select(id, leaf.id + seat.ids, nearer);
        }
        if (met != 0u && !(any && walk.hit != NONE)) {
            walk.flags |= CUT_SHORT;
        }
        #repeat copies
        if (later != 0u) {
            size = put(group, size, &walk);
            group = vec2u(first | INSTANCES, later);
        }
        #end
    }
    if (walk.turns < most && !(any && walk.hit != NONE) && (size > 0u || is_open(group))) {
        walk.flags |= CUT_SHORT;
    }
    size = put(group, size, &walk);
    #repeat copies
    stack[ROOM] = vec2u(within, base);
    #end
    walk.next = settings.planes + 1u + size;
    return walk;
}
