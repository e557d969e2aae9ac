//! Files given as text -> a folder of their own -> what the reader says about them.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

use twinlight::scene::model::{Confined, Error, Limits, Model, read_model};

pub use crate::parsers::promises as check_promises;

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
