#import "tables/texel.wgsl"

// A corner that faces share, in world space.
struct Vertex {
    position: vec3f,
    u: f32,
    normal: vec3f,
    v: f32,
}

// A triangle; its number is its id.
struct Face {
    a: u32,
    b: u32,
    c: u32,
    // Which of the paints, and ONE_SIDED and CUT_OUT.
    paint: u32,
}

// The face is not there when it is seen from its back.
const ONE_SIDED: u32 = 0x80000000u;
// The face is not there where its paint's opacity map is below a half.
const CUT_OUT: u32 = 0x40000000u;

// Faces that are bound together with their vertices: the ids from `first` on.
struct Part {
    first: u32,
    faces: u32,
    vertices: u32,
    // How many of its faces come before those in hand; `faces` counts them too.
    begin: u32,
}

// Tables in textures: a software adapter reads these four words at a time, and buffers word by word.
@group(0) @binding(12) var vertices: Table;
@group(0) @binding(13) var faces: Table;

fn face_at(i: u32) -> Face {
    let a = texel(faces, i);
    return Face(a.x, a.y, a.z, a.w);
}

fn vertex_at(i: u32) -> Vertex {
    let a = bitcast<vec4f>(texel(vertices, i * 2u));
    let b = bitcast<vec4f>(texel(vertices, i * 2u + 1u));
    return Vertex(a.xyz, a.w, b.xyz, b.w);
}
