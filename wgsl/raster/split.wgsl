// faces -> small ones drawn onto the image, and the numbers of all others
#import "tables/slice.wgsl"
#import "tables/piece.wgsl"
#import "tables/settings.wgsl"
#import "raster/speck.wgsl"

@group(0) @binding(0) var<uniform> lens: Lens;
#if wide
// Of a pixel: the nearness, then NONE less the id.
@group(0) @binding(4) var<storage, read_write> image: array<atomic<u64>>;
#else
@group(0) @binding(4) var<storage, read_write> image: array<atomic<u32>>;
#end
@group(0) @binding(5) var<storage, read_write> late: array<u32>;
@group(0) @binding(6) var<storage, read_write> tally: Tally;

#if eye
const WORDS: u32 = 2u;
#else
const WORDS: u32 = 1u;
#end

fn draw(s: Speck, id: u32) {
    let from_first = s.last - s.first;
    let corner = u32(s.first.y) * lens.width + u32(s.first.x);
    for (var by = 0; by <= from_first.y; by += 8) {
        for (var bx = 0; bx <= from_first.x; bx += 8) {
            var bits = covered(s, vec2i(bx, by));
            while ((bits.x | bits.y) != 0u) {
                let here = first_of(bits) + vec2i(bx, by);
                bits = rest_of(bits);
                let pixel = corner + u32(here.y) * lens.width + u32(here.x);
                let near = nearness(s.plan.depths, here.x, here.y);
#if wide
                atomicMax(&image[pixel], (u64(near) << 32u) | u64(NONE - id));
#else
                atomicMax(&image[lens.first + pixel * WORDS + (WORDS - 1u)], near);
#end
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
            draw(s, part.first + i);
        }
        if (s.kind >= LATE) {
            // Whole ones from the list's front, torn ones from its end. What finds no room is counted all the same: the host
            // makes room and starts again.
            let place = atomicAdd(&tally.late[s.kind - LATE], 1u);
            let at = select(place, arrayLength(&late) - 1u - place, s.kind == TORN);
            if (at < arrayLength(&late)) {
                late[at] = part.first + i;
            }
        }
    }
}
