// small faces and the final depths -> the least id where the depth is theirs
#import "tables/slice.wgsl"
#import "tables/settings.wgsl"
#import "raster/speck.wgsl"

@group(0) @binding(0) var<uniform> lens: Lens;
// Of a pixel: NONE less the id, then the nearness.
@group(0) @binding(4) var<storage, read_write> image: array<atomic<u32>>;

fn mark(s: Speck, id: u32) {
    let from_first = s.last - s.first;
    let corner = u32(s.first.y) * lens.width + u32(s.first.x);
    for (var by = 0; by <= from_first.y; by += 8) {
        for (var bx = 0; bx <= from_first.x; bx += 8) {
            var bits = covered(s, vec2i(bx, by));
            while ((bits.x | bits.y) != 0u) {
                let here = first_of(bits) + vec2i(bx, by);
                bits = rest_of(bits);
                let at = 2u * (corner + u32(here.y) * lens.width + u32(here.x));
                if (atomicLoad(&image[at + 1u]) == nearness(s.plan.depths, here.x, here.y)) {
                    atomicMax(&image[at], NONE - id);
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
    if (i < part.faces) {
        let s = speck(i);
        if (s.kind == SMALL) {
            mark(s, part.first + i);
        }
    }
}
