//! faces -> portions, so that what is drawn of some hides much of the next

use std::ops::Range;

use glam::{Vec2, Vec3};

use crate::tables::{CUT_OUT, Drawing, Face, Lens, REGION};

/// Faces that are looked at.
const SAMPLED: usize = 1024;
/// How often a portion covers the film. To ask what hides the next one takes a quarter of the time that drawing one layer
/// does, and of the third layer two thirds are hidden if their order is any.
const LAYERS: f32 = 2.0;
/// Faces of a portion, at least.
const LEAST: u32 = 1 << 12;

/// How a drawing's faces are divided. Nothing of it shows in the picture.
#[derive(Debug, Clone)]
pub struct Portions {
    /// So many portions, whatever is reckoned; at most one a face.
    pub fixed: Option<u32>,
    faces: u32,
    /// Some of those that may hide others, in world space.
    sample: Vec<[Vec3; 3]>,
    /// For how many faces each of them stands.
    each: f32,
}

impl Portions {
    pub(crate) fn new(drawing: &Drawing) -> Self {
        let faces = &drawing.faces;
        let count = faces.len().min(SAMPLED);
        let corners = |face: &Face| [face.a, face.b, face.c].map(|i| drawing.vertices[i as usize].position);
        let looked_at = (0..count).map(|k| &faces[k * faces.len() / count]);
        let sample = looked_at.filter(|face| face.paint & CUT_OUT == 0).map(corners).collect();
        Self { fixed: None, faces: faces.len() as u32, sample, each: faces.len() as f32 / count.max(1) as f32 }
    }

    pub(crate) fn faces(&self) -> u32 {
        self.faces
    }

    /// Ranges of faces, one after the other; one at least.
    pub(crate) fn of(&self, lens: &Lens) -> Vec<Range<u32>> {
        let reckoned = (self.layers(lens) / LAYERS).round() as u32;
        let count = self.fixed.unwrap_or(reckoned.min(self.faces / LEAST)).clamp(1, self.faces.max(1));
        let at = |i: u32| (u64::from(i) * u64::from(self.faces) / u64::from(count)) as u32;
        (0..count).map(|i| at(i)..at(i + 1)).collect()
    }

    /// How often the small faces cover the film, about.
    fn layers(&self, lens: &Lens) -> f32 {
        let pixels: f32 = self.sample.iter().map(|corners| pixels(lens, *corners)).sum();
        pixels * self.each / lens.pixels().max(1) as f32
    }
}

/// How many a face covers, about, if it is small and its middle is seen.
fn pixels(lens: &Lens, in_world: [Vec3; 3]) -> f32 {
    let on_film = in_world.map(|p| {
        let [x, y, z, w] = [lens.x, lens.y, lens.z, lens.w].map(|row| row.dot(p.extend(1.0)));
        let half = Vec2::new(lens.span_x as f32, lens.span_y as f32) / 2.0;
        (w > 0.0 && z >= 0.0 && w >= z).then(|| half + half * Vec2::new(x, -y) / w)
    });
    let [Some(p), Some(q), Some(r)] = on_film else { return 0.0 };
    let start = Vec2::new((lens.left % REGION) as f32, (lens.top % REGION) as f32);
    let middle = (p + q + r) / 3.0 - start;
    let seen =
        middle.cmpge(Vec2::ZERO).all() && middle.cmplt(Vec2::new(lens.width as f32, lens.height as f32)).all();
    let size = p.max(q).max(r) - p.min(q).min(r);
    if seen && size.max_element() < lens.small as f32 { (q - p).perp_dot(r - p).abs() / 2.0 } else { 0.0 }
}
