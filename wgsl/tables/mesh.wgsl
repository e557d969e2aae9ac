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
    // Which of the paints, and ONE_SIDED.
    paint: u32,
}

// The face is not there when it is seen from its back.
const ONE_SIDED: u32 = 0x80000000u;

// Faces that are bound together with their vertices: the ids from `first` on.
struct Part {
    first: u32,
    faces: u32,
}
