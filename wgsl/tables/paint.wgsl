#import "tables/texel.wgsl"

// A picture laid over faces: texel at uv * scale + shift.
struct Map {
    // Its first texel; finest level first, each row by row from the top. NONE: no picture.
    first: u32,
    width: u32,
    height: u32,
    // How many levels, each half as wide and high as the one before; with CLAMPED where its edge goes on for ever,
    // instead of the picture repeating.
    levels: u32,
    scale: vec2f,
    shift: vec2f,
}

// What a face is made of.
struct Paint {
    // Times the diffuse map.
    color: vec3f,
    // Times the exponent map, if there is one.
    exponent: f32,
    // Times the specular map.
    specular: vec3f,
    // Times x and y of the normal map.
    bump: f32,
    // Colors, decoded by the curve at the head of the texels.
    diffuse_map: Map,
    normal_map: Map,
    specular_map: Map,
    exponent_map: Map,
    // In alpha.
    opacity_map: Map,
}

// A light and the lenses that it sees the scene through.
struct Lamp {
    // A point light's position, or the unit direction towards a directional light.
    place: vec3f,
    // POINT, DIRECTIONAL or NESTED.
    kind: u32,
    power: vec3f,
    // The first of its lenses: one, two if nested, or six for a point light (+x -x +y -y +z -z). NONE: no shadow.
    lens: u32,
}

// How pixels are colored.
struct Canvas {
    eye: vec3f,
    lamps: u32,
    background: vec3f,
    // PHONG or BLINN.
    specular: u32,
    ambient: vec3f,
    // What a shadowed light counts for.
    shade: f32,
    // NEAREST, BILINEAR or MIPMAP.
    filtering: u32,
    // Texels around a point's own that are asked for its shadow, in each direction.
    blur: u32,
    // What is shown: SHOW_COLOR or one of its ingredients.
    show: u32,
    // Where depths are shown, what is shown is this over the distance along the axis of the eye,
    depth_times: f32,
    // and this added,
    depth_plus: f32,
    // and no less than this, and no more than that.
    depth_least: f32,
    depth_most: f32,
    pad: u32,
}

const CLAMPED: u32 = 0x80000000u;
const NEAREST: u32 = 0u;
const BILINEAR: u32 = 1u;
const MIPMAP: u32 = 2u;
const SHOW_COLOR: u32 = 0u;
const SHOW_DEPTH: u32 = 1u;
const SHOW_SHADOW: u32 = 2u;
const SHOW_NORMAL: u32 = 3u;
const SHOW_UV: u32 = 4u;
const SHOW_ALBEDO: u32 = 5u;
const SHOW_AMBIENT: u32 = 6u;
const SHOW_DIFFUSE: u32 = 7u;
const SHOW_SPECULAR: u32 = 8u;
const SHOW_ID: u32 = 9u;
const SHOW_TILES: u32 = 10u;
const SHOW_WIRE: u32 = 11u;

@group(0) @binding(14) var paints: Table;
@group(0) @binding(15) var lamps: Table;
// One word a texel: 256 of the curve by which colors are decoded, then all levels of all pictures.
@group(0) @binding(16) var texels: Words;

fn map_at(i: u32) -> Map {
    let a = texel(paints, i);
    let b = bitcast<vec4f>(texel(paints, i + 1u));
    return Map(a.x, a.y, a.z, a.w, b.xy, b.zw);
}

fn paint_at(i: u32) -> Paint {
    let first = i * 12u;
    let a = bitcast<vec4f>(texel(paints, first));
    let b = bitcast<vec4f>(texel(paints, first + 1u));
    return Paint(
        a.xyz, a.w, b.xyz, b.w, map_at(first + 2u), map_at(first + 4u), map_at(first + 6u), map_at(first + 8u),
        map_at(first + 10u),
    );
}

fn lamp_at(i: u32) -> Lamp {
    let a = texel(lamps, i * 2u);
    let b = texel(lamps, i * 2u + 1u);
    return Lamp(bitcast<vec3f>(a.xyz), a.w, bitcast<vec3f>(b.xyz), b.w);
}
