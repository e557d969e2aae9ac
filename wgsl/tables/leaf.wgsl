// A primitive of any kind in world space.
struct Leaf {
    // A triangle's first corner, a sphere's center, a plane's point, the lower corner of an instance's box.
    a: vec3f,
    // Its number in the scene.
    id: u32,
    // A triangle's second corner, a plane's normal, the upper corner of an instance's box; a sphere's radius in x.
    b: vec3f,
    // Which of the materials, or of the instances.
    material: u32,
    // A triangle's third corner; the way in which u of a plane's maps grows, one over a copy's size long.
    c: vec3f,
    // TRIANGLE, SPHERE, PLANE or INSTANCE; a triangle's with ONE_SIDED and CUT_OUT.
    kind: u32,
}

const TRIANGLE: u32 = 0u;
const SPHERE: u32 = 1u;
const PLANE: u32 = 2u;
const INSTANCE: u32 = 3u;
