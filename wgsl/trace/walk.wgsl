// a ray and the scene -> its nearest hit, or the first that stands in its way
#import "tables/sphere.wgsl"
#import "tables/plane.wgsl"
#import "tables/triangle.wgsl"
#import "tables/settings.wgsl"
#import "tables/path.wgsl"
#import "trace/meet.wgsl"

// Primitives are counted through: spheres, then planes, then triangles.
@group(0) @binding(0) var<uniform> settings: Settings;
@group(0) @binding(1) var<storage, read> spheres: array<Sphere>;
@group(0) @binding(2) var<storage, read> planes: array<Plane>;
@group(0) @binding(3) var<storage, read> triangles: array<Triangle>;

struct Found {
    // Only what is nearer than this counts; the distance to the hit once there is one.
    t: f32,
    hit: u32,
    // The next primitive to test.
    next: u32,
}

fn primitives() -> u32 {
    return settings.spheres + settings.planes + settings.triangles;
}

// Tests the primitives from `start.next` up to `end`; with `any`, stops at the first that is met.
// Of two at one distance the one with the lower number is met, as only a nearer one replaces it.
fn walk(ray: Ray, start: Found, end: u32, any: bool) -> Found {
    var found = start;
    let per_length_squared = 1.0 / dot(ray.direction, ray.direction);
    let planes_from = settings.spheres;
    let triangles_from = planes_from + settings.planes;

    let spheres_end = min(end, planes_from);
    while (found.next < spheres_end && !(any && found.hit != NONE)) {
        let i = found.next;
        let t = meet_sphere(ray, spheres[i], per_length_squared, ray.leaves == i);
        if (t < found.t) {
            found.t = t;
            found.hit = i;
        }
        found.next = i + 1u;
    }

    let planes_end = min(end, triangles_from);
    while (found.next < planes_end && !(any && found.hit != NONE)) {
        let i = found.next;
        let t = meet_plane(ray, planes[i - planes_from]);
        if (t < found.t && ray.leaves != i) {
            found.t = t;
            found.hit = i;
        }
        found.next = i + 1u;
    }

    let sheared = shear_of(ray.direction);
    while (found.next < end && !(any && found.hit != NONE)) {
        let i = found.next;
        let t = meet_triangle(ray, triangles[i - triangles_from], sheared);
        if (t < found.t && ray.leaves != i) {
            found.t = t;
            found.hit = i;
        }
        found.next = i + 1u;
    }
    return found;
}
