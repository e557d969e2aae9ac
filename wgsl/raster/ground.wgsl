// runs that show no face -> the background, once
#import "tables/slice.wgsl"
#import "tables/lens.wgsl"
#import "tables/paint.wgsl"
#import "tables/piece.wgsl"

@group(0) @binding(0) var<uniform> lens: Lens;
@group(0) @binding(1) var<uniform> canvas: Canvas;
@group(0) @binding(2) var<storage, read> runs: array<u32>;
@group(0) @binding(3) var<storage, read_write> tally: Tally;
@group(0) @binding(4) var<storage, read_write> sums: array<vec4f>;

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    let number = group.y * groups.x + group.x;
    if (number < atomicLoad(&tally.bare)) {
        let i = runs[arrayLength(&runs) - 1u - number] * GROUP + lane;
        if (i < lens.width * lens.height) {
            let sample = vec4f(canvas.background, 1.0);
#if once
            sums[i] = sample;
#else
            sums[i] += sample;
#end
        }
    }
}
