//! the number of a face or primitive -> the thing of the scene that it belongs to

use serde::Serialize;

use crate::prepare::{PLANE_FACES, sphere_faces};
use crate::scene::{Light, Mesh, Scene};

/// A thing of the scene, as the scene file calls it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Thing {
    /// Its number in the drawing or in the tables: what `--show id` and the id pass show.
    pub id: u32,
    /// Its table in the scene file: `object.mesh[0]`, `object.sphere[2]`.
    pub object: String,
    /// Which triangle of it, from 0, where it has several.
    pub triangle: Option<u32>,
    /// The model's group, where it has a name.
    pub group: Option<String>,
    /// The name of its material.
    pub material: String,
}

#[derive(Debug, Clone, Copy)]
enum Kind {
    Mesh,
    Sphere,
    Triangle,
    Plane,
}

/// What a face of a drawing belongs to.
pub(super) fn drawn(scene: &Scene, id: u32) -> Thing {
    let spheres = sphere_faces(scene);
    let each = |kind, number: usize| match kind {
        Kind::Sphere => spheres[number],
        Kind::Plane => PLANE_FACES,
        Kind::Mesh | Kind::Triangle => 1,
    };
    let order = [Kind::Mesh, Kind::Sphere, Kind::Triangle, Kind::Plane];
    find(scene, order, each, &(0..scene.meshes.len()).collect::<Vec<_>>(), id)
}

/// What a primitive of the ray tracer is.
pub(super) fn traced(scene: &Scene, id: u32) -> Thing {
    let (alone, shared) = scene.alone_and_shared();
    let meshes = [alone, shared.concat()].concat();
    find(scene, [Kind::Sphere, Kind::Plane, Kind::Triangle, Kind::Mesh], |_, _| 1, &meshes, id)
}

/// A mesh by its table in the scene file: instances stand in that of their mesh.
fn called(scene: &Scene, mesh: usize) -> String {
    let begins = |mesh: &&Mesh| mesh.instance.is_none_or(|instance| instance.number == 0);
    let table = scene.meshes[..=mesh].iter().filter(begins).count() - 1;
    let instance = scene.meshes[mesh].instance.map(|instance| format!(".instance[{}]", instance.number));
    format!("object.mesh[{table}]{}", instance.unwrap_or_default())
}

/// `order`: the kinds in their order. `each`: how many numbers the one of a kind with this number takes; a mesh takes one
/// for each triangle. `meshes`: the numbers of the meshes in their order.
fn find(scene: &Scene, order: [Kind; 4], each: impl Fn(Kind, usize) -> u32, meshes: &[usize], id: u32) -> Thing {
    let mut left = id;
    let name = |material: usize| scene.materials[material].name.clone();
    for kind in order {
        let (word, materials): (_, Vec<usize>) = match kind {
            Kind::Sphere => ("sphere", scene.spheres.iter().map(|s| s.material).collect()),
            Kind::Triangle => ("triangle", scene.triangles.iter().map(|t| t.material).collect()),
            Kind::Plane => ("plane", scene.planes.iter().map(|p| p.material).collect()),
            Kind::Mesh => {
                for &number in meshes {
                    let Mesh { model, material, .. } = &scene.meshes[number];
                    if let Some(of) = model.triangles.get(left as usize) {
                        let own = || model.materials[of.material as usize].name.clone();
                        let group = model.groups.get(of.group as usize).filter(|name| !name.is_empty());
                        return Thing {
                            id,
                            object: called(scene, number),
                            triangle: Some(left),
                            group: group.cloned(),
                            material: material.map_or_else(own, name),
                        };
                    }
                    left -= model.triangles.len() as u32;
                }
                continue;
            }
        };
        for (number, material) in materials.into_iter().enumerate() {
            let each = each(kind, number);
            if left < each {
                let object = format!("object.{word}[{number}]");
                let triangle = (each > 1).then_some(left);
                return Thing { id, object, triangle, group: None, material: name(material) };
            }
            left -= each;
        }
    }
    Thing { id, object: "nothing of the scene".to_owned(), triangle: None, group: None, material: String::new() }
}

/// What the scene file calls a light: those at points come first.
pub(super) fn light(scene: &Scene, number: usize) -> String {
    let points = scene.lights.iter().filter(|light| matches!(light, Light::Point { .. })).count();
    if number < points {
        format!("light.point[{number}]")
    } else {
        format!("light.directional[{}]", number - points)
    }
}
