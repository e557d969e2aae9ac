// Texels in a row of a table that is a texture.
const ROW: u32 = 8192u;

fn texel(table: texture_2d<u32>, i: u32) -> vec4u {
    return textureLoad(table, vec2u(i % ROW, i / ROW), 0);
}
