// a ray and a node -> which of the node's children and primitives it may meet up to t
#import "tables/node.wgsl"
#import "trace/aim.wgsl"

fn bytes(word: u32) -> vec4u {
    return (vec4u(word) >> vec4u(0u, 8u, 16u, 24u)) & vec4u(255u);
}

// Processors convert signed numbers in one step, others in eight.
fn steps(word: u32) -> vec4f {
    return vec4f(vec4i(bytes(word)));
}

// Where the ray is on one axis: at `near + step * byte` it crosses a near side, at `far + step * byte` a far one.
struct Axis {
    step: f32,
    near: f32,
    far: f32,
}

fn axis_of(exponent: u32, corner: f32, inverse: f32, slack: f32) -> Axis {
    let at = corner * inverse;
    return Axis(bitcast<f32>(exponent << 23u) * inverse, at - slack, at + slack);
}

// Which of a node's children are nodes, as rays of an octant have them: see `Node`.
fn inner_of(node: Node, octant: u32) -> u32 {
    let byte = (node.inner >> (8u * (octant & 3u))) & 255u;
    return select(byte, (byte << 4u) | (byte >> 4u), octant >= 4u);
}

// See `lesser`: what is no number is left out, if `b` is one.
fn larger_of(a: vec4f, b: vec4f) -> vec4f {
    return select(b, a, a > b);
}

fn lesser_of(a: vec4f, b: vec4f) -> vec4f {
    return select(b, a, a < b);
}

// From bit 24 up the children that are nodes, at `place ^ octant`; below, the primitives of the others.
fn boxes_met(node: Node, ray: Ray, aim: Aim, t: f32) -> u32 {
    let exponents = bytes(node.steps);
    let corner = node.corner - ray.origin;
    let x = axis_of(exponents.x, corner.x, aim.inverse.x, aim.slack.x);
    let y = axis_of(exponents.y, corner.y, aim.inverse.y, aim.slack.y);
    let z = axis_of(exponents.z, corner.z, aim.inverse.z, aim.slack.z);
    let back = aim.inverse < vec3f(0.0);
    let near_x = select(node.low_x, node.high_x, back.x);
    let near_y = select(node.low_y, node.high_y, back.y);
    let near_z = select(node.low_z, node.high_z, back.z);
    let far_x = select(node.high_x, node.low_x, back.x);
    let far_y = select(node.high_y, node.low_y, back.y);
    let far_z = select(node.high_z, node.low_z, back.z);
    var met = 0u;
    #repeat 2
    {
        let enter_x = steps(near_x[$i]) * x.step + x.near;
        let enter_y = steps(near_y[$i]) * y.step + y.near;
        let enter_z = steps(near_z[$i]) * z.step + z.near;
        let leave_x = steps(far_x[$i]) * x.step + x.far;
        let leave_y = steps(far_y[$i]) * y.step + y.far;
        let leave_z = steps(far_z[$i]) * z.step + z.far;
        let enter = larger_of(enter_x, larger_of(enter_y, larger_of(enter_z, vec4f(0.0))));
        let leave = lesser_of(leave_x, lesser_of(leave_y, lesser_of(leave_z, vec4f(t))));
        let bits = select(vec4u(0u), aim.may_have[$i], enter <= leave);
        met |= (bits.x | bits.y) | (bits.z | bits.w);
    }
    #end
    return met & (node.held | (inner_of(node, aim.octant) << 24u));
}
