// small faces and the final depths -> the least id where the depth is theirs
#import "tables/slice.wgsl"
#import "tables/piece.wgsl"
#import "raster/facet.wgsl"

@group(0) @binding(0) var<uniform> lens: Lens;
@group(0) @binding(1) var<storage, read> faces: array<Face>;
@group(0) @binding(2) var<storage, read> corners: array<Corner>;
@group(0) @binding(3) var<storage, read> depths: array<u32>;
@group(0) @binding(4) var<storage, read_write> ids: array<atomic<u32>>;
@group(0) @binding(5) var<storage, read_write> tally: Tally;

fn mark(f: Facet, id: u32) {
    let seen = plan(f.p, f.q, f.r, f.bounds.xy);
    for (var y = f.bounds.y; y <= f.bounds.w; y++) {
        for (var x = f.bounds.x; x <= f.bounds.z; x++) {
            let here = vec2i(x, y) - f.bounds.xy;
            let e = seen.e + seen.a * here.x + seen.b * here.y;
            if ((e.x | e.y | e.z) >= 0) {
                let at = u32(y) * lens.width + u32(x);
                if (depth_at(seen, here.x, here.y) == depths[lens.first + at]) {
                    atomicMin(&ids[at], id);
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
    if (i < lens.faces) {
        let face = faces[i];
        let a = corners[face.a];
        let b = corners[face.b];
        let c = corners[face.c];
        if ((a.code | b.code | c.code) == 0u) {
            let f = facet(face.paint, a.at, b.at, c.at);
            if (f.kind == SMALL) {
                mark(f, i);
            }
        }
    }
    if (lane == 0u) {
        atomicAdd(&tally.groups, 1u);
    }
}
