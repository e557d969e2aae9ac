// three corners in fixed point -> a triangle whose area is above zero, unless there is nothing to see of it
#import "tables/mesh.wgsl"
#import "raster/plan.wgsl"

struct Facet {
    p: vec3i,
    q: vec3i,
    r: vec3i,
    seen: bool,
    // First and last column and row of its bounding box on the film.
    bounds: vec4i,
}

// Whether a face with this paint is not there when its area on the film is above zero: y runs down the film, so that
// what is counterclockwise in the world has an area below zero here.
fn one_sided(paint: u32) -> bool {
    return ((paint & ONE_SIDED) != 0u) & (lens.cull == 1u);
}

fn facet(paint: u32, p: vec3i, q: vec3i, r: vec3i) -> Facet {
    let turn = area_sign(area(p, q, r));
    let bounds = on_film(span(p, q, r));
    let there = turn < 0 || (turn > 0 && !one_sided(paint));
    let seen = there && bounds.x <= bounds.z && bounds.y <= bounds.w;
    if (turn < 0) {
        return Facet(p, r, q, seen, bounds);
    }
    return Facet(p, q, r, seen, bounds);
}
