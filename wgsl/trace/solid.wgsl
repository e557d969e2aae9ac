// a triangle that a ray meets -> whether it is there: not seen from its back, and not where its picture has a hole
#import "shade/look.wgsl"
#import "trace/hold.wgsl"
#import "trace/triangle.wgsl"

// What stands in a light's way, as `any` asks, has two sides: so it is drawn, too. `number` of its face and `material`
// are the triangle's own, whichever tree it lies below.
fn is_solid(ray: Ray, aim: Aim, leaf: Leaf, number: u32, material: u32, any: bool) -> bool {
    let a = turned(leaf.a - ray.origin, aim.axis);
    let b = turned(leaf.b - ray.origin, aim.axis);
    let c = turned(leaf.c - ray.origin, aim.axis);
    let e = edges(a, b, c, aim);
    let area = e.x + (e.y + e.z);
    var solid = true;
    #repeat one_sided
    let front = (area > 0.0) == (aim.shear.z > 0.0);
    solid = any || front || (leaf.kind & ONE_SIDED) == 0u;
    #end
    #repeat cut_out
    if (solid && (leaf.kind & CUT_OUT) != 0u) {
        let face = face_at(number);
        let uv = uv_by(e / area, vertex_at(face.a), vertex_at(face.b), vertex_at(face.c));
        solid = is_there(paint_at(material).opacity_map, uv);
    }
    #end
    return solid;
}
