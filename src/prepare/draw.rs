//! Scene -> Drawing: everything as triangles, every light with its lenses.

use std::ops::Range;

use glam::Vec3;

use super::lens::{Pose, orthographic, perspective};
use super::mesh::Sheet;
use super::nearest::nearest;
use super::sizes::small_things;
use super::window::regions;
use super::{filtering, pose};
use crate::math::vector::unit;
use crate::scene::{Camera, Light, Scene, Show, Specular};
use crate::tables::{self, CUT_OUT, Canvas, Drawing, Lamp, Lens, MOST_LENSES, Map, NONE};

/// Words that all lights' depths may take together: what every adapter binds at once.
const SHADOW_WORDS: u32 = (128 << 20) / 4;

/// Pixels that are drawn at once: their sums are what every adapter binds at once.
const MOST_PIXELS: u32 = (128 << 20) / 16;

/// Where the depths of a point light begin, as a share of where they end, unless a face is nearer.
const NEAR: f32 = 1e-2;

/// The least such share: the bias must stay above what f32 rounds off a depth.
const LEAST_NEAR: f32 = 1e-5;

/// Columns and rows of a glance.
const GLANCE: [u32; 2] = [96, 64];

/// What f32 rounds off corners far away, in shares of their distance and of that where depths begin: a face that is cut
/// there is off by so much.
const CUT: f32 = 5.0 / 16_777_216.0;

/// What f32 rounds off the places on a face that is as large as the whole scene, as a share of the scene's size: where
/// the eye weighs its corners, and where a small lens cuts it. A quarter of that showed on floors.
const LARGE: f32 = 24.0 * CUT;

/// How many times as large as its small things a scene may be, that a sun has a map of them: beyond that, what is rounded
/// off is no trifle beside them any more. Floors 50,000 times as large shadowed themselves.
const LARGEST: f32 = 1e4;

/// A sphere around all that is drawn but infinite planes, or around some of it.
#[derive(Debug, Clone, Copy)]
struct Bounds {
    center: Vec3,
    radius: f32,
}

/// The drawing of a scene.
#[must_use]
pub fn draw(scene: &Scene) -> Drawing {
    Scenery::new(scene).drawing
}

/// A drawing that is kept: what a person changes from frame to frame by hand is little of it.
#[derive(Debug)]
pub struct Scenery {
    /// What is drawn.
    pub drawing: Drawing,
    /// Where the scene's own pictures lie.
    textures: Vec<Map>,
    bounds: Option<Bounds>,
    small: Option<Bounds>,
    /// Vertices and faces that do not follow the eye, as those of infinite planes do.
    solid: [usize; 2],
}

impl Scenery {
    /// The drawing of a scene, and what it takes to look at it otherwise.
    #[must_use]
    pub fn new(scene: &Scene) -> Self {
        let mut sheet = Sheet::new(scene);
        sheet.meshes(scene);
        sheet.spheres(scene);
        sheet.triangles(scene);
        let (bounds, solid) = (bounds(&sheet), [sheet.vertices.len(), sheet.faces.len()]);
        let small = small(scene);
        let mut scenery = Self { drawing: nothing(scene), textures: Vec::new(), bounds, small, solid };
        scenery.lay(sheet, scene);
        scenery
    }

    /// Another eye, film, light, other settings and other numbers of materials, for the same things: whether the things
    /// are the same is for [`Scene::has_the_things_of`] to say. Tiles are shown of faces of their own.
    pub fn aim(&mut self, scene: &Scene) {
        let mut sheet = Sheet {
            vertices: std::mem::take(&mut self.drawing.vertices),
            faces: std::mem::take(&mut self.drawing.faces),
            paints: std::mem::take(&mut self.drawing.paints),
            texels: std::mem::take(&mut self.drawing.texels),
            textures: std::mem::take(&mut self.textures),
            ..Sheet::default()
        };
        sheet.vertices.truncate(self.solid[0]);
        sheet.faces.truncate(self.solid[1]);
        sheet.repaint(scene);
        self.lay(sheet, scene);
    }

    /// Vertices that are the same whatever the eye does: those before this one.
    #[must_use]
    pub fn solid(&self) -> usize {
        self.solid[0]
    }

    fn lay(&mut self, mut sheet: Sheet, scene: &Scene) {
        sheet.planes(scene, self.bounds.map(|bounds| (bounds.center, bounds.radius)));
        let Sheet { vertices, mut faces, paints, texels, textures, .. } = sheet;
        if scene.raster.show == Show::Tiles {
            // A cut-out face is work for all of its pixels.
            for face in &mut faces {
                face.paint &= !CUT_OUT;
            }
        }
        self.drawing = Drawing { vertices, faces, paints, texels, ..nothing(scene) };
        self.textures = textures;
        lamps(scene, self.bounds, self.small, &mut self.drawing);
    }
}

