// a ray and a scene of few primitives -> its nearest hit, whether it is free, and the surface; all without loops
#import "tables/light.wgsl"
#import "trace/surface.wgsl"

struct Few {
    spheres: array<Sphere, FEW>,
    planes: array<Plane, FEW>,
    materials: array<Material, FEW>,
    lights: array<Light, FEW>,
}

const FEW: u32 = 16u;

@group(0) @binding(5) var<uniform> scene: Few;

// The scene in registers: in a loop, lavapipe would read a buffer lane by lane.
var<private> own: Few;

// Here a hit is a primitive's number: spheres, then planes.
struct Found {
    t: f32,
    hit: u32,
}

fn nearest(ray: Ray) -> Found {
    var found = Found(FAR, NONE);
    let per_length_squared = 1.0 / dot(ray.direction, ray.direction);
    #repeat spheres
    {
        let t = meet_sphere(ray, own.spheres[$i], per_length_squared, ray.leaves == $iu);
        let nearer = t < found.t;
        found.t = select(found.t, t, nearer);
        found.hit = select(found.hit, $iu, nearer);
    }
    #end
    #repeat planes
    {
        let i = settings.spheres + $iu;
        let t = meet_plane(ray, own.planes[$i]);
        let nearer = t < found.t && ray.leaves != i;
        found.t = select(found.t, t, nearer);
        found.hit = select(found.hit, i, nearer);
    }
    #end
    return found;
}

// Whether nothing stands in the ray's way up to `reach`.
fn free(ray: Ray, reach: f32) -> bool {
    var free = true;
    let per_length_squared = 1.0 / dot(ray.direction, ray.direction);
    #repeat spheres
    free = free && !(meet_sphere(ray, own.spheres[$i], per_length_squared, ray.leaves == $iu) < reach);
    #end
    #repeat planes
    free = free && !(meet_plane(ray, own.planes[$i]) < reach && ray.leaves != settings.spheres + $iu);
    #end
    return free;
}

// `surface_at`, by choice instead of by index.
fn surface_of(ray: Ray, t: f32, hit: u32) -> Surface {
    let along = ray.origin + ray.direction * t;
    var place = vec3f(0.0);
    var radius = 0.0;
    var normal = vec3f(0.0);
    var number = 0u;
    #repeat spheres
    place = select(place, own.spheres[$i].center, hit == $iu);
    radius = select(radius, own.spheres[$i].radius, hit == $iu);
    number = select(number, own.spheres[$i].material, hit == $iu);
    #end
    #repeat planes
    place = select(place, own.planes[$i].point, hit == settings.spheres + $iu);
    normal = select(normal, own.planes[$i].normal, hit == settings.spheres + $iu);
    number = select(number, own.planes[$i].material, hit == settings.spheres + $iu);
    #end
    var point = along - normal * dot(normal, along - place);
    if (hit < settings.spheres) {
        normal = unit(along - place);
        point = place + normal * radius;
    }
    if (dot(normal, ray.direction) > 0.0) {
        normal = -normal;
    }
    var material = own.materials[0];
    #repeat materials
    material.color = select(material.color, own.materials[$i].color, number == $iu);
    material.local_weight = select(material.local_weight, own.materials[$i].local_weight, number == $iu);
    material.tint = select(material.tint, own.materials[$i].tint, number == $iu);
    material.reflect_weight = select(material.reflect_weight, own.materials[$i].reflect_weight, number == $iu);
    material.refract_weight = select(material.refract_weight, own.materials[$i].refract_weight, number == $iu);
    material.exponent = select(material.exponent, own.materials[$i].exponent, number == $iu);
    material.index = select(material.index, own.materials[$i].index, number == $iu);
    material.behavior = select(material.behavior, own.materials[$i].behavior, number == $iu);
    #end
    return Surface(point, normal, normal, material, vec3f(1.0), 0.0, vec3f(0.0));
}
