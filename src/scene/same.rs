//! two scenes -> whether the same things stand in them, however they are seen, lit and painted

use std::sync::Arc;

use super::{Mesh, Scene};

impl Scene {
    /// Whether the same things stand in both, with the same pictures laid over them. Models and pictures are told apart
    /// by where they lie in memory, not by what is in them.
    #[must_use]
    pub fn has_the_things_of(&self, other: &Self) -> bool {
        let mesh = |(a, b): (&Mesh, &Mesh)| Arc::ptr_eq(&a.model, &b.model) && a.stands_as(b);
        let pictures = self.textures.iter().zip(&other.textures).all(|(a, b)| Arc::ptr_eq(&a.texels, &b.texels));
        let maps = self.materials.iter().zip(&other.materials).all(|(a, b)| a.maps == b.maps);
        let counts = |scene: &Self| [scene.textures.len(), scene.materials.len(), scene.meshes.len()];
        counts(self) == counts(other)
            && pictures
            && maps
            && self.film.transfer == other.film.transfer
            && self.spheres == other.spheres
            && self.triangles == other.triangles
            && self.meshes.iter().zip(&other.meshes).all(mesh)
    }
}

impl Scene {
    /// Whether both are one scene: equal in all there is, without a look into models and pictures.
    #[must_use]
    pub fn is(&self, other: &Self) -> bool {
        // Taken apart by name, so that what is added to a scene is not forgotten here; things are told apart above.
        let Self {
            camera,
            film,
            method,
            trace,
            raster,
            materials,
            lights,
            planes,
            textures: _,
            spheres: _,
            triangles: _,
            meshes: _,
        } = self;
        self.has_the_things_of(other)
            && *camera == other.camera
            && *film == other.film
            && *method == other.method
            && *trace == other.trace
            && *raster == other.raster
            && *materials == other.materials
            && *lights == other.lights
            && *planes == other.planes
    }
}

impl Mesh {
    fn stands_as(&self, other: &Self) -> bool {
        // Taken apart by name, so that what is added to a mesh is not forgotten here.
        let Self { model: _, translate, rotate, scale, material, one_sided, instance } = self;
        let place = (*translate, *rotate, *scale) == (other.translate, other.rotate, other.scale);
        place && (*material, *one_sided, *instance) == (other.material, other.one_sided, other.instance)
    }
}
