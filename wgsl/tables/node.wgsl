// Up to eight boxes around what lies below, in bytes: Ylitie, Karras and Laine, "Efficient Incoherent Ray Traversal
// on GPUs Through Compressed Wide BVHs", HPG 2017.
struct Node {
    // The lower corner of all boxes.
    corner: vec3f,
    // The biased exponents of a step in x, y and z; then a bit for each child that is a node.
    steps: u32,
    // The first of the children that are nodes.
    children: u32,
    // The first of the primitives.
    leaves: u32,
    // A byte for each child. 0: none; 001 and 24 + its number: a node; else as many ones in the upper three bits as
    // it has primitives, and in the others which of them is its first.
    kinds: vec2u,
    // A byte for each child: steps from the corner.
    low_x: vec2u,
    low_y: vec2u,
    low_z: vec2u,
    high_x: vec2u,
    high_y: vec2u,
    high_z: vec2u,
}
