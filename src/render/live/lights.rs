//! the depths that a light sees -> a picture of them, small enough for a window

use crate::tables::{Drawing, Lens, NO_DEPTH, NONE};

/// Pixels a side of such a picture at most.
const MOST: u32 = 512;

/// What a light sees, as it was drawn.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LightMap {
    /// As `light 2, +x`.
    pub name: String,
    /// Texels across and down of the map itself.
    pub size: [u32; 2],
    /// Pixels across and down of the picture.
    pub shown: [u32; 2],
    /// Row by row: near is bright, and nothing is black.
    pub grays: Vec<u8>,
}

/// Pictures of what the lights of a drawing see; `depths`: their images, one after the other.
pub(super) fn light_maps(drawing: &Drawing, depths: &[u32]) -> Vec<LightMap> {
    let mut maps = Vec::new();
    for (lamp, number) in drawing.lamps.iter().zip(1..).filter(|(lamp, _)| lamp.lens != NONE) {
        for (side, lens) in lamp.sides().iter().zip(&drawing.lenses[lamp.lens as usize..]) {
            let name = if side.is_empty() { format!("light {number}") } else { format!("light {number}, {side}") };
            maps.push(light_map(name, lens, depths));
        }
    }
    maps
}

fn light_map(name: String, lens: &Lens, depths: &[u32]) -> LightMap {
    let size = [lens.width, lens.height];
    let step = lens.width.max(lens.height).div_ceil(MOST).max(1);
    let shown = size.map(|side| side.div_ceil(step));
    let at = |[x, y]: [u32; 2]| depths.get((lens.first + y * lens.width + x) as usize).copied().unwrap_or(NO_DEPTH);
    let places = (0..shown[1]).flat_map(|y| (0..shown[0]).map(move |x| [x * step, y * step]));
    let seen: Vec<u32> = places.map(at).collect();
    // From the nearest to the farthest: most of a map's range is the way there.
    let there = || seen.iter().copied().filter(|depth| *depth != NO_DEPTH);
    let (near, far) = (there().min().unwrap_or(0), there().max().unwrap_or(0));
    let range = u64::from(far - near).max(1);
    let gray = |depth: &u32| if *depth == NO_DEPTH { 0 } else { 40 + (u64::from(far - depth) * 215 / range) as u8 };
    LightMap { name, size, shown, grays: seen.iter().map(gray).collect() }
}
