//! a triangle that a ray meets -> whether it is there: not seen from its back, and not where its picture has a hole

use crate::cpu::shade::look::uv_by;
use crate::cpu::shade::texture::is_there;
use crate::cpu::trace::seat::Seat;
use crate::cpu::trace::triangle::areas;
use crate::tables::{CUT_OUT, Leaf, ONE_SIDED, Tables};

/// What stands in a light's way, as `any` asks, has two sides: so it is drawn, too. `number` of its face and `material`
/// are the triangle's own, whichever tree it lies below.
#[must_use]
pub fn is_solid(tables: &Tables, seat: &Seat, leaf: &Leaf, [number, material]: [u32; 2], any: bool) -> bool {
    let areas = areas(seat, leaf);
    let area = areas.x + (areas.y + areas.z);
    let front = (area > 0.0) == (seat.aim.shear.z > 0.0);
    let solid = any || front || leaf.kind & ONE_SIDED == 0;
    if !solid || leaf.kind & CUT_OUT == 0 {
        return solid;
    }
    let face = tables.faces[number as usize];
    let vertices = [face.a, face.b, face.c].map(|i| &tables.vertices[i as usize]);
    let uv = uv_by(areas / area, vertices);
    is_there(&tables.texels, tables.settings.filtering, &tables.paints[material as usize].opacity_map, uv)
}
