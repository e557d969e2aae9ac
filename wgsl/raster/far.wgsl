// image -> of each cell of 8 x 8 pixels the farthest
#import "tables/slice.wgsl"
#import "tables/lens.wgsl"

@group(0) @binding(0) var<uniform> lens: Lens;
@group(0) @binding(1) var<storage, read> image: array<u32>;
@group(0) @binding(2) var<storage, read_write> cells: array<u32>;

#if eye
const WORDS: u32 = 2u;
#else
const WORDS: u32 = 1u;
#end

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    let i = (group.y * groups.x + group.x) * GROUP + lane;
    let across = lens.columns * (TILE / CELL);
    // A cell beyond the film has the nearest pixels of it: they are another's anyway.
    let last = vec2u(lens.width, lens.height) - 1u;
    let first = min(vec2u(i % across, i / across) * CELL, last);
    let end = min(first.y + CELL - 1u, last.y);
    var least = NO_DEPTH;
    // A cell with a pixel that shows nothing hides nothing: it need not be read to its end.
    var y = first.y;
    loop {
        let row = lens.first + y * lens.width * WORDS + WORDS - 1u;
#repeat columns
        least = min(least, image[row + min(first.x + $iu, last.x) * WORDS]);
#end
        y++;
        continuing {
            break if y > end || least == 0u;
        }
    }
    if (i < arrayLength(&cells)) {
        cells[i] = least;
    }
}
