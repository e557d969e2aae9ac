//! a pixel of traced tables -> its samples, each with the whole ray tree

use std::convert::Infallible;
use std::sync::Arc;

use bytemuck::Zeroable as _;
use glam::{Vec2, Vec3};
use serde::Serialize;

use super::drawn::Maps;
use super::things::Thing;
use super::tree::Heard;
use crate::cpu::trace::primary::place;
use crate::cpu::trace::{cast::cast, few::few, follow, gather::gather, steps::steps, walk::walk};
use crate::film::{Film, Run};
use crate::scene::Scene;
use crate::tables::{DONE, Slice, Status, Tables};
use crate::trace::{Part, Paths, Trace, part};

/// One sample of a pixel.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TracedSample {
    /// Where it is, in pixels of the film, y down.
    pub at: Vec2,
    /// The rays of its tree, in the order in which they are followed; the first is the primary one.
    pub rays: Vec<Traced>,
    /// What is added to the pixel's sum.
    pub color: Vec3,
}

/// One ray of a tree.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Traced {
    /// What it is of the ray before it in its branch.
    pub way: Way,
    /// The ray that it comes from, by its place among the rays.
    pub parent: Option<u32>,
    /// Which ray of its branch it is, from 1.
    pub depth: u32,
    /// Whether it runs inside an object.
    pub inside: bool,
    /// What its light counts for in the pixel.
    pub weight: Vec3,
    /// Where it starts.
    pub origin: Vec3,
    /// Which way it goes, of length one.
    pub direction: Vec3,
    /// What it meets; nothing where it leaves the scene.
    pub meets: Option<Meeting>,
    /// What it gets from the background: where it meets nothing, and at the greatest depth.
    pub background: Option<Vec3>,
}

/// Which way a ray goes on from a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Way {
    /// From the eye (2.2).
    Primary,
    /// Reflected (Eq. 2.6, or around it).
    Reflected,
    /// Refracted (Eq. 2.7).
    Refracted,
}

/// A ray at a surface.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Meeting {
    /// The primitive.
    pub thing: Thing,
    /// Which kind of primitive it is.
    pub kind: Kind,
    /// How far, in lengths of the direction.
    pub t: f32,
    /// In world space.
    pub point: Vec3,
    /// The primitive's normal, of length one, on the ray's side.
    pub normal: Vec3,
    /// What the maps say.
    pub maps: Maps,
    /// T and B of the tangent space, where a normal map asks for them.
    pub tangents: Option<[Vec3; 2]>,
    /// The normal that light falls onto, of length one: between corners, and as a normal map says.
    pub shading: Vec3,
    /// The surface's own color.
    pub color: Vec3,
    /// Weight of the specular term.
    pub specular: Vec3,
    /// Weight of the local light.
    pub local: f32,
    /// The specular exponent k.
    pub exponent: f32,
    /// Each light in its turn; none inside of an object.
    pub lights: Vec<ShadowRay>,
    /// Two numbers in [0, 1), which choose the way of a diffuse reflection.
    pub random: Vec2,
    /// The reflected way, and the refracted one.
    pub ways: Vec<Onward>,
}

/// What rays meet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// Eq. 2.1 to 2.3.
    Sphere,
    /// Eq. 2.4 and 2.5.
    Plane,
    /// 2.3, "Triangle".
    Triangle,
}

/// A light, asked at a surface.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ShadowRay {
    /// What the scene file calls it.
    pub light: String,
    /// From the surface to the light; of a point light as long as the way there.
    pub toward: Vec3,
    /// max(0, cos theta) and max(0, cos^k alpha); both zero if the light lies behind the surface.
    pub phong: [f32; 2],
    /// What it gives to the pixel if it arrives.
    pub color: Vec3,
    /// Whether the light lies before the surface.
    pub before: bool,
    /// Whether it arrives.
    pub arrives: bool,
    /// What stands between, if it does not; of several things the nearest.
    pub blocker: Option<Thing>,
}

/// A way on from a surface.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Onward {
    /// Reflected or refracted.
    pub way: Way,
    /// Of length one.
    pub direction: Vec3,
    /// What its light would count for in the pixel; zero where there is no such way.
    pub weight: Vec3,
    /// Whether it is followed: not at the greatest depth, nor if it counts for no more than the cutoff.
    pub followed: bool,
}

