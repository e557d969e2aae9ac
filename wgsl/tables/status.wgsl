// What the kernels tell the host: a picture is published only if this adds up.
struct Status {
    // Workgroups that ran to their end.
    groups: atomic<u32>,
    // Pixels whose last sample has been gathered.
    pixels: atomic<u32>,
    flags: atomic<u32>,
    // The most loop turns that one invocation took.
    turns: atomic<u32>,
}

// A loop stopped where its own condition would have gone on.
const CUT_SHORT: u32 = 1u;
// A ray found no room on its stack.
const STACK_FULL: u32 = 2u;
