// three corners in fixed point -> a facet that is drawn at once, piece by piece, or not at all
#import "tables/mesh.wgsl"
#import "raster/plan.wgsl"

const NOTHING: u32 = 0u;
const SMALL: u32 = 1u;
const LARGE: u32 = 2u;

// A triangle on the film, turned so that its area is above zero.
struct Facet {
    p: vec3i,
    q: vec3i,
    r: vec3i,
    kind: u32,
    // First and last column and row of its bounding box on the film.
    bounds: vec4i,
}

fn facet(paint: u32, p: vec3i, q: vec3i, r: vec3i) -> Facet {
    // y runs down the film, so that what is counterclockwise in the world has an area below zero here.
    let turn = area_sign(area(p, q, r));
    let hidden = lens.cull == 1u && (paint & ONE_SIDED) != 0u && turn > 0;
    let whole = span(p, q, r);
    let bounds = on_film(whole);
    var kind = NOTHING;
    if (turn != 0 && !hidden && bounds.x <= bounds.z && bounds.y <= bounds.w) {
        let side = max(whole.z - whole.x, whole.w - whole.y) + 1;
        kind = select(LARGE, SMALL, side <= i32(lens.small));
    }
    if (turn < 0) {
        return Facet(p, r, q, kind, bounds);
    }
    return Facet(p, q, r, kind, bounds);
}
