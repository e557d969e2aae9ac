// small faces and the final depths -> the least id where the depth is theirs
#import "tables/slice.wgsl"
#import "tables/settings.wgsl"
#import "raster/behind.wgsl"

@group(0) @binding(0) var<uniform> lens: Lens;
// Of a pixel: NONE less the id, then the nearness.
@group(0) @binding(4) var<storage, read_write> image: array<atomic<u32>>;

fn mark(s: Speck, id: u32) {
    let width = lens.width;
    let corner = u32(s.first.y) * width + u32(s.first.x);
    var block = vec2i(0);
    loop {
        var bits = covered(s, block);
        loop {
            if ((bits.x | bits.y) != 0u) {
                let here = first_of(bits) + block;
                let at = 2u * (corner + u32(here.y) * width + u32(here.x));
                if (atomicLoad(&image[at + 1u]) == nearness(s.plan.nears, here.x, here.y)) {
                    atomicMax(&image[at], NONE - id);
                }
            }
            bits = rest_of(bits);
            continuing {
                break if (bits.x | bits.y) == 0u;
            }
        }
        block = after(s, block);
        continuing {
            break if block.y > s.last.y - s.first.y;
        }
    }
}

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    let i = turn_of(group, groups) * GROUP + lane;
    mark(unveiled(speck(i)), part.first + i);
}
