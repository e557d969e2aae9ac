// A picture on a screen, and the film that it is developed from; it may have more pixels than the film.
struct Print {
    // Of the film.
    width: u32,
    height: u32,
    // Of the picture.
    across: u32,
    down: u32,
    // Words from one row of the picture to the next.
    pitch: u32,
    transfer: u32,
    pad: vec2u,
}

const AS_IT_IS: u32 = 0u;
const SRGB: u32 = 1u;
