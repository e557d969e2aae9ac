//! Files given as text -> a folder of their own -> what the reader says about them.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

use twinlight::scene::model::{Confined, Error, Limits, Model, read_model};

/// A folder that lives as long as this.
pub struct Scratch(pub PathBuf);

impl Scratch {
    pub fn new() -> Self {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let name = format!("objread-{}-{}", std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed));
        let folder = std::env::temp_dir().join(name);
        std::fs::create_dir_all(&folder).unwrap();
        Self(folder)
    }

    pub fn file(&self, name: &str, content: impl AsRef<[u8]>) -> &Self {
        let path = self.0.join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, content).unwrap();
        self
    }

    pub fn read(&self, name: &str) -> Result<Model, Error> {
        self.read_within(name, &Limits::default())
    }

    pub fn read_within(&self, name: &str, limits: &Limits) -> Result<Model, Error> {
        read_model(Path::new(name), &Confined::new(&self.0).unwrap(), limits)
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// The model of one OBJ text without other files; checked for what every model promises.
pub fn read(obj: impl AsRef<[u8]>) -> Result<Model, Error> {
    let model = Scratch::new().file("m.obj", obj).read("m.obj")?;
    check_promises(&model);
    Ok(model)
}

pub fn warnings(model: &Model) -> Vec<String> {
    model.warnings.iter().map(ToString::to_string).collect()
}

/// What [`Model`] promises to whoever indexes without looking.
pub fn check_promises(model: &Model) {
    let inside = |index: u32, count: usize| (index as usize) < count;
    assert!(!model.triangles.is_empty());
    for triangle in &model.triangles {
        assert!(inside(triangle.material, model.materials.len()));
        assert!(inside(triangle.group, model.groups.len()));
        for corner in triangle.corners {
            assert!(inside(corner.position, model.positions.len()));
            assert!(inside(corner.normal, model.normals.len()));
            assert!(corner.uv == twinlight::scene::model::NONE || inside(corner.uv, model.uvs.len()));
        }
    }
    assert!(model.positions.iter().all(|position| position.is_finite()));
    assert!(model.uvs.iter().all(|uv| uv.is_finite()));
    assert!(model.normals.iter().all(|normal| (normal.length() - 1.0).abs() < 1e-6));
    for material in &model.materials {
        let colors = [material.ambient, material.diffuse, material.specular, material.emission];
        assert!(colors.iter().all(|color| color.is_finite() && color.min_element() >= 0.0));
        assert!(material.exponent.is_finite() && material.exponent >= 0.0);
        assert!((0.0..=1.0).contains(&material.opacity));
        let maps = [
            material.diffuse_map,
            material.specular_map,
            material.exponent_map,
            material.opacity_map,
            material.normal_map,
        ];
        for map in maps.into_iter().flatten() {
            assert!(inside(map.texture, model.textures.len()));
            assert!(map.scale.is_finite() && map.offset.is_finite() && map.strength.is_finite());
        }
    }
    for texture in &model.textures {
        assert_eq!(texture.texels.len(), texture.width as usize * texture.height as usize);
        assert!(!texture.texels.is_empty());
    }
    assert!(model.warnings.len() <= twinlight::scene::model::Warnings::MOST);
}
