// directions at a point -> the spec's diffuse and specular terms (1.2.3, "Illustration")
#import "math/power.wgsl"
#import "math/vector.wgsl"
#import "tables/settings.wgsl"

const SPECULAR: u32 = $specular;

// `n`: normal, `l`: to the light, `v`: to the eye; all of length one, n.l > 0, n.v >= 0.
fn phong(n: vec3f, l: vec3f, v: vec3f, exponent: f32) -> vec2f {
    var cosine: f32;
    if (SPECULAR == BLINN) {
        cosine = dot(unit(l + v), n);
    } else {
        cosine = dot(mirror(l, n), v);
    }
    return vec2f(max(0.0, dot(n, l)), power(max(0.0, cosine), exponent));
}
