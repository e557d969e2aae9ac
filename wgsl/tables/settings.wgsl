// What is the same for every ray of a frame.
struct Settings {
    background: vec3f,
    max_depth: u32,
    spheres: u32,
    planes: u32,
    triangles: u32,
    lights: u32,
    // PHONG or BLINN.
    specular: u32,
    // A path whose weight falls below this is not followed.
    cutoff: f32,
    // Zero, which no compiler can know: see math/fence.
    zero: u32,
    pad: u32,
}

const PHONG: u32 = 0u;
const BLINN: u32 = 1u;
const NONE: u32 = 0xffffffffu;
