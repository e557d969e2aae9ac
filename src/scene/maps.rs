//! the pictures that a scene's materials name -> textures, each once for each use, and the maps that point to them

use std::cell::RefCell;
use std::collections::HashMap;
use std::path::Path;

use glam::Vec2;

use super::model::bump::{self, Kind};
use super::model::texture::{Picture, decode};
use super::model::{Budget, Confined, Content, Limits, Map, Texture, read};
use super::source::Reach;

/// The pictures laid over a material; each points into [`Scene::textures`](super::Scene::textures).
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Maps {
    /// Its color is multiplied with it.
    pub color: Option<Map>,
    /// Tangent space, +x along u, +y along v.
    pub normal: Option<Map>,
    /// The specular term is multiplied with it.
    pub specular: Option<Map>,
}

/// Pictures that were read, by name, content and the bits of their strength; with each what is left of its strength.
pub(super) type Read = RefCell<HashMap<(String, Content, u32), (Texture, f32)>>;

/// The pictures of a scene, as far as they were asked for.
pub(super) struct Pictures<'a> {
    /// What the scene is called: pictures are looked for beside it.
    scene: &'a Path,
    reach: &'a Reach,
    limits: Limits,
    budget: Budget,
    /// Name, content and the bits of its strength -> what came of it.
    made: HashMap<(String, Content, u32), Map>,
    textures: Vec<Texture>,
    /// A picture that an earlier frame has read is not read again.
    read: &'a Read,
}

impl<'a> Pictures<'a> {
    pub(super) fn new(scene: &'a Path, reach: &'a Reach, read: &'a Read) -> Self {
        let limits = reach.limits();
        let budget = Budget::new(&limits);
        Self { scene, reach, limits, budget, made: HashMap::new(), textures: Vec::new(), read }
    }

    pub(super) fn into_textures(self) -> Vec<Texture> {
        self.textures
    }

    /// The map for a use of a file. Unlike a model's, which many programs have written, a scene's pictures are where it
    /// says, or there is no scene: the error is what is wrong and what would be right.
    pub(super) fn map(&mut self, file: &str, content: Content, strength: f32) -> Result<Map, String> {
        let key = (file.to_owned(), content, strength.to_bits());
        if let Some(&map) = self.made.get(&key) {
            return Ok(map);
        }
        let known = self.read.borrow().get(&key).cloned();
        if let Some((texture, left)) = known {
            return Ok(self.add(key, texture, left));
        }
        let picture = self.picture(file)?;
        let Picture { file, width, height, mut texels, has_alpha, .. } = picture;
        let mut left = strength;
        if content == Content::Normal {
            match bump::kind(&texels) {
                Kind::Normals => {}
                Kind::Heights => {
                    self.budget
                        .take(4 * texels.len() as u64)
                        .map_err(|_| "there is no memory left for its normals")?;
                    texels = bump::to_normals(&texels, width, strength, false).into();
                    left = 1.0;
                }
                Kind::Neither => {
                    return Err("normals are bluish and heights are gray, and this is neither".to_owned());
                }
            }
        }
        let texture = Texture { file, content, width, height, texels, has_alpha };
        self.read.borrow_mut().insert(key.clone(), (texture.clone(), left));
        Ok(self.add(key, texture, left))
    }

    fn add(&mut self, key: (String, Content, u32), texture: Texture, strength: f32) -> Map {
        let number = self.textures.len() as u32;
        self.textures.push(texture);
        let map = Map { texture: number, scale: Vec2::ONE, offset: Vec2::ZERO, clamp: false, strength };
        self.made.insert(key, map);
        map
    }

    fn picture(&mut self, file: &str) -> Result<Picture, String> {
        if self.textures.len() >= self.limits.textures {
            return Err(format!("the scene has more than {} pictures", self.limits.textures));
        }
        let folder = self.reach.folder(self.scene).map_err(|why| why.to_string())?;
        let opened = Confined::relative(Path::new(""), file).and_then(|path| folder.open(&path));
        let opened = opened.map_err(|why| format!("{why}; {}", why.remedy()))?;
        let bytes = read(opened, self.limits.picture_bytes)?;
        let picture = decode(&bytes, file, &self.limits, &mut self.budget)?;
        match picture.note {
            Some(note) => Err(note),
            None => Ok(picture),
        }
    }
}
