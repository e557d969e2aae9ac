// corners -> small faces drawn into the depths, and pieces of all others
#import "tables/slice.wgsl"
#import "raster/clip.wgsl"
#import "raster/facet.wgsl"

@group(0) @binding(0) var<uniform> lens: Lens;
@group(0) @binding(1) var<storage, read> faces: array<Face>;
@group(0) @binding(2) var<storage, read> vertices: array<Vertex>;
@group(0) @binding(3) var<storage, read> corners: array<Corner>;
@group(0) @binding(4) var<storage, read_write> depths: array<atomic<u32>>;
@group(0) @binding(5) var<storage, read_write> pieces: array<Piece>;
@group(0) @binding(6) var<storage, read_write> tally: Tally;

// Pieces that find no room are counted all the same: the host makes room and starts again.
fn put_off(f: Facet, id: u32) {
    let at = atomicAdd(&tally.pieces, 1u);
    if (at < arrayLength(&pieces)) {
        pieces[at] = Piece(f.p, id, f.q, 0u, f.r, 0u);
    }
}

fn draw(f: Facet) {
    let seen = plan(f.p, f.q, f.r, f.bounds.xy);
    for (var y = f.bounds.y; y <= f.bounds.w; y++) {
        for (var x = f.bounds.x; x <= f.bounds.z; x++) {
            let here = vec2i(x, y) - f.bounds.xy;
            let e = seen.e + seen.a * here.x + seen.b * here.y;
            if ((e.x | e.y | e.z) >= 0) {
                let at = lens.first + u32(y) * lens.width + u32(x);
                let depth = depth_at(seen, here.x, here.y);
                // Depths only ever fall, so what is no longer less need not ask.
                if (depth < atomicLoad(&depths[at])) {
                    atomicMin(&depths[at], depth);
                }
            }
        }
    }
}

// What the planes leave of a face is a fan of pieces.
fn cut(face: Face, id: u32) {
    var polygon: array<vec4f, 9>;
    polygon[0] = to_clip(vertices[face.a].position);
    polygon[1] = to_clip(vertices[face.b].position);
    polygon[2] = to_clip(vertices[face.c].position);
    let count = clip(&polygon);
    for (var i = 2u; i < count; i++) {
        let f = facet(face.paint, snap(polygon[0]), snap(polygon[i - 1u]), snap(polygon[i]));
        if (f.kind != NOTHING) {
            put_off(f, id);
        }
    }
}

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    let i = (group.y * groups.x + group.x) * GROUP + lane;
    if (i < lens.faces) {
        let face = faces[i];
        let a = corners[face.a];
        let b = corners[face.b];
        let c = corners[face.c];
        if ((a.code | b.code | c.code) == 0u) {
            let f = facet(face.paint, a.at, b.at, c.at);
            if (f.kind == SMALL) {
                draw(f);
            } else if (f.kind == LARGE) {
                put_off(f, i);
            }
        } else if ((a.code & b.code & c.code) == 0u) {
            cut(face, i);
        }
    }
    if (lane == 0u) {
        atomicAdd(&tally.groups, 1u);
    }
}
