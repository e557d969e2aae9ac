// a face -> a triangle so small that 32 bits hold its edges, or what else becomes of it
#import "tables/piece.wgsl"
#import "tables/mesh.wgsl"
#import "raster/hold.wgsl"
#import "raster/facet.wgsl"

@group(0) @binding(1) var<uniform> part: Part;
@group(0) @binding(2) var corners: Table;

#if lace
// Cut-out faces alone, none of which is drawn at once.
const LACE: bool = true;
#else
const LACE: bool = false;
#end

const NOTHING: u32 = 0u;
const SMALL: u32 = 1u;
// It is large.
const LATE: u32 = 2u;
// It crosses a plane.
const TORN: u32 = 3u;

// The number of a workgroup's faces: those from the middle on are drawn backwards. A software adapter gives each thread
// a run of workgroups, and two that draw the same pixels at a time, one layer behind the other, wait for each other.
fn turn_of(group: vec3u, groups: vec3u) -> u32 {
    let number = group.y * groups.x + group.x;
    let count = groups.x * groups.y;
    return select(number, count + count / 2u - 1u - number, number >= count / 2u);
}

struct Speck {
    kind: u32,
    // First and last pixel of its bounding box on the film, if it is small; the plan is seen from the first.
    first: vec2i,
    last: vec2i,
    plan: Plan,
}

// The edge from p to q, as seen from (0, 0) in 1/256 pixel: the same numbers as `edge`, while they are small.
fn small_edge(p: vec2i, q: vec2i) -> vec3i {
    let a = p.y - q.y;
    let b = q.x - p.x;
    return vec3i(a, b, (select(-1, 0, owned(a, b)) - (a * p.x + b * p.y)) >> 8u);
}

fn corner_at(i: u32) -> Corner {
    let row = texel(corners, i);
    return Corner(bitcast<vec3i>(row.xyz), row.w);
}

// One straight line without a branch, and under none: lavapipe runs both sides of each, and there reads uniforms lane by
// lane. Beyond the last face there is nothing.
fn speck(i: u32) -> Speck {
    let face = face_at(min(i, part.faces - 1u));
    let ca = corner_at(face.a);
    let cb = corner_at(face.b);
    let cc = corner_at(face.c);
    let p = ca.at;
    let whole = span(p, cb.at, cc.at);
    let bounds = on_film(whole);
    let size = whole.zw - whole.xy;
    let crosses = (ca.code | cb.code | cc.code) != 0u;
    let on_film = bounds.x <= bounds.z && bounds.y <= bounds.w;
    let large = max(size.x, size.y) >= i32(lens.small);

    let u = cb.at.xy - p.xy;
    let v = cc.at.xy - p.xy;
    let turn = u.x * v.y - u.y * v.x;
    let q = select(cb.at, cc.at, turn < 0);
    let r = select(cc.at, cb.at, turn < 0);
    let there = (turn < 0) | ((turn > 0) & !one_sided(face.paint));
    let center = bounds.xy * 256 + vec2i(128);
    let pq = small_edge(p.xy - center, q.xy - center);
    let qr = small_edge(q.xy - center, r.xy - center);
    let rp = small_edge(r.xy - center, p.xy - center);
    let nears = nears_of(p, q, r, f32(abs(turn)), bounds.xy);
    let plan = Plan(vec3i(pq.x, qr.x, rp.x), vec3i(pq.y, qr.y, rp.y), vec3i(pq.z, qr.z, rp.z), nears);

    let small = select(NOTHING, select(SMALL, LATE, LACE), there && on_film);
    let whole_kind = select(small, select(NOTHING, LATE, on_film), large);
    let beyond = (ca.code & cb.code & cc.code) != 0u;
    let seen = select(whole_kind, select(TORN, NOTHING, beyond), crosses);
    let kind = select(NOTHING, seen, (i < part.faces) & (((face.paint & CUT_OUT) != 0u) == LACE));
    return Speck(kind, bounds.xy, select(bounds.xy, bounds.zw, kind == SMALL), plan);
}

// Which of 8 x 8 pixels are covered, the first of them so far from the speck's own: bit 8 * y + x, 32 in each word.
//
// The loop ends at its end: lavapipe runs a loop's body once more when the last lane has left from its head.
fn covered(s: Speck, block: vec2i) -> vec2u {
    var bits = vec2u(0u);
    var row = s.plan.e + s.plan.a * block.x + s.plan.b * block.y;
    let left = s.last - s.first - block;
    let columns = (2u << u32(min(left.x, 7))) - 1u;
    let last = min(left.y, 7);
    // What each edge must be on a row's first pixel, that the row's pixel is within it.
#repeat columns
    let least_$i = s.plan.a * -$i;
#end
    var y = 0;
    loop {
        var here = 0u;
#repeat columns
        here |= select(0u, 1u << $iu, all(row >= least_$i));
#end
        row += s.plan.b;
        here = (here & columns) << u32((y & 3) * 8);
        bits |= select(vec2u(0u, here), vec2u(here, 0u), y < 4);
        y++;
        continuing {
            break if y > last;
        }
    }
    return select(vec2u(0u), bits, s.kind == SMALL);
}

// The 8 x 8 pixels after these, along the row and then on the next.
fn after(s: Speck, block: vec2i) -> vec2i {
    let ends = block.x + 8 > s.last.x - s.first.x;
    return select(block + vec2i(8, 0), vec2i(0, block.y + 8), ends);
}

// The first of the covered ones, as (x, y).
fn first_of(bits: vec2u) -> vec2i {
    let low = bits.x != 0u;
    let k = i32(firstTrailingBit(select(bits.y, bits.x, low)));
    return vec2i(k & 7, (k >> 3u) + select(4, 0, low));
}

// All but the first.
fn rest_of(bits: vec2u) -> vec2u {
    return vec2u(bits.x & (bits.x - 1u), select(bits.y & (bits.y - 1u), bits.y, bits.x != 0u));
}
