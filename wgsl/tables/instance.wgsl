#import "tables/texel.wgsl"

// A model's own tree, placed in the world: what many instances share is there once.
struct Instance {
    // The model's axes in the world, as long as it is enlarged.
    x: vec3f,
    // The root of the model's tree.
    root: u32,
    y: vec3f,
    // The first of the tree's leaves, whose ids are counted from 0.
    leaves: u32,
    z: vec3f,
    // What its leaves' ids grow by.
    id: u32,
    // The model's origin in the world.
    origin: vec3f,
    // The first of its faces.
    face: u32,
    // The lower corner of all that lies below its tree, as the model sees it.
    low: vec3f,
    // What its leaves' materials grow by.
    material: u32,
    // The upper corner.
    high: vec3f,
    // One over the square of how much it is enlarged.
    shrink: f32,
    // How far off a surface of it rays start, in world units.
    margin: f32,
    // How many leaves it has.
    count: u32,
    pad: vec2u,
}

@group(0) @binding(17) var instances: Table;

fn instance_at(i: u32) -> Instance {
    let first = i * 7u;
    let a = texel(instances, first);
    let b = texel(instances, first + 1u);
    let c = texel(instances, first + 2u);
    let d = texel(instances, first + 3u);
    let e = texel(instances, first + 4u);
    let f = texel(instances, first + 5u);
    let g = texel(instances, first + 6u);
    return Instance(
        bitcast<vec3f>(a.xyz), a.w, bitcast<vec3f>(b.xyz), b.w, bitcast<vec3f>(c.xyz), c.w, bitcast<vec3f>(d.xyz), d.w,
        bitcast<vec3f>(e.xyz), e.w, bitcast<vec3f>(f.xyz), bitcast<f32>(f.w), bitcast<f32>(g.x), g.y, g.zw,
    );
}

// The id that an instance's leaves begin at.
fn first_id_of(i: u32) -> u32 {
    return texel(instances, i * 7u + 2u).w;
}
