// the farthest of each cell -> what hides a face that begins in it: the farthest of 1, of 2 x 2 and of 3 x 3 cells
#import "tables/slice.wgsl"
#import "tables/lens.wgsl"
#import "tables/texel.wgsl"

@group(0) @binding(0) var<uniform> lens: Lens;
@group(0) @binding(1) var<storage, read> cells: array<u32>;
@group(0) @binding(2) var veil: texture_storage_2d<rgba32uint, write>;

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    let i = (group.y * groups.x + group.x) * GROUP + lane;
    let across = lens.columns * (TILE / CELL);
    let down = (lens.height + TILE - 1u) / TILE * (TILE / CELL);
    let x = i % across;
    let y = min(i / across, down - 1u);
    let x1 = min(x + 1u, across - 1u);
    let x2 = min(x + 2u, across - 1u);
    let y0 = y * across;
    let y1 = min(y + 1u, down - 1u) * across;
    let y2 = min(y + 2u, down - 1u) * across;
    let one = cells[y0 + x];
    let two = min(one, min(cells[y0 + x1], min(cells[y1 + x], cells[y1 + x1])));
    let right = min(cells[y0 + x2], cells[y1 + x2]);
    let below = min(cells[y2 + x], cells[y2 + x1]);
    let three = min(min(two, cells[y2 + x2]), min(right, below));
    if (i < across * down) {
        textureStore(veil, vec2u(i % ROW, i / ROW), vec4u(one, two, three, 0u));
    }
}
