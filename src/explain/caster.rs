//! a texel of a shadow map -> the face whose depth it holds, and that depth before the bias

use bytemuck::Zeroable as _;

use crate::cpu::raster::CpuRaster;
use crate::raster::{Raster as _, Seen, draw, marked};
use crate::tables::{Drawing, Face, Lens, Map, NONE, Paint};

/// What casts a shadow.
#[derive(Debug, Clone, Copy)]
pub(super) struct Caster {
    pub(super) id: u32,
    /// Without the bias, of [`DEEP`](crate::tables::DEEP).
    pub(super) depth: u32,
}

/// The texel drawn again, alone and with ids; then what was found there drawn alone, without a bias.
pub(super) fn caster(drawing: &Drawing, lens: &Lens, [column, row]: [u32; 2]) -> Option<Caster> {
    let texel = Lens { first: 0, ..lens.window(&[column..column + 1, row..row + 1]) };
    let id = seen(drawing, &texel).1[0];
    let face = drawing.faces.get(id as usize)?;
    let none = Map { first: NONE, ..Map::zeroed() };
    let bare = Paint {
        diffuse_map: none,
        normal_map: none,
        specular_map: none,
        exponent_map: none,
        opacity_map: none,
        ..Paint::zeroed()
    };
    let alone = Drawing {
        eyes: Vec::new(),
        most: drawing.most,
        lenses: Vec::new(),
        canvas: drawing.canvas,
        vertices: [face.a, face.b, face.c].map(|i| drawing.vertices[i as usize]).to_vec(),
        faces: vec![Face { a: 0, b: 1, c: 2, paint: 0 }],
        paints: vec![bare],
        lamps: Vec::new(),
        texels: Vec::new(),
    };
    let depth = seen(&alone, &Lens { slope: 0, ..texel }).0[0];
    Some(Caster { id, depth })
}

fn seen(drawing: &Drawing, texel: &Lens) -> Seen {
    let mut stages = CpuRaster::new(drawing);
    let Ok(mut image) = stages.image(1, true);
    let Ok(()) = draw(&mut stages, texel, &mut image);
    let Ok(()) = marked(&mut stages, texel, &mut image);
    image.seen()
}
