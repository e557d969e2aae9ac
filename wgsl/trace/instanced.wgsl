// an instance of a model -> a ray as the model sees it, and what it meets there as the world sees it
#import "math/fence.wgsl"
#import "shade/look.wgsl"
#import "tables/instance.wgsl"
#import "trace/aim.wgsl"
#import "trace/hold.wgsl"

// Halvings of all instances until one is left.
const HALVINGS: u32 = $halvings;

// The distances along the ray are the same: its direction shrinks with the world.
fn ray_within(ray: Ray, placed: Instance) -> Ray {
    let away = fence(ray.origin - placed.origin, settings.zero);
    let d = ray.direction;
    let start = vec3f(dot(away, placed.x), dot(away, placed.y), dot(away, placed.z)) * placed.shrink;
    let way = vec3f(dot(d, placed.x), dot(d, placed.y), dot(d, placed.z)) * placed.shrink;
    return Ray(fence(start, settings.zero), fence(way, settings.zero), ray.leaves);
}

// A point of the model in the world.
fn point_of(p: vec3f, placed: Instance) -> vec3f {
    return fence(sum_by(p, placed.x, placed.y, placed.z) + placed.origin, settings.zero);
}

// The instance that a hit belongs to, or NONE. Hits on instances are numbered by ids, after all leaves of the world.
fn instance_of(hit: u32) -> u32 {
    let id = hit - settings.instances;
    var found = 0u;
    #repeat halvings
    {
        let next = found + (1u << (HALVINGS - 1u - $iu));
        let last = max(settings.instances, 1u) - 1u;
        // No `&&`: its branch would hang on a uniform alone at first, and lavapipe would compile anew for each dispatch.
        found = select(found, next, (next <= last) & (first_id_of(min(next, last)) <= id));
    }
    #end
    return select(NONE, found, hit >= settings.loose + settings.instances);
}

// What a ray has met: in the world, with its own id and material.
struct Primitive {
    leaf: Leaf,
    // Of a triangle.
    face: u32,
    // The instance that it is part of, or NONE.
    holder: u32,
    margin: f32,
}

fn primitive_at(hit: u32) -> Primitive {
    var found = Primitive(leaf_at(hit), 0u, NONE, 0.0);
    found.face = found.leaf.id - settings.spheres - settings.planes;
    #repeat copies
    found.holder = instance_of(hit);
    if (found.holder != NONE) {
        let placed = instance_at(found.holder);
        let own = leaf_at(hit - settings.instances - placed.id + placed.leaves);
        found.leaf = Leaf(
            point_of(own.a, placed), own.id + placed.id, point_of(own.b, placed), own.material + placed.material,
            point_of(own.c, placed), own.kind,
        );
        found.face = own.id + placed.face;
        found.margin = placed.margin;
    }
    #end
    return found;
}

// A corner of a face in the world.
fn corner_of(i: u32, holder: u32) -> Vertex {
    var corner = vertex_at(i);
    #repeat copies
    if (holder != NONE) {
        let placed = instance_at(holder);
        corner.position = point_of(corner.position, placed);
        corner.normal = unit(fence(sum_by(corner.normal, placed.x, placed.y, placed.z), settings.zero));
    }
    #end
    return corner;
}
