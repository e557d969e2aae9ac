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
    let planes_from = settings.spheres;
    let triangles_from = planes_from + settings.planes;
    var point = along;
    var normal = vec3f(0.0);
    var material = 0u;
    if (hit < planes_from) {
        let center = spheres[hit].center;
        normal = unit(along - center);
        point = center + normal * spheres[hit].radius;
        material = spheres[hit].material;
    } else if (hit < triangles_from) {
        let i = hit - planes_from;
        normal = planes[i].normal;
        point = along - normal * dot(normal, along - planes[i].point);
        material = planes[i].material;
    } else {
        let i = hit - triangles_from;
        let a = triangles[i].a;
        normal = unit(cross(triangles[i].b - a, triangles[i].c - a));
        point = along - normal * dot(normal, along - a);
        material = triangles[i].material;
    }
    if (dot(normal, ray.direction) > 0.0) {
        normal = -normal;
    }
    return Surface(point, normal, materials[material]);
}
