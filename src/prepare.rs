//! Scene -> Tables: what a person says, as the arrays that both backends read.

mod ball;
pub mod bvh;
mod draw;
mod inside;
mod instances;
mod leaves;
pub mod lens;
mod levels;
mod mesh;
mod nearest;
pub mod room;
mod sizes;
mod window;

pub use ball::{SPHERE_FACES, sphere_faces};
pub use draw::{Scenery, draw, glance};
pub use mesh::PLANE_FACES;

use glam::Vec3;

use bvh::Bounds;
use leaves::Leaves;
use mesh::Sheet;

use crate::math::vector::unit;
use crate::scene::{Behavior, Camera, Filter, Light, Material, Scene, Show, Specular, model};
use crate::tables::{self, Tables, View};

/// The tables of a scene.
#[must_use]
pub fn prepare(scene: &Scene) -> Tables {
    prepare_with(scene, &bvh::Binned)
}

/// The tables of a scene, whose tree someone else builds.
#[must_use]
pub fn prepare_with(scene: &Scene, builder: &dyn bvh::Builder) -> Tables {
    let material = |i: usize| i as u32;
    let mut sheet = Sheet::new(scene);
    let Leaves { all: leaves, nodes, deep, instances, loose, bounds } = leaves::leaves(scene, &mut sheet, builder);
    let Sheet { vertices, faces, paints, texels, materials, .. } = sheet;
    let bounds = if leaves.len() == scene.planes.len() { Bounds::around([Vec3::ZERO]) } else { bounds };
    let mut tables = Tables {
        view: view(scene),
        settings: tables::Settings {
            background: scene.film.background,
            max_depth: scene.trace.depth,
            spheres: scene.spheres.len() as u32,
            planes: scene.planes.len() as u32,
            lights: scene.lights.len() as u32,
            specular: match scene.trace.specular {
                Specular::Phong => tables::PHONG,
                Specular::Blinn => tables::BLINN,
            },
            low: bounds.low.truncate(),
            cutoff: scene.trace.cutoff,
            high: bounds.high.truncate(),
            zero: 0,
            filtering: filtering(scene.trace.filter),
            instances: instances.len() as u32,
            loose,
            pad: 0,
        },
        samples: scene.trace.samples,
        spheres: scene
            .spheres
            .iter()
            .map(|s| tables::Sphere {
                center: s.center,
                radius: s.radius,
                material: material(s.material),
                pad_a: 0,
                pad_b: [0; 2],
            })
            .collect(),
        planes: scene
            .planes
            .iter()
            .map(|p| tables::Plane { point: p.point, material: material(p.material), normal: p.normal, pad: 0 })
            .collect(),
        leaves,
        nodes,
        deep,
        instances,
        materials: scene.materials.iter().map(paint).chain(materials.iter().map(dress)).collect(),
        paints,
        faces,
        vertices,
        texels,
        lights: scene.lights.iter().map(lamp).collect(),
        few: false,
        steps: scene.raster.show == Show::Steps,
    };
    tables.few = tables.are_few();
    tables
}

/// Puts the lights, the background and the materials' numbers of a scene into the tables of another, which has the same
/// things, as many lights, and materials that behave the same and have the same maps.
pub fn repaint(tables: &mut Tables, scene: &Scene) {
    // Those of models stand behind them.
    for (old, new) in tables.materials.iter_mut().zip(&scene.materials) {
        *old = paint(new);
    }
    for (old, new) in tables.paints.iter_mut().zip(&scene.materials) {
        *old = mesh::recover(new, *old);
    }
    tables.settings.background = scene.film.background;
    tables.lights = scene.lights.iter().map(lamp).collect();
}

/// The film plane at distance one from the eye (spec 1.2.1 and 2.2).
#[must_use]
pub fn view(scene: &Scene) -> View {
    let [width, height] = scene.film.size;
    let [right, up, back] = pose(&scene.camera);
    let tall = 2.0 * (scene.camera.fov / 2.0).tan();
    let aspect = scene.camera.aspect.unwrap_or(width as f32 / height as f32);
    let root = scene.trace.samples.isqrt();
    View {
        eye: scene.camera.position,
        width,
        right: right * (tall * aspect),
        height,
        up: up * tall,
        grid: if root * root == scene.trace.samples { root } else { 0 },
        back,
        seed: scene.trace.seed,
        inside: u32::from(inside::inside(scene)),
        pad_a: 0,
        pad_b: [0; 2],
    }
}

/// The camera's axes R, U, D in world space (spec 1.2.1).
#[must_use]
pub fn pose(camera: &Camera) -> [Vec3; 3] {
    let back = unit(camera.position - camera.look_at);
    let right = unit(camera.up.cross(back));
    [right, unit(back.cross(right)), back]
}

/// A color at length one; black stays black.
fn tint(color: Vec3) -> Vec3 {
    if color.dot(color) > 0.0 { unit(color) } else { Vec3::ZERO }
}

fn paint(m: &Material) -> tables::Material {
    tables::Material {
        color: m.color,
        local_weight: m.local,
        tint: tint(m.color),
        reflect_weight: m.reflect,
        refract_weight: m.refract,
        exponent: m.exponent,
        index: m.index,
        behavior: match m.behavior {
            Behavior::Mirror => tables::MIRROR,
            Behavior::Diffuse => tables::DIFFUSE,
            Behavior::Glass => tables::GLASS,
        },
    }
}

/// A model's material.
fn dress(m: &model::Material) -> tables::Material {
    tables::Material {
        color: m.diffuse,
        local_weight: 1.0,
        tint: tint(m.diffuse),
        reflect_weight: 0.0,
        refract_weight: 0.0,
        exponent: m.exponent,
        index: 1.0,
        behavior: tables::MIRROR,
    }
}

fn filtering(filter: Filter) -> u32 {
    match filter {
        Filter::Nearest => tables::NEAREST,
        Filter::Bilinear => tables::BILINEAR,
        Filter::Mipmap => tables::MIPMAP,
    }
}

fn lamp(light: &Light) -> tables::Light {
    match *light {
        Light::Point { position, power } => tables::Light { place: position, kind: tables::POINT, power, pad: 0 },
        Light::Directional { toward, power, .. } => {
            tables::Light { place: toward, kind: tables::DIRECTIONAL, power, pad: 0 }
        }
    }
}
