struct Plane {
    point: vec3f,
    material: u32,
    // Of length one.
    normal: vec3f,
    pad: u32,
}
