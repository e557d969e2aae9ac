// faces -> small ones drawn onto the image, and the numbers of all others
#import "tables/slice.wgsl"
#import "tables/piece.wgsl"
#import "tables/settings.wgsl"
#import "raster/behind.wgsl"

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
    let width = lens.width;
    let words = lens.first + WORDS - 1u;
    let corner = u32(s.first.y) * width + u32(s.first.x);
    var block = vec2i(0);
    loop {
        var bits = covered(s, block);
        loop {
            if ((bits.x | bits.y) != 0u) {
                let here = first_of(bits) + block;
                let pixel = corner + u32(here.y) * width + u32(here.x);
                let near = nearness(s.plan.nears, here.x, here.y);
#if wide
                atomicMax(&image[pixel], (u64(near) << 32u) | u64(NONE - id));
#else
                atomicMax(&image[words + pixel * WORDS], near);
#end
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
    let i = part.begin + turn_of(group, groups) * GROUP + lane;
    let s = unveiled(speck(i));
    draw(s, part.first + i);
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
