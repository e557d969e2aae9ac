struct Material {
    color: vec3f,
    // Weight of the local light (spec 2.1, step 2).
    local_weight: f32,
    // The color scaled to length one: what a diffuse path is multiplied by.
    tint: vec3f,
    // Weight of the reflected path (step 3).
    reflect_weight: f32,
    // Weight of the refracted path (step 4).
    refract_weight: f32,
    // The specular exponent k.
    exponent: f32,
    // Refractive index; outside it is 1.
    index: f32,
    // MIRROR, DIFFUSE or GLASS.
    behavior: u32,
}

const MIRROR: u32 = 0u;
const DIFFUSE: u32 = 1u;
const GLASS: u32 = 2u;
