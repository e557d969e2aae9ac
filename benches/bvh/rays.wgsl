// rays -> what each of them meets
#import "trace/walk.wgsl"

struct Asked {
    origin: vec3f,
    far: f32,
    direction: vec3f,
    any: u32,
}

struct Met {
    t: f32,
    hit: u32,
    turns: u32,
    flags: u32,
}

@group(0) @binding(3) var<storage, read> asked: array<Asked>;
@group(0) @binding(4) var<storage, read_write> met: array<Met>;

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    let i = (group.y * groups.x + group.x) * 64u + lane;
    if (i < arrayLength(&asked)) {
        let ray = Ray(asked[i].origin, asked[i].direction, NONE);
        let found = walk(ray, Walk(asked[i].far, NONE, 0u, 0u, 0u), 8000u, asked[i].any == 1u);
        met[i] = Met(found.t, found.hit, found.turns, found.flags);
    }
}
