struct Sphere {
    center: vec3f,
    radius: f32,
    material: u32,
    pad_a: u32,
    pad_b: vec2u,
}
