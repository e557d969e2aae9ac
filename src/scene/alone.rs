//! a model with no scene file -> a scene that fits it: a camera before it, two lights, and a ground below

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::Vec3;

use super::model::{Confined, Model, read_model};
use super::source::Reach;
use super::{
    Behavior, Camera, Error, FilmSettings, Filter, Held, Light, Maps, Material, Mesh, Method, Plane,
    RasterSettings, Scene, Show, Specular, TraceSettings,
};
use crate::film::Transfer;

/// A model and what it takes to look at it; what it is called, and the folder that this name is relative to.
pub(super) fn alone(path: &Path, reach: &Reach) -> Result<(Scene, PathBuf, String), Error> {
    let failed = |why: String| Error::Read { path: path.to_owned(), why };
    // Pictures often lie in a folder beside the model's own: `../textures/wood.png`.
    let whole = path.canonicalize().map_err(|e| failed(e.to_string()))?;
    let (Some(name), Some(home)) = (whole.file_name(), whole.parent()) else {
        return Err(failed("it is not a file".to_owned()));
    };
    let (root, name) = match (home.parent(), home.file_name()) {
        (Some(around), Some(home)) => (around, Path::new(home).join(name)),
        _ => (home, name.into()),
    };
    let folder = Confined::new(root).map_err(|e| failed(e.to_string()))?;
    let folder =
        reach.search.iter().try_fold(folder, |all, more| all.and(more)).map_err(|e| failed(e.to_string()))?;
    let model = read_model(&name, &folder, &reach.limits()).map_err(|e| failed(e.to_string()))?;
    Ok((around(Arc::new(model)), root.to_owned(), name.to_string_lossy().into_owned()))
}

/// The same scene as a file would say it, so that it can be changed and kept as one; `name` is the model's.
pub(super) fn text(scene: &Scene, name: &str) -> String {
    let three = |v: Vec3| format!("{:?}", v.to_array());
    let Camera { position, look_at, fov, near, far, .. } = &scene.camera;
    let mut text = format!(
        "method = \"raster\"\n\n[camera]\nposition = {}\nlook_at = {}\nfov = {:?}\nnear = {near:?}\nfar = {far:?}\n\n\
         [film]\nsize = {:?}\nbackground = {}\n\n[raster]\nambient = {}\n",
        three(*position),
        three(*look_at),
        fov.to_degrees(),
        scene.film.size,
        three(scene.film.background),
        three(scene.raster.ambient)
    );
    for light in &scene.lights {
        if let Light::Directional { toward, power, .. } = light {
            let _ = write!(
                text,
                "\n[[light.directional]]\ntoward = {}\nintensity = {:?}\n",
                three(*toward),
                power.max_element()
            );
        }
    }
    for material in &scene.materials {
        let Material { name, color, exponent, .. } = material;
        let _ =
            write!(text, "\n[[material]]\nname = {name:?}\ncolor = {}\nexponent = {exponent:?}\n", three(*color));
    }
    for plane in &scene.planes {
        let material = &scene.materials[plane.material].name;
        let _ = write!(
            text,
            "\n[[object.plane]]\npoint = {}\nnormal = {}\nmaterial = {material:?}\n",
            three(plane.point),
            three(plane.normal)
        );
    }
    text + &format!("\n[[object.mesh]]\npath = {}\n", Held::Word(name.to_owned()).to_toml())
}

/// How far the ground lies below the lowest point, in radii: many models have a floor, which would be half hidden.
const BELOW: f32 = 1e-3;

fn around(model: Arc<Model>) -> Scene {
    let seen = model.triangles.iter().flat_map(|t| t.corners).map(|c| model.positions[c.position as usize]);
    let (low, high) = seen.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(l, h), p| (l.min(p), h.max(p)));
    let center = (low + high) * 0.5;
    // Of a model that is but a point, whatever f32 tells apart there.
    let least = (center.length() * 1e-6).max(1e-18);
    let radius = ((high - low).length() * 0.5).max(least);
    let fov = 35.0_f32.to_radians();
    let away = radius / (fov / 2.0).sin();
    let direction = |x: f32, y: f32, z: f32| Vec3::new(x, y, z).normalize();
    Scene {
        camera: Camera {
            position: center + direction(0.35, 0.25, 1.0) * away,
            look_at: center,
            up: Vec3::Y,
            fov,
            aspect: None,
            // Before a flat model the ground begins near the eye.
            near: away * 0.1,
            far: away + radius * 30.0,
        },
        film: FilmSettings { size: [800, 800], transfer: Transfer::Srgb, background: Vec3::splat(0.6) },
        method: Method::Raster,
        trace: TraceSettings {
            samples: 16,
            depth: 6,
            specular: Specular::Phong,
            filter: Filter::Mipmap,
            cutoff: 1.0 / 1024.0,
            seed: 0,
        },
        raster: RasterSettings {
            samples: 4,
            shadow_size: 2048,
            shadow: 0.3,
            bias: 0.0005,
            blur: 1,
            ambient: Vec3::splat(0.02),
            specular: Specular::Phong,
            filter: Filter::Mipmap,
            show: Show::Color,
        },
        materials: vec![Material {
            name: "ground".to_owned(),
            color: Vec3::splat(0.45),
            local: 1.0,
            reflect: 0.0,
            refract: 0.0,
            exponent: 1e4,
            index: 1.5,
            behavior: Behavior::Mirror,
            maps: Maps::default(),
        }],
        textures: Vec::new(),
        lights: vec![
            Light::Directional { toward: direction(0.8, 1.2, 1.0), power: Vec3::splat(0.9), camera: None },
            Light::Directional { toward: direction(-1.0, 0.5, 0.6), power: Vec3::splat(0.25), camera: None },
        ],
        spheres: Vec::new(),
        planes: vec![Plane {
            point: Vec3::new(0.0, low.y - radius * BELOW, 0.0),
            normal: Vec3::Y,
            material: 0,
            tile: 1.0,
        }],
        triangles: Vec::new(),
        meshes: vec![Mesh::of(model)],
    }
}
