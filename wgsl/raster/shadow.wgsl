// a point and a light -> the share of the light that reaches it
#import "tables/paint.wgsl"
#import "tables/light.wgsl"
#import "tables/texel.wgsl"
#import "tables/settings.wgsl"
#import "raster/snap.wgsl"

const BLUR: i32 = $blur;

// Which of its lenses a lamp sees a point through: for a point light, the axis that the way there is longest along; of a
// nested one's two the first, if that sees it.
fn lens_of(lamp: Lamp, p: vec3f) -> u32 {
#if nested
    if (lamp.kind == NESTED) {
        let by = lamp.lens * 8u;
        let x = along(bitcast<vec4f>(texel(lenses, by)), p);
        let y = along(bitcast<vec4f>(texel(lenses, by + 1u)), p);
        let w = along(bitcast<vec4f>(texel(lenses, by + 3u)), p);
        return lamp.lens + select(1u, 0u, abs(x) <= w && abs(y) <= w);
    }
#end
    if (lamp.kind != POINT) {
        return lamp.lens;
    }
    let way = p - lamp.place;
    let size = abs(way);
    if (size.x >= size.y && size.x >= size.z) {
        return lamp.lens + select(0u, 1u, way.x < 0.0);
    }
    if (size.y >= size.z) {
        return lamp.lens + select(2u, 3u, way.y < 0.0);
    }
    return lamp.lens + select(4u, 5u, way.z < 0.0);
}

// What f32 rounds off two depths near one; more where they are the rest of larger numbers.
const ROUNDED: f32 = 2.3841858e-7;

// Depths are compared as they were drawn, in integers. What the slope makes of a texel is in the drawn ones; the bias is
// taken from the point's: a share of what the lens sees across there, which grows with the distance, while depths show
// less of a way by its square.
fn reaches(lamp: Lamp, p: vec3f) -> f32 {
    if (lamp.lens == NONE) {
        return 1.0;
    }
    // A lens is eight texels: its rows, then what its image is.
    let by = lens_of(lamp, p) * 8u;
    let x = along(bitcast<vec4f>(texel(lenses, by)), p);
    let y = along(bitcast<vec4f>(texel(lenses, by + 1u)), p);
    let deeper = bitcast<vec4f>(texel(lenses, by + 2u));
    let z = along(deeper, p);
    let w = along(bitcast<vec4f>(texel(lenses, by + 3u)), p);
    let film = texel(lenses, by + 4u);
    // What lies beyond the far plane lies behind all that is drawn.
    if (!(abs(x) <= w && abs(y) <= w && z >= 0.0)) {
        return 1.0;
    }
    let width = i32(film.x);
    let height = i32(film.y);
    let column = i32(floor((hold(x / w) * 0.5 + 0.5) * f32(width)));
    let row = i32(floor((0.5 - hold(y / w) * 0.5) * f32(height)));
    let terms = abs(deeper.xyz * p);
    let size = hold(hold(terms.x + terms.y) + terms.z) + abs(deeper.w);
    let rounded = ROUNDED + hold(ROUNDED * hold(size / w));
    let bias = max(hold(bitcast<f32>(texel(lenses, by + 5u).z) / w), rounded);
    let depth = u32(clamp(hold(z / w) - bias, 0.0, 1.0) * f32(DEEP));
    var open = 0;
    for (var j = -BLUR; j <= BLUR; j++) {
        for (var i = -BLUR; i <= BLUR; i++) {
            let at = clamp(row + j, 0, height - 1) * width + clamp(column + i, 0, width - 1);
            if (depth <= NO_DEPTH - shadows[film.z + u32(at)]) {
                open++;
            }
        }
    }
    return f32(open) / f32((2 * BLUR + 1) * (2 * BLUR + 1));
}
