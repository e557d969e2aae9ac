// sums of samples -> the bytes that a display is sent, red first
#import "tables/print.wgsl"
#import "tables/slice.wgsl"
#import "math/power.wgsl"
#import "math/whole.wgsl"

@group(0) @binding(0) var<uniform> print: Print;
// Red, green, blue and the number of samples in the sum.
@group(0) @binding(1) var<storage, read> sums: array<vec4f>;
@group(0) @binding(2) var<storage, read_write> words: array<u32>;

const ENDLESS: vec3u = vec3u(0x7f800000u);

fn encode(color: f32) -> u32 {
    let c = clamp(color, 0.0, 1.0);
    let curved = select(1.055 * power(c, 1.0 / 2.4) - 0.055, c * 12.92, c <= 0.0031308);
    let shown = select(c, curved, print.transfer == SRGB);
    return u32(shown * 255.0 + 0.5);
}

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    let i = (group.y * groups.x + group.x) * GROUP + lane;
    let y = whole(i, print.across);
    let x = i - y * print.across;
    if (y < print.down) {
        let sum = sums[whole(y * print.height, print.down) * print.width + whole(x * print.width, print.across)];
        var color = vec3f(0.0);
        if (sum.w > 0.0) {
            color = sum.xyz / sum.w;
        }
        // What is not a finite number is black.
        if (any((bitcast<vec3u>(color) & ENDLESS) == ENDLESS)) {
            color = vec3f(0.0);
        }
        words[y * print.pitch + x] =
            encode(color.x) | (encode(color.y) << 8u) | (encode(color.z) << 16u) | 0xff000000u;
    }
}
