//! what the shading of a sample tells -> the face that is seen, and all that its color comes from

use std::sync::atomic::Ordering::Relaxed;

use glam::{IVec3, Vec2, Vec3};

use super::caster::caster;
use super::drawn::{Corners, Drawn, Lit, Maps, Seen, Shadow};
use super::things;
use crate::cpu::raster::snap::{outcode, snap};
use crate::cpu::witness::{Fragment, Picture, Sight, Term, Witness};
use crate::scene::Scene;
use crate::tables::{Lamp, Lens, NO_DEPTH};

/// What was told.
#[derive(Debug, Default)]
pub(super) struct Heard {
    maps: Maps,
    tangents: Option<[Vec3; 2]>,
    fragment: Option<Fragment>,
    sight: Option<Sight>,
    lamps: Vec<(Option<Sight>, Term)>,
    pub(super) color: Vec3,
}

impl Witness for Heard {
    fn texel(&mut self, of: Picture, value: Vec3) {
        self.maps.put(of, value);
    }

    fn tangents(&mut self, tangents: [Vec3; 2]) {
        self.tangents = Some(tangents);
    }

    fn fragment(&mut self, told: &Fragment) {
        self.fragment = Some(*told);
    }

    fn shadow(&mut self, told: &Sight) {
        self.sight = Some(*told);
    }

    fn lamp(&mut self, told: &Term) {
        self.lamps.push((self.sight.take(), *told));
    }

    fn color(&mut self, color: Vec3) {
        self.color = color;
    }
}

impl Heard {
    /// What a sample sees; nothing where it is the background.
    pub(super) fn seen(
        self,
        drawn: &Drawn,
        scene: &Scene,
        eye: &Lens,
        at: Vec2,
        id: u32,
        depth: u32,
    ) -> Option<Seen> {
        let fragment = self.fragment?;
        let drawing = &*drawn.drawing;
        let face = drawing.faces[id as usize];
        let corners = [face.a, face.b, face.c].map(|i| drawing.vertices[i as usize].position);
        let lights =
            self.lamps.into_iter().zip(&drawing.lamps).enumerate().map(|(number, ((sight, term), lamp))| {
                let shadow = sight.map(|sight| shadow(drawn, scene, lamp, sight));
                Lit { light: things::light(scene, number), intensity: lamp.power, shadow, term }
            });
        let z = fragment.clip.map(|c| c.w);
        Some(Seen {
            thing: things::drawn(scene, id),
            corners,
            on_film: on_film(eye, &fragment, at),
            z: (z[0] * fragment.weights.x + z[1] * fragment.weights.y) + z[2] * fragment.weights.z,
            depth,
            maps: self.maps,
            tangents: self.tangents,
            fragment,
            lights: lights.collect(),
            ambient: drawing.canvas.ambient,
        })
    }
}

/// The corners as they are drawn, in whole 1/256 of a pixel, and the edges as coverage asks for them, before they are
/// cut to 32 bits.
fn on_film(eye: &Lens, fragment: &Fragment, at: Vec2) -> Option<Corners> {
    if fragment.clip.iter().any(|&c| outcode(eye, c) != 0) {
        return None;
    }
    // As seen from the sample, which is the middle of the lens's only pixel.
    let corners = fragment.clip.map(|c| (snap(eye, c) - IVec3::new(128, 128, 0)).truncate().as_dvec2() / 256.0);
    let [a, b, c] = corners;
    let areas = [b.perp_dot(c), c.perp_dot(a), a.perp_dot(b)];
    let all: f64 = areas.iter().sum();
    Some(Corners {
        places: corners.map(|corner| at.as_dvec2() + corner),
        edges: areas.map(|area| area * all.signum()),
        weights: areas.map(|area| area / all),
    })
}

fn shadow(drawn: &Drawn, scene: &Scene, lamp: &Lamp, sight: Sight) -> Shadow {
    let lens = &drawn.drawing.lenses[sight.lens as usize];
    let side = lens.width;
    let map = lamp.sides().get((sight.lens - lamp.lens) as usize).copied().unwrap_or_default();
    let Some(texel) = sight.texel else {
        return Shadow { sight, map, side, stored: None, bias: None, caster: None };
    };
    let column = texel.column.clamp(0, lens.width as i32 - 1) as u32;
    let row = texel.row.clamp(0, lens.height as i32 - 1) as u32;
    let near = drawn.shadows.nears[(lens.first + row * lens.width + column) as usize].load(Relaxed);
    let stored = (near > 0).then_some(NO_DEPTH - near);
    let caster = stored.and_then(|_| caster(&drawn.drawing, lens, [column, row]));
    Shadow {
        sight,
        map,
        side,
        stored,
        bias: stored.zip(caster).map(|(stored, caster)| stored.saturating_sub(caster.depth)),
        caster: caster.map(|caster| things::drawn(scene, caster.id)),
    }
}
