// ids -> the runs of pixels that show a face, and those that show none
#import "tables/slice.wgsl"
#import "tables/lens.wgsl"
#import "tables/piece.wgsl"

@group(0) @binding(0) var<uniform> lens: Lens;
@group(0) @binding(1) var<storage, read> image: array<u32>;
// A run is as long as a workgroup. Those that show a face from the front, the others from the end.
@group(0) @binding(2) var<storage, read_write> runs: array<u32>;
@group(0) @binding(3) var<storage, read_write> tally: Tally;

// A lane looks through a run until it finds a face. With a lane for each pixel, all of a workgroup's would have to wait
// for the last one, which takes lavapipe longer than all else here.
@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    let run = (group.y * groups.x + group.x) * GROUP + lane;
    let pixels = lens.width * lens.height;
    let end = min((run + 1u) * GROUP, pixels);
    var i = run * GROUP;
    var shows = false;
    loop {
        shows |= image[2u * i] != 0u;
        i++;
        continuing {
            break if shows || i >= end;
        }
    }
    if (run * GROUP < pixels) {
        if (shows) {
            runs[atomicAdd(&tally.shown, 1u)] = run;
        } else {
            runs[arrayLength(&runs) - 1u - atomicAdd(&tally.bare, 1u)] = run;
        }
    }
}
