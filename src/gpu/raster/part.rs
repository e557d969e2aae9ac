//! vertices and faces -> parts of them that can be bound

use crate::gpu::{Buffer, Error, Gpu, Texels};
use crate::tables::{Corner, Drawing, Face, Part, Vertex};

/// Some of a drawing's faces, with the vertices that they use.
#[derive(Debug)]
pub(super) struct Bound {
    pub(super) part: Part,
    pub(super) about: Buffer<Part>,
    pub(super) vertices: Texels,
    /// Of [`Raster::project`](crate::raster::Raster::project).
    pub(super) corners: Texels,
    pub(super) faces: Texels,
}

impl Bound {
    fn new(gpu: &Gpu, first: usize, vertices: &[Vertex], faces: &[Face]) -> Result<Self, Error> {
        let part =
            Part { first: first as u32, faces: faces.len() as u32, vertices: vertices.len() as u32, begin: 0 };
        Ok(Self {
            part,
            about: gpu.uniform("part", &part)?,
            vertices: gpu.texels("vertices", vertices)?,
            corners: gpu.blank::<Corner>("corners", vertices.len())?,
            faces: gpu.texels("faces", faces)?,
        })
    }
}

/// The parts of a drawing, none of which binds more than `most` bytes at once, or than the device can.
pub(super) fn parts(gpu: &Gpu, drawing: &Drawing, most: u64) -> Result<Vec<Bound>, Error> {
    let table = most.min(gpu.most_texels()) as usize;
    let most_vertices = table / size_of::<Vertex>().max(size_of::<Corner>());
    let most_faces = table / size_of::<Face>();
    if drawing.vertices.len() <= most_vertices && drawing.faces.len() <= most_faces {
        return Ok(vec![Bound::new(gpu, 0, &drawing.vertices, &drawing.faces)?]);
    }
    let mut parts = Vec::new();
    // In which part a vertex is, counted from 1, and its number there.
    let mut places = vec![(0, 0); drawing.vertices.len()];
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    let mut first = 0;
    for (i, face) in drawing.faces.iter().enumerate() {
        if vertices.len() + 3 > most_vertices || faces.len() == most_faces {
            parts.push(Bound::new(gpu, first, &vertices, &faces)?);
            vertices.clear();
            faces.clear();
            first = i;
        }
        let number = parts.len() + 1;
        let [a, b, c] = [face.a, face.b, face.c].map(|vertex| {
            let place = &mut places[vertex as usize];
            if place.0 != number {
                *place = (number, vertices.len() as u32);
                vertices.push(drawing.vertices[vertex as usize]);
            }
            place.1
        });
        faces.push(Face { a, b, c, ..*face });
    }
    parts.push(Bound::new(gpu, first, &vertices, &faces)?);
    Ok(parts)
}
