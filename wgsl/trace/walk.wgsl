// a ray and the scene -> its nearest hit, or the first that stands in its way
#import "tables/sphere.wgsl"
#import "tables/plane.wgsl"
#import "tables/settings.wgsl"
#import "tables/path.wgsl"
#import "tables/status.wgsl"
#import "tables/texel.wgsl"
#import "trace/meet.wgsl"
#import "trace/solid.wgsl"
#import "trace/boxes.wgsl"

@group(0) @binding(0) var<uniform> settings: Settings;
// Tables in textures: a software adapter reads these four words at a time, and buffers word by word.
@group(0) @binding(1) var nodes: texture_2d<u32>;
// Planes, then the others in the order of the tree.
@group(0) @binding(2) var leaves: texture_2d<u32>;

fn node_at(i: u32) -> Node {
    let a = texel(nodes, i * 5u);
    let b = texel(nodes, i * 5u + 1u);
    let c = texel(nodes, i * 5u + 2u);
    let d = texel(nodes, i * 5u + 3u);
    let e = texel(nodes, i * 5u + 4u);
    return Node(bitcast<vec3f>(a.xyz), a.w, b.x, b.y, b.zw, c.xy, c.zw, d.xy, d.zw, e.xy, e.zw);
}

fn leaf_at(i: u32) -> Leaf {
    let a = texel(leaves, i * 3u);
    let b = texel(leaves, i * 3u + 1u);
    let c = texel(leaves, i * 3u + 2u);
    return Leaf(bitcast<vec3f>(a.xyz), a.w, bitcast<vec3f>(b.xyz), b.w, bitcast<vec3f>(c.xyz), c.w);
}

// Nodes on the longest way from the root down.
const DEEP: u32 = $deep;

// The children of nodes that are still to be asked: where all of a node's begin; a bit for each from bit 24 up, the
// next one the highest; and below bit 8, which of the places hold nodes.
var<private> stack: array<vec2u, DEEP>;

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

const NODES: u32 = 0xff000000u;

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

    let aim = aim_of(ray, settings.low, settings.high);
    let per_length_squared = 1.0 / dot(ray.direction, ray.direction);
    // The number of the hit; nothing wins a tie against the reach of a ray.
    var id = 0u;
    if (walk.hit != NONE) {
        id = leaf_at(walk.hit).id;
    }
    // What of the stack is in hand; the root is the only child of nothing.
    var group = vec2u(0u, select(0u, 0x80000000u, walk.next == settings.planes));
    var size = max(walk.next, settings.planes + 1u) - settings.planes - 1u;
    while (walk.turns < most && !(any && walk.hit != NONE) && (size > 0u || group.y >= 1u << 24u)) {
        if (group.y < 1u << 24u) {
            size -= 1u;
            group = stack[size];
        }
        let bit = firstLeadingBit(group.y);
        group.y ^= 1u << bit;
        if (group.y >= 1u << 24u) {
            if (size < DEEP) {
                stack[size] = group;
                size += 1u;
            } else {
                walk.flags |= STACK_FULL;
            }
        }
        let before = (1u << ((bit - 24u) ^ aim.octant)) - 1u;
        let node = node_at(group.x + countOneBits(group.y & before));
        var met = boxes_met(node, ray, aim, walk.t);
        group = vec2u(node.children, (met & NODES) | (node.steps >> 24u));
        met &= ~NODES;
        walk.turns += 1u;
        while (met != 0u && !(any && walk.hit != NONE)) {
            let i = node.leaves + firstTrailingBit(met);
            met &= met - 1u;
            let leaf = leaf_at(i);
            let t = meet(ray, aim, per_length_squared, leaf, i);
            var nearer = t < walk.t || (t == walk.t && leaf.id < id);
            #repeat pierced
            if (nearer && leaf.kind > PLANE) {
                nearer = is_solid(ray, aim, leaf, any);
            }
            #end
            walk.t = select(walk.t, t, nearer);
            walk.hit = select(walk.hit, i, nearer);
            id = select(id, leaf.id, nearer);
            walk.turns += 1u;
        }
        if (met != 0u && !(any && walk.hit != NONE)) {
            walk.flags |= CUT_SHORT;
        }
    }
    if (walk.turns < most && !(any && walk.hit != NONE) && (size > 0u || group.y >= 1u << 24u)) {
        walk.flags |= CUT_SHORT;
    }
    if (group.y >= 1u << 24u) {
        if (size < DEEP) {
            stack[size] = group;
            size += 1u;
        } else {
            walk.flags |= STACK_FULL;
        }
    }
    walk.next = settings.planes + 1u + size;
    return walk;
}
