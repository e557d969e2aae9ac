// a face that crosses planes -> what is left of it, a convex polygon in fixed point
#import "tables/mesh.wgsl"
#import "raster/snap.wgsl"

// Where an edge that crosses a plane meets it.
//
// Always reckoned from the end inside to the end outside, so that both faces of the edge get the same bits.
fn meet(inside: vec4f, outside: vec4f, plane: u32) -> vec4f {
    let from_inside = height(plane, inside);
    let t = hold(quotient(from_inside, from_inside - height(plane, outside)));
    let way = outside - inside;
    return inside + vec4f(hold(way.x * t), hold(way.y * t), hold(way.z * t), hold(way.w * t));
}

// Sutherland and Hodgman: plane after plane cuts off what lies beyond it. How many corners are left.
fn clip(corners: ptr<function, array<vec4f, 9>>) -> u32 {
    var count = 3u;
    var cut: array<vec4f, 9>;
    for (var plane = 0u; plane < PLANES; plane++) {
        var left = 0u;
        for (var i = 0u; i < count; i++) {
            let here = (*corners)[i];
            let next = (*corners)[select(i + 1u, 0u, i + 1u == count)];
            let here_in = height(plane, here) >= 0.0;
            let next_in = height(plane, next) >= 0.0;
            if (here_in && left < MOST_CORNERS) {
                cut[left] = here;
                left++;
            }
            if (here_in != next_in && left < MOST_CORNERS) {
                if (here_in) {
                    cut[left] = meet(here, next, plane);
                } else {
                    cut[left] = meet(next, here, plane);
                }
                left++;
            }
        }
        count = left;
        for (var i = 0u; i < count; i++) {
            (*corners)[i] = cut[i];
        }
    }
    return count;
}