/// The samples of a pixel, and the film of it.
pub(super) fn pixel(scene: &Scene, tables: &Arc<Tables>, [x, y]: [u32; 2]) -> (Vec<TracedSample>, Film) {
    let mut stages = Listening { scene, tables, samples: Vec::new(), status: Status::zeroed() };
    let whole = Part { columns: x..x + 1, rows: y..y + 1, samples: 0..tables.samples };
    let Ok(film) = part(&mut stages, tables, &whole, &mut |_| ());
    let mut samples = stages.samples;
    for (sample, number) in samples.iter_mut().zip(0..) {
        let within = place(&tables.view, number);
        // The grid's rows are counted from below.
        sample.at = Vec2::new(x as f32 + within.x, y as f32 + 1.0 - within.y);
    }
    (samples, film)
}

/// The stages as they are, one sample after the other, for one pixel that tells what happens to it.
struct Listening<'a> {
    scene: &'a Scene,
    tables: &'a Tables,
    samples: Vec<TracedSample>,
    status: Status,
}

impl Trace for Listening<'_> {
    type Paths = Paths;
    type Error = Infallible;

    fn most_pixels(&self) -> u32 {
        1
    }

    fn budget(&self) -> u32 {
        u32::MAX
    }

    fn rounds(&self) -> u32 {
        1
    }

    fn begin(&mut self, run: &Run, end: u32) -> Result<Paths, Infallible> {
        Ok(Paths::of(run, end, self.tables))
    }

    fn cast(&mut self, paths: &mut Paths, slice: &Slice) -> Result<(), Infallible> {
        cast(&self.tables.view, slice, 0, &mut paths.paths[0]);
        Ok(())
    }

    fn follow(&mut self, paths: &mut Paths, slice: &Slice) -> Result<(), Infallible> {
        let Paths { paths, waiting, walks, .. } = paths;
        let mut heard = Heard::new(self.scene, self.tables);
        let walk = |ray, start, any| walk(self.tables, walks, ray, start, slice.budget, any);
        let known = &mut follow::Known::default();
        follow::follow(self.tables, slice, 0, &mut paths[0], waiting, known, walk, &mut self.status, &mut heard);
        if paths[0].state == DONE {
            self.samples.push(heard.sample(paths[0].radiance));
        }
        Ok(())
    }

    fn steps(&mut self, paths: &mut Paths, _slice: &Slice) -> Result<(), Infallible> {
        steps(self.tables, &mut paths.paths[0], &mut paths.walks, &mut self.status);
        Ok(())
    }

    fn gather(&mut self, paths: &mut Paths, slice: &Slice) -> Result<(), Infallible> {
        let Paths { paths, sums, squares, ids, .. } = paths;
        self.status.pixels += gather(slice, &mut paths[0], &mut sums[0], &mut squares[0], &mut ids[0]);
        Ok(())
    }

    fn few(&mut self, paths: &mut Paths, slice: &Slice) -> Result<(), Infallible> {
        let Paths { paths, waiting, sums, squares, ids, .. } = paths;
        let path = &mut paths[0];
        while path.sample < slice.samples {
            let one = Slice { samples: path.sample + 1, ..*slice };
            let mut heard = Heard::new(self.scene, self.tables);
            let film = (&mut sums[0], &mut squares[0], &mut ids[0]);
            few(self.tables, &one, 0, path, waiting, film, &mut self.status, &mut heard);
            self.samples.push(heard.sample(path.radiance));
        }
        // It was done as often as there are samples.
        self.status.pixels = 1;
        Ok(())
    }

    fn settle(&mut self, _paths: &mut Paths) -> Result<u32, Infallible> {
        Ok(std::mem::replace(&mut self.status, Status::zeroed()).pixels)
    }

    fn end(&mut self, paths: Paths) -> Result<Paths, Infallible> {
        Ok(paths)
    }

    fn ease(&mut self, error: Infallible) -> Result<(), Infallible> {
        Err(error)
    }
}
