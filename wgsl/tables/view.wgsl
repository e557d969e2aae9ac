// The eye and the film: where a ray starts and which way it goes (spec 1.2.1 and 2.2).
struct View {
    eye: vec3f,
    width: u32,
    // Across the film plane at distance one, edge to edge, in world space.
    right: vec3f,
    height: u32,
    up: vec3f,
    // Samples along a pixel's side, or 0: then sample k lies at point k of a low-discrepancy sequence.
    grid: u32,
    // From what is looked at to the eye: the spec's D.
    back: vec3f,
    seed: u32,
    // 1 if the eye is inside of glass.
    inside: u32,
    pad_a: u32,
    pad_b: vec2u,
}
