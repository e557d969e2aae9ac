// a ray and a tree -> the ray as the tree has it, and what the numbers of its leaves grow by
#import "tables/instance.wgsl"
#import "tables/settings.wgsl"
#import "trace/aim.wgsl"
#import "trace/instanced.wgsl"

struct Seat {
    ray: Ray,
    aim: Aim,
    per_length_squared: f32,
    // What a leaf's number grows by, so that it is a hit.
    numbers: u32,
    // What a leaf's id grows by.
    ids: u32,
    // What a leaf's id and its material grow by, so that they are those of its face.
    faces: u32,
    materials: u32,
}

// In the world's tree.
fn in_world(ray: Ray) -> Seat {
    let aim = aim_of(ray, settings.low, settings.high);
    let faces = 0u - settings.spheres - settings.planes;
    return Seat(ray, aim, 1.0 / dot(ray.direction, ray.direction), 0u, 0u, faces, 0u);
}

// In the tree of an instance's model.
fn in_instance(ray: Ray, number: u32) -> Seat {
    let placed = instance_at(number);
    let own = ray_within(ray, placed);
    let aim = aim_of(own, placed.low, placed.high);
    let numbers = settings.instances + placed.id - placed.leaves;
    return Seat(own, aim, 1.0 / dot(own.direction, own.direction), numbers, placed.id, placed.face, placed.material);
}
