// the lists of each tile -> the nearest of its pixels where a cut-out face is there, and the least id of those
#import "raster/plan.wgsl"
#import "raster/weights.wgsl"
#import "shade/look.wgsl"
#import "tables/piece.wgsl"
#import "tables/settings.wgsl"

@group(0) @binding(0) var<uniform> lens: Lens;
@group(0) @binding(2) var<uniform> part: Part;
@group(0) @binding(3) var<storage, read> pieces: array<Piece>;
@group(0) @binding(4) var<storage, read> starts: array<u32>;
@group(0) @binding(5) var<storage, read> entries: array<u32>;
@group(0) @binding(6) var<storage, read> busy: array<u32>;
// Of a pixel: for an eye NONE less the id, and then the nearness.
@group(0) @binding(7) var<storage, read_write> image: array<u32>;
@group(0) @binding(8) var<storage, read_write> tally: Tally;

#if eye
const WORDS: u32 = 2u;
#else
const WORDS: u32 = 1u;
#end

// A cut-out face, as its pixels ask for it.
struct Lace {
    a: Vertex,
    b: Vertex,
    c: Vertex,
    holes: Map,
}

fn lace_at(i: u32) -> Lace {
    let face = face_at(i);
    let paint = paint_at(face.paint & ~(ONE_SIDED | CUT_OUT));
    return Lace(vertex_at(face.a), vertex_at(face.b), vertex_at(face.c), paint.opacity_map);
}

// Whether the face is there at a pixel's center.
fn stays(l: Lace, pixel: vec2u) -> bool {
    let at = vec2f(vec2u(lens.left, lens.top) % REGION + pixel) + 0.5;
    let w = weights_inside(to_clip(l.a.position), to_clip(l.b.position), to_clip(l.c.position), at);
    return is_there(l.holes, uv_by(w, l.a, l.b, l.c));
}

// One workgroup owns a tile, and each lane a pixel of it.
@compute @workgroup_size(256)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    // The last row of workgroups may be longer than there are tiles: what they then draw again stays what it is.
    let number = min(group.y * groups.x + group.x, arrayLength(&busy) - 1u);
    let tile_number = min(busy[number], arrayLength(&starts) / 2u - 1u);
    let tile = vec2u(tile_number % lens.columns, tile_number / lens.columns);
    let origin = vec2i(tile * TILE);
    let limit = arrayLength(&entries);
    let begin = starts[2u * tile_number];
    let middle = starts[2u * tile_number + 1u];
    let end = starts[2u * tile_number + 2u];
    let skip = lens.round * MOST_ENTRIES;
    let whole_first = min(begin + skip, middle);
    let whole = min(whole_first + MOST_ENTRIES, middle) - whole_first;
    let some_first = min(middle + skip, end);
    let some = min(some_first + MOST_ENTRIES, end) - some_first;

    let here = vec2i(vec2u(lane % TILE, lane / TILE));
    let pixel = vec2u(origin + here);
    if (all(pixel < vec2u(lens.width, lens.height))) {
        let word = lens.first + (pixel.y * lens.width + pixel.x) * WORDS;
#if eye
        var best = vec2u(image[word + 1u], image[word]);
#else
        var best = vec2u(image[word], NONE);
#end
        for (var k = 0u; k < whole + some; k++) {
            let entry = min(select(some_first + (k - whole), whole_first + k, k < whole), limit - 1u);
            let piece = pieces[entries[entry]];
            if (piece.id - part.first < part.faces) {
                let p = plan(piece.a, piece.b, piece.c, origin);
                let e = p.e + p.a * here.x + p.b * here.y;
                let now = vec2u(nearness(p.nears, here.x, here.y), NONE - piece.id);
                let nearer = now.x > best.x || (now.x == best.x && now.y > best.y);
                if ((e.x | e.y | e.z) >= 0 && nearer && stays(lace_at(piece.id - part.first), pixel)) {
                    best = now;
                }
            }
        }
#if eye
        image[word] = best.y;
        image[word + 1u] = best.x;
#else
        image[word] = best.x;
#end
    }
    if (lane == 0u) {
        atomicAdd(&tally.groups, 1u);
    }
}
