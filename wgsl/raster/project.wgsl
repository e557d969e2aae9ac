// vertices -> corners in fixed point, or the planes that they lie beyond
#import "tables/slice.wgsl"
#import "tables/mesh.wgsl"
#import "raster/snap.wgsl"

@group(0) @binding(0) var<uniform> lens: Lens;
@group(0) @binding(1) var<uniform> part: Part;
@group(0) @binding(2) var corners: texture_storage_2d<rgba32uint, write>;

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    let i = (group.y * groups.x + group.x) * GROUP + lane;
    // The lens is read outside of every branch: under one lavapipe reads uniforms lane by lane.
    let c = to_clip(vertex_at(min(i, part.vertices - 1u)).position);
    let code = outcode(c);
    let corner = vec4u(bitcast<vec3u>(select(vec3i(0), snap(c), code == 0u)), code);
    if (i < part.vertices) {
        textureStore(corners, vec2u(i % ROW, i / ROW), corner);
    }
}
