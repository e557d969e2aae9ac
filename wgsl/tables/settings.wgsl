// What is the same for every ray of a frame.
struct Settings {
    background: vec3f,
    max_depth: u32,
    // How many of the scene's primitives, from number 0.
    spheres: u32,
    // How many of them after the spheres; in the leaves they are the first.
    planes: u32,
    lights: u32,
    // PHONG or BLINN.
    specular: u32,
    // The lower corner of all that lies below nodes.
    low: vec3f,
    // A path whose weight is not above this is not followed.
    cutoff: f32,
    // The upper corner.
    high: vec3f,
    // Zero, which no compiler can know: see math/fence.
    zero: u32,
    // NEAREST, BILINEAR or MIPMAP.
    filtering: u32,
    // Copies of models whose trees are shared.
    instances: u32,
    // Primitives with ids from this on are theirs.
    loose: u32,
    pad: u32,
}

const PHONG: u32 = 0u;
const BLINN: u32 = 1u;
const NONE: u32 = 0xffffffffu;
