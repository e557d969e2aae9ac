// a table and a number -> the row of that number
// Texels in a row of a table that is a texture.
const ROW: u32 = 8192u;

// lavapipe looks for a sampled texture's level lane by lane, even where there is but one; an image has none.
#if images
alias Table = texture_storage_2d<rgba32uint, read>;
alias Words = texture_storage_2d<r32uint, read>;

fn texel(table: Table, i: u32) -> vec4u {
    return textureLoad(table, vec2u(i % ROW, i / ROW));
}

fn word_of(words: Words, i: u32) -> u32 {
    return textureLoad(words, vec2u(i % ROW, i / ROW)).x;
}
#else
alias Table = texture_2d<u32>;
alias Words = texture_2d<u32>;

fn texel(table: Table, i: u32) -> vec4u {
    return textureLoad(table, vec2u(i % ROW, i / ROW), 0);
}

fn word_of(words: Words, i: u32) -> u32 {
    return textureLoad(words, vec2u(i % ROW, i / ROW), 0).x;
}
#end
