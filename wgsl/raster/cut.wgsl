// faces that are large or cross a plane -> pieces of them, bin by bin
#import "tables/slice.wgsl"
#import "tables/piece.wgsl"
#import "tables/mesh.wgsl"
#import "raster/clip.wgsl"
#import "raster/facet.wgsl"
#import "raster/reach.wgsl"

@group(0) @binding(0) var<uniform> lens: Lens;
@group(0) @binding(1) var<uniform> part: Part;
@group(0) @binding(4) var<storage, read> late: array<u32>;
@group(0) @binding(5) var<storage, read_write> pieces: array<Piece>;
@group(0) @binding(6) var<storage, read_write> tally: Tally;

#if torn
// What the planes leave of a face is a fan of triangles.
fn cut(face: Face, id: u32) {
    var polygon: array<vec4f, 9>;
    polygon[0] = to_clip(vertex_at(face.a).position);
    polygon[1] = to_clip(vertex_at(face.b).position);
    polygon[2] = to_clip(vertex_at(face.c).position);
    let count = clip(&polygon);
    for (var i = 2u; i < count; i++) {
        sort(facet(face.paint, snap(polygon[0]), snap(polygon[i - 1u]), snap(polygon[i])), id);
    }
}
#else
fn cut(face: Face, id: u32) {
    let p = snap(to_clip(vertex_at(face.a).position));
    let q = snap(to_clip(vertex_at(face.b).position));
    let r = snap(to_clip(vertex_at(face.c).position));
    sort(facet(face.paint, p, q, r), id);
}
#end

// One piece for each bin that the triangle may touch. What finds no room is counted all the same.
fn sort(f: Facet, id: u32) {
    if (!f.seen) {
        return;
    }
    let under = vec4u(f.bounds) / (TILE * BIN);
    for (var row = under.y; row <= under.w; row++) {
        for (var column = under.x; column <= under.z; column++) {
            let piece = Piece(f.p, id, f.q, column * BIN, f.r, row * BIN);
            if (how(reach(piece), vec2u(0u), BIN * TILE) != MISSED) {
                let at = atomicAdd(&tally.pieces, 1u);
                if (at < arrayLength(&pieces)) {
                    pieces[at] = piece;
                }
            }
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
#if torn
    let count = atomicLoad(&tally.late[1]);
    let at = arrayLength(&late) - 1u - i;
#else
    let count = atomicLoad(&tally.late[0]);
    let at = i;
#end
    if (i < min(count, arrayLength(&late))) {
        let id = late[at];
        if (id - part.first < part.faces) {
            cut(face_at(id - part.first), id);
        }
    }
}
