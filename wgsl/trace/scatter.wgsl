// a ray at a surface -> the reflected and the refracted path (spec 2.1, steps 3 and 4)
#import "math/random.wgsl"
#import "math/sphere.wgsl"
#import "math/vector.wgsl"
#import "trace/surface.wgsl"

struct Branch {
    direction: vec3f,
    weight: vec3f,
    inside: u32,
}

struct Branches {
    reflected: Branch,
    refracted: Branch,
}

// `random`: two numbers of the ray's own.
fn scatter(direction: vec3f, inside: u32, surface: Surface, random: vec2f) -> Branches {
    let material = surface.material;
    // A normal that is bent so far that the mirror direction lies below the surface counts for nothing.
    var n = surface.shading;
    if (!(dot(direction, n) < 0.0 && dot(mirror(-direction, n), surface.normal) > 0.0)) {
        n = surface.normal;
    }
    let reflection = mirror(-direction, n);
    var reflected = Branch(reflection, vec3f(material.reflect_weight), inside);
    var refracted = Branch(reflection, vec3f(0.0), inside);

    #repeat diffuse
    if (material.behavior == DIFFUSE) {
        // Anywhere in the hemisphere around the mirror direction.
        let free = on_sphere(random.x, random.y);
        let cosine = dot(free, reflection);
        reflected.direction = select(free, -free, cosine < 0.0);
        reflected.weight = material.tint * (material.reflect_weight * abs(cosine));
    }
    #end

    #repeat glass
    if (material.behavior == GLASS) {
        // Eq. 2.7, with `i` the ray's own direction.
        let ratio = select(1.0 / material.index, material.index, inside == 1u);
        let cosine = dot(direction, n);
        let root = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
        let bent = unit(direction * ratio - n * (ratio * cosine + sqrt(root)));
        // What a bent normal would refract to this side of the surface does not get through either.
        let above = any(n != surface.normal) && dot(bent, surface.normal) > 0.0;
        if (root < 0.0 || above) {
            // Beyond the critical angle everything is reflected.
            reflected.weight = vec3f(material.reflect_weight + material.refract_weight);
        } else {
            refracted.direction = bent;
            refracted.weight = vec3f(material.refract_weight);
            refracted.inside = 1u - inside;
        }
    }
    #end
    return Branches(reflected, refracted);
}
