// Up to eight boxes around what lies below, in bytes: Ylitie, Karras and Laine, "Efficient Incoherent Ray Traversal
// on GPUs Through Compressed Wide BVHs", HPG 2017.
struct Node {
    // The lower corner of all boxes.
    corner: vec3f,
    // The biased exponents of a step in x, y and z.
    steps: u32,
    // Where the children begin that are nodes: each is as far on as its place. Between them lie places of none.
    children: u32,
    // The first of the primitives.
    leaves: u32,
    // A bit for each child that is a node, four times: byte k has them at `place ^ k`, as rays of octant k ask for them,
    // and with its halves swapped as those of octant k + 4 do.
    inner: u32,
    // Three bits for each child: as many ones, from the lowest up, as it has primitives.
    held: u32,
    // A byte for each child: steps from the corner.
    low_x: vec2u,
    low_y: vec2u,
    low_z: vec2u,
    high_x: vec2u,
    high_y: vec2u,
    high_z: vec2u,
}
