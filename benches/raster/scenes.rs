//! Sheets of triangles before the eye, layer behind layer.

use bytemuck::Zeroable as _;
use glam::Vec3;
use twinlight::prepare::lens::{Pose, orthographic, perspective};
use twinlight::tables::{Canvas, Drawing, Face, Paint, Vertex};

/// Random numbers of a fixed seed: a PCG hash of a counter.
pub(crate) struct Dice(u32);

impl Dice {
    fn bits(&mut self) -> u32 {
        self.0 = self.0.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        let word = ((self.0 >> ((self.0 >> 28) + 4)) ^ self.0).wrapping_mul(277_803_737);
        (word >> 22) ^ word
    }

    fn unit(&mut self) -> f32 {
        (self.bits() >> 8) as f32 / 16_777_216.0
    }
}

/// `layers` sheets of `columns` x `rows` quads that each fill the view, nearest neither first nor last.
pub(crate) fn sheets(size: [u32; 2], [columns, rows]: [u32; 2], layers: u32) -> Drawing {
    let mut dice = Dice(7);
    let aspect = size[0] as f32 / size[1] as f32;
    let pose = Pose { eye: Vec3::ZERO, axes: [Vec3::X, Vec3::Y, Vec3::Z] };
    let lens = perspective(&pose, [aspect, 1.0], [0.5, 100.0], size, [0.0; 2]);
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    for layer in 0..layers {
        let deep = 2.0 + ((layer * 5 + 3) % layers.max(1)) as f32;
        let first = vertices.len() as u32;
        for j in 0..=rows {
            for i in 0..=columns {
                let inner = i > 0 && i < columns && j > 0 && j < rows;
                let mut shake = || if inner { dice.unit() * 0.5 - 0.25 } else { 0.0 };
                let u = (i as f32 + shake()) / columns as f32;
                let v = (j as f32 + shake()) / rows as f32;
                let z = deep + 0.3 * ((u * 9.0).sin() * (v * 7.0).cos());
                let position = Vec3::new((u * 2.0 - 1.0) * aspect * z, (v * 2.0 - 1.0) * z, -z);
                vertices.push(Vertex { position, u, normal: Vec3::Z, v });
            }
        }
        for j in 0..rows {
            for i in 0..columns {
                let a = first + j * (columns + 1) + i;
                let (b, c, d) = (a + 1, a + columns + 2, a + columns + 1);
                faces.push(Face { a, b, c, paint: 0 });
                faces.push(Face { a, b: c, c: d, paint: 0 });
            }
        }
    }
    Drawing {
        eyes: vec![lens],
        most: u32::MAX,
        lenses: Vec::new(),
        canvas: Canvas::zeroed(),
        vertices,
        faces,
        paints: vec![Paint::zeroed()],
        lamps: Vec::new(),
        texels: vec![0; 256],
    }
}

/// The same faces in random order (Fisher and Yates).
pub(crate) fn shuffled(mut drawing: Drawing) -> Drawing {
    let mut dice = Dice(11);
    for i in (1..drawing.faces.len()).rev() {
        drawing.faces.swap(i, dice.bits() as usize % (i + 1));
    }
    drawing
}

/// The same faces, the farthest layer first, so that none hides the next: layers are a unit apart.
pub(crate) fn farthest_first(mut drawing: Drawing) -> Drawing {
    drawing.faces.sort_by_key(|face| drawing.vertices[face.a as usize].position.z.round() as i32);
    drawing
}

/// The drawing under a sun of its own, whose shadow map the whole of it fills.
pub(crate) fn lit(mut drawing: Drawing) -> Drawing {
    let toward = Vec3::new(0.3, 0.4, 1.0).normalize();
    let axes = [Vec3::Y.cross(toward).normalize(), toward.cross(Vec3::Y.cross(toward)).normalize(), toward];
    let pose = Pose { eye: Vec3::new(0.0, 0.0, -2.0) + toward * 8.0, axes };
    let side = drawing.lenses[0].width;
    let old = drawing.lenses[0];
    let lens = orthographic(&pose, [4.6; 2], [1.0, 20.0], [side; 2]);
    drawing.lenses[0] = twinlight::tables::Lens { first: 0, bias: old.bias, slope: old.slope, ..lens };
    drawing.lamps[0].place = toward;
    drawing.canvas.eye = Vec3::ZERO;
    drawing
}
