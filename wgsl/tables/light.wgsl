struct Light {
    // A point light's position, or the unit direction towards a directional light.
    place: vec3f,
    // POINT or DIRECTIONAL.
    kind: u32,
    // Color times intensity.
    power: vec3f,
    pad: u32,
}

const POINT: u32 = 0u;
const DIRECTIONAL: u32 = 1u;
// From one direction on things that are small beside others, with a lens for them before that for all.
const NESTED: u32 = 2u;
