// a hit -> the point, the normals that face the ray, and the material
#import "tables/material.wgsl"
#import "math/vector.wgsl"
#import "trace/detail.wgsl"

@group(0) @binding(4) var<storage, read> materials: array<Material>;

struct Surface {
    point: vec3f,
    // Of the primitive.
    normal: vec3f,
    // That it is lit by: between a triangle's corners, and as a normal map says.
    shading: vec3f,
    material: Material,
    // Weight of the specular term.
    specular: vec3f,
    // How far off the point rays start: triangles have neighbors, of which some are off by rounding.
    margin: f32,
    // Back along the ray that came, of length one.
    back: vec3f,
}

// Where a ray starts that goes on this way.
fn start_of(surface: Surface, way: vec3f) -> vec3f {
    // Half of it back along the ray: so it is off the wall beside an edge, too, and through no thin sheet.
    let before = (surface.normal + surface.back) * 0.5;
    let off = select(before, -surface.normal, dot(way, surface.normal) < 0.0);
    return select(surface.point, surface.point + off * surface.margin, surface.margin > 0.0);
}

// The point is put back onto the primitive, so that its error does not grow with the ray's length.
fn surface_at(ray: Ray, t: f32, hit: u32) -> Surface {
    let along = ray.origin + ray.direction * t;
    let primitive = primitive_at(hit);
    let leaf = primitive.leaf;
    var point = along;
    var normal = vec3f(0.0);
    var margin = 0.0;
    if (leaf.kind == SPHERE) {
        normal = unit(along - leaf.a);
        point = leaf.a + normal * leaf.b.x;
    } else if (leaf.kind == PLANE) {
        normal = leaf.b;
        point = along - normal * dot(normal, along - leaf.a);
    } else {
        normal = unit_of_any(cross(leaf.b - leaf.a, leaf.c - leaf.a));
        point = along - normal * dot(normal, along - leaf.a);
        // 16 units in the last place of the largest coordinate.
        let size = max(abs(leaf.a), max(abs(leaf.b), abs(leaf.c)));
        margin = max(max(size.x, max(size.y, size.z)) * 9.536743e-7, primitive.margin);
    }
    let detail = detail_at(ray, primitive, point, normal);
    var shading = detail.normal;
    if (dot(normal, ray.direction) > 0.0) {
        normal = -normal;
        shading = -shading;
    }
    var material = materials[leaf.material];
    material.color *= detail.look.color;
    material.exponent = detail.look.exponent;
    let size = dot(material.color, material.color);
    material.tint = select(vec3f(0.0), unit(material.color), size > 0.0);
    return Surface(point, normal, shading, material, detail.look.specular, margin, -unit(ray.direction));
}
