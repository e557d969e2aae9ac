//! a scene and a method -> whether there is room for its tables

use std::collections::HashSet;
use std::sync::Arc;

use super::{PLANE_FACES, SPHERE_FACES, sphere_faces};
use crate::scene::model::Model;
use crate::scene::{Mesh, Method, Reach, Scene};

/// Why a scene's tables are not made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum Error {
    /// More faces and pictures than there is memory for.
    #[error("the scene's faces and pictures need about {needed} MiB, and {most} MiB of memory may be taken")]
    Memory {
        /// MiB.
        needed: u64,
        /// MiB.
        most: u64,
    },
    /// More triangles than 32 bits can number, every instance's counted.
    #[error("the scene has {0} triangles with all of its instances, and 4294967294 can be told apart")]
    Numbers(u64),
}

/// Bytes of a face with its corners, and with its share of the tree or of the lists that corners are looked up in.
const FACE: u64 = 256;
/// Bytes of a mesh beside its model: as an instance, with the box around it and its share of the tree.
const MESH: u64 = 512;

/// About as many bytes as the tables of a scene take while they are made.
fn bytes(scene: &Scene, method: Method) -> u64 {
    let count = |count: usize| count as u64;
    let of = |mesh: &Mesh| count(mesh.model.triangles.len());
    let faces: u64 = if method == Method::Raster {
        scene.meshes.iter().map(of).sum()
    } else {
        // What many meshes share is there once.
        let (alone, shared) = scene.alone_and_shared();
        alone.iter().chain(shared.iter().map(|meshes| &meshes[0])).map(|&i| of(&scene.meshes[i])).sum::<u64>()
    };
    // A sphere is some thousands of faces where it is drawn, and a plane a hundred.
    let [sphere, plane] =
        if method == Method::Raster { [SPHERE_FACES, PLANE_FACES].map(u64::from) } else { [1; 2] };
    let [spheres, planes] = [scene.spheres.len(), scene.planes.len()].map(count);
    let faces = faces + spheres * sphere + planes * plane + count(scene.triangles.len());
    let texels: u64 = models(scene).iter().flat_map(|model| &model.textures).map(|t| count(t.texels.len())).sum();
    let texels = texels + scene.textures.iter().map(|t| count(t.texels.len())).sum::<u64>();
    faces * FACE + texels * 16 + count(scene.meshes.len()) * MESH
}

/// The models of a scene, each once.
#[must_use]
pub fn models(scene: &Scene) -> Vec<&Model> {
    let mut known = HashSet::new();
    let models = scene.meshes.iter().map(|mesh| &mesh.model);
    models.filter(|model| known.insert(Arc::as_ptr(model))).map(|model| &**model).collect()
}

/// Whether a scene's tables fit into what may be taken. Counted before it is taken: a file of a few lines may place a
/// model a million times.
///
/// # Errors
/// [`Error::Memory`] and [`Error::Numbers`] if they do not.
pub fn within(scene: &Scene, method: Method, reach: &Reach) -> Result<(), Error> {
    let most = reach.most();
    let fits = |needed: u64| {
        if needed > most { Err(Error::Memory { needed: needed >> 20, most: most >> 20 }) } else { Ok(()) }
    };
    let needed = bytes(scene, method);
    fits(needed)?;
    if method == Method::Raster {
        // To know the wide spheres takes a look at all that is smaller; by now that is known to fit.
        let more = |faces: u32| u64::from(faces.saturating_sub(SPHERE_FACES));
        fits(needed + FACE * sphere_faces(scene).into_iter().map(more).sum::<u64>())?;
    }
    // A hit on an instance is numbered by its primitive, after all leaves; the last number is none.
    let faces: u64 = scene.meshes.iter().map(|mesh| mesh.model.triangles.len() as u64).sum();
    let others = scene.spheres.len() + scene.planes.len() + scene.triangles.len() + scene.meshes.len();
    if faces + others as u64 >= u64::from(u32::MAX) {
        return Err(Error::Numbers(faces));
    }
    Ok(())
}
