//! scene text -> Scene: what one field alone cannot know is wrong

mod material;

use std::collections::HashMap;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use glam::{Vec2, Vec3};

use super::file::{self, File};
use super::maps::{Pictures, Read};
use super::model::{Model, read_model};
use super::size::fits;
use super::source::{Models, Reach};
use super::value::At;
use super::{
    Camera, Error, FilmSettings, Instance, Light, Mesh, Plane, RasterSettings, Scene, Show, Sphere, TraceSettings,
    Triangle,
};

pub(super) struct Resolver<'a> {
    /// What the text is called: meshes are looked for beside it.
    pub(super) name: &'a Path,
    pub(super) complain: &'a dyn Fn(Range<usize>, &str) -> Error,
    pub(super) reach: &'a Reach,
    /// Whether a film that does not fit is none that will be made.
    pub(super) any_size: bool,
    pub(super) models: &'a Models,
    pub(super) pictures: &'a Read,
}

impl Resolver<'_> {
    pub(super) fn scene(&self, file: &File) -> Result<Scene, Error> {
        let camera = self.camera(&file.camera)?;
        let film = self.film(&file.film)?;
        let mut names = HashMap::new();
        for (i, material) in file.material.iter().enumerate() {
            let name = material.name.get();
            if names.insert(name.clone(), i).is_some() {
                return self.refuse(&material.name, "two materials cannot have one name");
            }
        }
        let mut pictures = Pictures::new(self.name, self.reach, self.pictures);
        let materials =
            file.material.iter().map(|m| self.material(m, &film, &mut pictures)).collect::<Result<_, _>>()?;
        let objects = &file.object;
        let spheres = objects.sphere.iter().map(|s| {
            let material = self.named(&names, &s.material)?;
            Ok(Sphere { center: s.center.0, radius: s.radius.0, material })
        });
        let planes = objects.plane.iter().map(|p| {
            let material = self.named(&names, &p.material)?;
            Ok(Plane { point: p.point.0, normal: p.normal.0, material, tile: p.tile.0 })
        });
        let triangles = objects.triangle.iter().map(|t| {
            let material = self.named(&names, &t.material)?;
            let vertices = t.vertices.get().0.map(|v| v.0);
            let [a, b, c] = vertices;
            if (b - a).cross(c - a).length_squared() < f32::MIN_POSITIVE {
                return self.refuse(&t.vertices, "a triangle's corners are three points not on one line");
            }
            let uvs = t.uvs.map_or(Triangle::UVS, |uvs| uvs.0.map(|uv| Vec2::from_array(uv.0.map(|part| part.0))));
            Ok(Triangle { vertices, material, uvs })
        });
        let trace = &file.trace;
        Ok(Scene {
            camera,
            method: file.method,
            trace: TraceSettings {
                samples: trace.samples.0,
                depth: trace.depth.0,
                specular: trace.specular,
                filter: trace.filter,
                cutoff: trace.cutoff.0,
                seed: trace.seed.0,
            },
            raster: self.raster(&file.raster, &film)?,
            meshes: self.meshes(&names, &objects.mesh)?,
            materials,
            textures: pictures.into_textures(),
            lights: self.lights(&file.light, &film)?,
            spheres: spheres.collect::<Result<_, Error>>()?,
            planes: planes.collect::<Result<_, Error>>()?,
            triangles: triangles.collect::<Result<_, Error>>()?,
            film,
        })
    }

    fn raster(&self, raster: &file::Raster, film: &FilmSettings) -> Result<RasterSettings, Error> {
        let samples = raster.samples.get().0;
        if samples.isqrt().pow(2) != samples || samples > 256 {
            return self.refuse(&raster.samples, "the rasterizer's samples are a square number from 1 to 256");
        }
        Ok(RasterSettings {
            samples,
            shadow_size: raster.shadow_size.0,
            shadow: raster.shadow.0,
            bias: raster.bias.0,
            blur: raster.blur.0,
            ambient: raster.ambient.under(film.transfer),
            specular: raster.specular,
            filter: raster.filter,
            show: Show::Color,
        })
    }

    /// A file that is named twice is read once, whatever frames it is for.
    fn meshes(&self, names: &HashMap<String, usize>, meshes: &[file::Mesh]) -> Result<Vec<Mesh>, Error> {
        let mut read = self.models.borrow_mut();
        let mut all = Vec::with_capacity(meshes.len());
        for mesh in meshes {
            let path = mesh.path.get();
            let model = match read.get(path) {
                Some(model) => Arc::clone(model),
                None => Arc::new(self.model(&mesh.path)?),
            };
            read.insert(path.clone(), Arc::clone(&model));
            let named = |name: &Option<At<String>>| name.as_ref().map(|name| self.named(names, name)).transpose();
            let one = Mesh {
                model,
                translate: mesh.translate.0,
                rotate: mesh.rotate.0 * (std::f32::consts::PI / 180.0),
                scale: mesh.scale.0,
                material: named(&mesh.material)?,
                one_sided: mesh.one_sided,
                instance: None,
            };
            for (place, number) in mesh.instance.iter().zip(0..) {
                let instance = Some(Instance {
                    number,
                    translate: place.translate.0,
                    rotate: place.rotate.0 * (std::f32::consts::PI / 180.0),
                    scale: place.scale.0,
                });
                all.push(Mesh { material: named(&place.material)?.or(one.material), instance, ..one.clone() });
            }
            if mesh.instance.is_empty() {
                all.push(one);
            }
        }
        Ok(all)
    }

    fn model(&self, path: &At<String>) -> Result<Model, Error> {
        let refuse = |why: String| (self.complain)(path.span(), &why);
        let folder = self.reach.folder(self.name).map_err(|why| refuse(why.to_string()))?;
        let read = read_model(Path::new(path.get()), &folder, &self.reach.limits());
        read.map_err(|why| {
            let error = refuse(why.to_string());
            if why.is_of_memory() { error.of_memory() } else { error }
        })
    }

    fn refuse<T, U>(&self, value: &At<T>, right: &str) -> Result<U, Error> {
        Err((self.complain)(value.span(), right))
    }

    fn camera(&self, camera: &At<file::Camera>) -> Result<Camera, Error> {
        let header = camera.span();
        let c = camera.get();
        // A value that was left out is told where its table stands.
        let place = |span: Range<usize>| {
            if span.is_empty() { header.clone() } else { span }
        };
        let (near, far) = (c.near.0, c.far.get().0);
        if near >= far {
            let right = format!("the far plane lies beyond the near one, which is at {near}");
            return Err((self.complain)(place(c.far.span()), &right));
        }
        let look_at = c.look_at.get().0;
        // As the ray caster will see them, in f32.
        let back = (c.position.0 - look_at).normalize_or_zero();
        if back == Vec3::ZERO {
            return self.refuse(&c.look_at, "the eye looks at a point that is not its own position");
        }
        let up = c.up.get().0;
        if up.cross(back).length() < 1e-4 {
            let right = "up is a direction that is not along the view from the eye to what it looks at";
            return Err((self.complain)(place(c.up.span()), right));
        }
        let aspect = c.aspect.map(|a| a.0);
        Ok(Camera { position: c.position.0, look_at, up, fov: c.fov.0.to_radians(), aspect, near, far })
    }

    fn film(&self, film: &file::Film) -> Result<FilmSettings, Error> {
        let size = film.size.get().0.map(|side| side.0);
        if !self.any_size
            && let Err(error) = fits(size, self.reach)
        {
            let refused = self.refuse(&film.size, &error.to_string());
            return refused.map_err(|told| if matches!(error, Error::Pixels(_)) { told } else { told.of_memory() });
        }
        Ok(FilmSettings { size, transfer: film.transfer, background: film.background.under(film.transfer) })
    }

    fn lights(&self, lights: &file::Lights, film: &FilmSettings) -> Result<Vec<Light>, Error> {
        let power = |color: super::value::Color, intensity: f32| color.under(film.transfer) * intensity;
        let points = lights
            .point
            .iter()
            .map(|l| Ok(Light::Point { position: l.position.0, power: power(l.color, l.intensity.0) }));
        let directional = lights.directional.iter().map(|l| {
            let camera = l.camera.as_ref().map(|camera| self.camera(camera)).transpose()?;
            Ok(Light::Directional { toward: l.toward.0, power: power(l.color, l.intensity.0), camera })
        });
        points.chain(directional).collect()
    }

    fn named(&self, names: &HashMap<String, usize>, name: &At<String>) -> Result<usize, Error> {
        if let Some(&i) = names.get(name.get()) {
            return Ok(i);
        }
        let mut known: Vec<_> = names.keys().map(|n| format!("{n:?}")).collect();
        known.sort();
        known.truncate(20);
        let right = if known.is_empty() {
            "a [[material]] has to be given this name first".to_owned()
        } else {
            format!("the materials are {}", known.join(", "))
        };
        self.refuse(name, &right)
    }
}