/// The eyes and the canvas, and nothing drawn yet.
fn nothing(scene: &Scene) -> Drawing {
    Drawing {
        eyes: eyes(scene),
        most: MOST_PIXELS,
        lenses: Vec::new(),
        canvas: canvas(scene),
        vertices: Vec::new(),
        faces: Vec::new(),
        paints: Vec::new(),
        lamps: Vec::new(),
        texels: Vec::new(),
    }
}

fn bounds(sheet: &Sheet) -> Option<Bounds> {
    let first = sheet.vertices.first()?.position;
    let (low, high) =
        sheet.vertices.iter().fold((first, first), |(low, high), v| (low.min(v.position), high.max(v.position)));
    let center = (low + high) * 0.5;
    let radius = sheet.vertices.iter().map(|v| v.position.distance(center)).fold(0.0, f32::max);
    Some(Bounds { center, radius: radius.max(1e-6 * center.length()).max(1e-18) * 1.001 })
}

/// Around the things that are small beside the rest, if there are such.
fn small(scene: &Scene) -> Option<Bounds> {
    let [low, high] = small_things(scene)?;
    Some(Bounds { center: (low + high) * 0.5, radius: low.distance(high) * 0.5 * 1.001 })
}

/// For each region of the film one lens for each sample of a pixel: the middles of an n x n grid.
fn eyes(scene: &Scene) -> Vec<Lens> {
    let camera = &scene.camera;
    let size = scene.film.size;
    let side = scene.raster.samples.isqrt().max(1);
    let at = |i: u32| (i as f32 + 0.5) / side as f32 - 0.5;
    let shifts = || (0..side * side).map(|i| [-at(i % side), -at(i / side)]);
    let of_region = |region: [Range<u32>; 2]| {
        shifts().map(move |shift| {
            let lens = view(camera, size[0] as f32 / size[1] as f32, size, &region, shift);
            Lens { cull: 1, left: region[0].start, top: region[1].start, ..lens }
        })
    };
    regions(size).into_iter().flat_map(of_region).collect()
}

/// What a camera sees of a region of a film; `aspect` is its own unless it says otherwise.
fn view(camera: &Camera, aspect: f32, film: [u32; 2], region: &[Range<u32>; 2], shift: [f32; 2]) -> Lens {
    let up = (camera.fov / 2.0).tan();
    let half = [up * camera.aspect.unwrap_or(aspect), up];
    let seat = Pose { eye: camera.position, axes: pose(camera) };
    let size = [0, 1].map(|i| region[i].len() as u32);
    let half = [0, 1].map(|i| half[i] * (size[i] as f32 / film[i] as f32));
    // From the middle of the region to the film's.
    let middle = |i: usize| (f64::from(film[i]) - f64::from(region[i].start) - f64::from(region[i].end)) / 2.0;
    let shift = [0, 1].map(|i| middle(i) as f32 + shift[i]);
    perspective(&seat, half, [camera.near, camera.far], size, shift)
}

/// What the camera sees of the whole picture, on a small film.
#[must_use]
pub fn glance(scene: &Scene) -> Lens {
    let [width, height] = scene.film.size;
    let whole = GLANCE.map(|side| 0..side);
    Lens { cull: 1, ..view(&scene.camera, width as f32 / height as f32, GLANCE, &whole, [0.0; 2]) }
}

fn canvas(scene: &Scene) -> Canvas {
    let settings = &scene.raster;
    Canvas {
        eye: scene.camera.position,
        lamps: scene.lights.len() as u32,
        background: scene.film.background,
        specular: match settings.specular {
            Specular::Phong => tables::PHONG,
            Specular::Blinn => tables::BLINN,
        },
        ambient: settings.ambient,
        shade: settings.shadow,
        filtering: filtering(settings.filter),
        blur: settings.blur,
        show: match settings.show {
            // Steps are the ray tracer's.
            Show::Color | Show::Steps => tables::SHOW_COLOR,
            Show::Depth => tables::SHOW_DEPTH,
            Show::Shadow => tables::SHOW_SHADOW,
            Show::Normal => tables::SHOW_NORMAL,
            Show::Uv => tables::SHOW_UV,
            Show::Albedo => tables::SHOW_ALBEDO,
            Show::Ambient => tables::SHOW_AMBIENT,
            Show::Diffuse => tables::SHOW_DIFFUSE,
            Show::Specular => tables::SHOW_SPECULAR,
            Show::Id => tables::SHOW_ID,
            Show::Tiles => tables::SHOW_TILES,
            Show::Wire => tables::SHOW_WIRE,
        },
        depth_times: 1.0,
        depth_plus: 0.0,
        depth_least: 0.0,
        depth_most: f32::MAX,
        pad: 0,
    }
}

