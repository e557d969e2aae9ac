// One portion of work: which pixels, up to which sample, and how many loop turns each may take.
struct Slice {
    // The first pixel, counted along rows from the top left.
    first: u32,
    count: u32,
    // The sample at which a pixel is done.
    samples: u32,
    budget: u32,
}

// lavapipe ends all loops of a SIMD group of 8 after 65,535 turns together, without a word
// (LP_MAX_TGSI_LOOP_ITERATIONS): 8 lanes on 8 different ways may take 8,191 each.
const MOST_TURNS: u32 = 8000u;
const GROUP: u32 = 64u;
