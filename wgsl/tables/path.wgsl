// One pixel's ray tree in progress: the ray in hand, what it has met so far, and the light gathered.
// It can be put down after any loop turn and taken up again, on either side.
struct Path {
    origin: vec3f,
    // The leaf that the ray leaves, or NONE: it meets itself only at the other end of a chord.
    leaves: u32,
    direction: vec3f,
    // Distance to the nearest hit so far, in lengths of `direction`.
    t: f32,
    // What the ray's light counts for in the pixel.
    weight: vec3f,
    // Which ray of its branch this is, from 1.
    depth: u32,
    radiance: vec3f,
    // 1 while the ray runs inside an object.
    inside: u32,
    // IDLE, SEEK, LIT or DONE.
    state: u32,
    // The sample being traced.
    sample: u32,
    // The nearest leaf so far, or NONE.
    hit: u32,
    // The next plane to test; once they are, one more than these and what the walk's stack holds.
    next: u32,
    // The light whose shadow ray is out.
    light: u32,
    // Rays waiting on the stack.
    waiting: u32,
    // Rays taken up so far: the dimension of the next random number.
    rays: u32,
    // The number of the primitive that the first ray met: the picture's id layer.
    seen: u32,
}

// A ray put aside while its heavier sibling is followed.
struct Waiting {
    origin: vec3f,
    leaves: u32,
    direction: vec3f,
    depth: u32,
    weight: vec3f,
    inside: u32,
}

// Farther than any hit.
const FAR: f32 = 3.4028235e38;

// No sample under way.
const IDLE: u32 = 0u;
// Looking for the ray's nearest hit.
const SEEK: u32 = 1u;
// At the hit, asking the lights.
const LIT: u32 = 2u;
// The tree is followed to its end; the radiance waits to be gathered.
const DONE: u32 = 3u;
