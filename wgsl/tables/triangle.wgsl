struct Triangle {
    a: vec3f,
    material: u32,
    b: vec3f,
    pad_b: u32,
    c: vec3f,
    pad_c: u32,
}
