// a table and a number -> the row of that number
// Texels in a row of a table that is a texture.
const ROW: u32 = 8192u;

// lavapipe looks for a sampled texture's level lane by lane, even where there is but one; an image has none.
#if images
alias Table = texture_storage_2d<rgba32uint, read>;
alias Words = texture_storage_2d<r32uint, read>;

fn texel_at(table: Table, begin: vec2u, k: u32) -> vec4u {
    return textureLoad(table, vec2u(begin.x + k, begin.y));
}

fn word_of(words: Words, i: u32) -> u32 {
    return textureLoad(words, vec2u(i % ROW, i / ROW)).x;
}
#else
alias Table = texture_2d<u32>;
alias Words = texture_2d<u32>;

fn texel_at(table: Table, begin: vec2u, k: u32) -> vec4u {
    return textureLoad(table, vec2u(begin.x + k, begin.y), 0);
}

fn word_of(words: Words, i: u32) -> u32 {
    return textureLoad(words, vec2u(i % ROW, i / ROW), 0).x;
}
#end

fn texel(table: Table, i: u32) -> vec4u {
    return texel_at(table, vec2u(i % ROW, i / ROW), 0u);
}

// Where a value of so many texels begins, in a table with rows of whole ones, as many as a power of two: a walk works this
// out once for all of them.
fn begin_of(i: u32, texels: u32) -> vec2u {
    let bits = firstLeadingBit(ROW / texels);
    return vec2u((i & ((1u << bits) - 1u)) * texels, i >> bits);
}