/// Lights beyond the room for lenses cast no shadows.
fn lamps(scene: &Scene, bounds: Option<Bounds>, small: Option<Bounds>, drawing: &mut Drawing) {
    let wanted: u32 = scene.lights.iter().map(|l| if matches!(l, Light::Point { .. }) { 6 } else { 1 }).sum();
    let mut side = scene.raster.shadow_size;
    while wanted.min(MOST_LENSES) * side * side > SHADOW_WORDS {
        side /= 2;
    }
    // Maps of small things take no other light's room: if there is none, a sun's two maps have that of its one.
    let suns = scene.lights.iter().filter(|l| matches!(l, Light::Directional { camera: None, .. })).count() as u32;
    let beside = |small: &Bounds| bounds.is_some_and(|all| all.radius <= LARGEST * small.radius);
    let small = small.filter(|small| wanted + suns <= MOST_LENSES && beside(small));
    let half = if (wanted + suns) * side * side > SHADOW_WORDS { side / 2 } else { side };
    for light in &scene.lights {
        let (place, kind, power) = match *light {
            Light::Point { position, power } => (position, tables::POINT, power),
            Light::Directional { toward, power, camera: None } if small.is_some() => {
                (toward, tables::NESTED, power)
            }
            Light::Directional { toward, power, .. } => (toward, tables::DIRECTIONAL, power),
        };
        let far = |from: Vec3| bounds.map_or(0.0, |b| from.distance(b.center) + b.radius);
        // What cutting is off by, as a share of what is seen across.
        let off = |from: Vec3, near: f32, half: f32| CUT * far(from) / (near * 2.0 * half);
        let seen = match (light, bounds) {
            (Light::Directional { camera: Some(camera), .. }, _) => {
                let lens = view(camera, 1.0, [side; 2], &[0..side, 0..side], [0.0; 2]);
                vec![(lens, off(camera.position, camera.near, (camera.fov / 2.0).tan()))]
            }
            (Light::Directional { .. }, Some(all)) => match small {
                Some(small) => {
                    let off = LARGE * all.radius / (2.0 * small.radius);
                    vec![(beam(place, all, small, half), off), (beam(place, all, all, half), 0.0)]
                }
                None => vec![(beam(place, all, all, side), 0.0)],
            },
            (Light::Point { .. }, Some(_)) => {
                let (near, far) = (near_of(drawing, place, far(place)), far(place));
                let off = off(place, near, 1.0);
                cube(place, [near, far], side).map(|lens| (lens, off)).to_vec()
            }
            (_, None) => Vec::new(),
        };
        let room = drawing.lenses.len() + seen.len() <= MOST_LENSES as usize && !seen.is_empty();
        let lens = if room { drawing.lenses.len() as u32 } else { NONE };
        drawing.lamps.push(Lamp { place, kind, power, lens });
        for (mut lens, off) in seen.into_iter().filter(|_| room) {
            lens.first = drawing.shadow_words() as u32;
            lens.bias *= scene.raster.bias + off;
            // A texel each way, and as many more as are asked around it.
            lens.slope = 256 * (1 + scene.raster.blur);
            drawing.lenses.push(lens);
        }
    }
}

/// What a light from one direction sees of `part`, and in its depth of `all`, which may lie before and behind it.
fn beam(toward: Vec3, all: Bounds, part: Bounds, side: u32) -> Lens {
    let helper = if toward.y.abs() < 0.9 { Vec3::Y } else { Vec3::X };
    let right = unit(helper.cross(toward));
    let axes = [right, unit(toward.cross(right)), toward];
    let ahead = (all.center - part.center).dot(toward);
    let seat = Pose { eye: part.center + toward * (ahead + all.radius * 2.0), axes };
    orthographic(&seat, [part.radius; 2], [all.radius, all.radius * 3.0], [side; 2])
}

/// Where the depths of a point light begin, so that whatever is near it casts a shadow.
fn near_of(drawing: &Drawing, eye: Vec3, far: f32) -> f32 {
    // What is so far away lies, in the cube's corner, that much less deep; a little before it, so that it is not cut.
    let depth = |distance: f32| distance * 0.99 / 3_f32.sqrt();
    let usual = far * NEAR;
    let found = nearest(drawing, eye, usual * 2.0);
    found.map_or(usual, |distance| depth(distance).clamp(far * LEAST_NEAR, usual))
}

/// +x -x +y -y +z -z, as the shadow stage counts them.
fn cube(eye: Vec3, depths: [f32; 2], side: u32) -> [Lens; 6] {
    let ways = [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_Z];
    let face = |way: Vec3| {
        let helper = if way.y == 0.0 { Vec3::Y } else { Vec3::Z };
        let right = way.cross(helper);
        let axes = [right, right.cross(way), -way];
        perspective(&Pose { eye, axes }, [1.0; 2], depths, [side; 2], [0.0; 2])
    };
    ways.map(face)
}
