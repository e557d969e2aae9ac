//! A model that stands in the scene.

use std::sync::Arc;

use glam::{EulerRot, Quat, Vec3};

use super::model::Model;

/// A model and where it stands.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    /// Shared by all meshes of one file.
    pub model: Arc<Model>,
    /// Where its origin stands, in world space.
    pub translate: Vec3,
    /// Radians that it is turned about x, then about y, then about z.
    pub rotate: Vec3,
    /// Above zero.
    pub scale: f32,
    /// Which of the scene's materials covers it instead of its own.
    pub material: Option<usize>,
    /// Whether its faces are seen from their front alone.
    pub one_sided: bool,
}

impl Mesh {
    /// A model as it is.
    #[must_use]
    pub fn of(model: Arc<Model>) -> Self {
        Self { model, translate: Vec3::ZERO, rotate: Vec3::ZERO, scale: 1.0, material: None, one_sided: false }
    }

    /// A direction of the model in world space, of the same length.
    #[must_use]
    pub fn turn(&self, v: Vec3) -> Vec3 {
        if self.rotate == Vec3::ZERO {
            return v;
        }
        // z y x: x is the first to turn.
        Quat::from_euler(EulerRot::ZYX, self.rotate.z, self.rotate.y, self.rotate.x) * v
    }

    /// A point of the model in world space.
    #[must_use]
    pub fn place(&self, p: Vec3) -> Vec3 {
        self.turn(p * self.scale) + self.translate
    }
}
