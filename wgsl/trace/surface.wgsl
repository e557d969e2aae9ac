// a hit -> the point, the normal that faces the ray, and the material
#import "tables/material.wgsl"
#import "math/vector.wgsl"
#import "trace/walk.wgsl"

@group(0) @binding(4) var<storage, read> materials: array<Material>;

struct Surface {
    point: vec3f,
    normal: vec3f,
    material: Material,
}

// The point is put back onto the primitive, so that its error does not grow with the ray's length.
fn surface_at(ray: Ray, t: f32, hit: u32) -> Surface {
    let along = ray.origin + ray.direction * t;
    let leaf = leaves[hit];
    var point = along;
    var normal = vec3f(0.0);
    if (leaf.kind == SPHERE) {
        normal = unit(along - leaf.a);
        point = leaf.a + normal * leaf.b.x;
    } else if (leaf.kind == PLANE) {
        normal = leaf.b;
        point = along - normal * dot(normal, along - leaf.a);
    } else {
        normal = unit(cross(leaf.b - leaf.a, leaf.c - leaf.a));
        point = along - normal * dot(normal, along - leaf.a);
    }
    if (dot(normal, ray.direction) > 0.0) {
        normal = -normal;
    }
    return Surface(point, normal, materials[leaf.material]);
}
