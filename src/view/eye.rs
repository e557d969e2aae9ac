//! drags, wheel turns and keys -> where the eye is
//!
//! Distances across the picture are in shares of its height, right and down; a drag moves what is under the cursor.

use glam::{Quat, Vec2, Vec3};

use crate::math::vector::unit;
use crate::prepare::pose;
use crate::scene::Camera;

/// Half the field of view on the far side of which `up` is never brought: the eye does not turn over.
const STEEPEST: f32 = 0.02;

/// Sides from which a scene is looked at as a whole.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum From {
    /// Along -z.
    Front,
    /// Along +z.
    Back,
    /// Along -x.
    Right,
    /// Along +x.
    Left,
    /// Along -y.
    Top,
    /// Along +y.
    Bottom,
    /// From the right, above, before.
    Corner,
}

impl From {
    /// Towards the eye, and up in the picture.
    fn axes(self) -> [Vec3; 2] {
        match self {
            Self::Front => [Vec3::Z, Vec3::Y],
            Self::Back => [Vec3::NEG_Z, Vec3::Y],
            Self::Right => [Vec3::X, Vec3::Y],
            Self::Left => [Vec3::NEG_X, Vec3::Y],
            Self::Top => [Vec3::Y, Vec3::NEG_Z],
            Self::Bottom => [Vec3::NEG_Y, Vec3::Z],
            Self::Corner => [Vec3::ONE, Vec3::Y],
        }
    }
}

/// Moves of a camera by hand.
pub trait Eye {
    /// Turns the eye about `pivot` as if the scene were a ball under the hand: a drag over the height is half a turn.
    fn orbit(&mut self, pivot: Vec3, drag: Vec2);
    /// Moves the eye sideways, so that `pivot` stays under the cursor.
    fn pan(&mut self, pivot: Vec3, drag: Vec2);
    /// Goes nearer to `point` (`factor` < 1) or away from it; it stays where it is in the picture.
    fn dolly(&mut self, point: Vec3, factor: f32);
    /// Looks around.
    fn turn(&mut self, drag: Vec2);
    /// Flies: to the right, up and forward, in world units.
    fn fly(&mut self, way: Vec3);
    /// Looks at `point` and stays where it is.
    fn look(&mut self, point: Vec3);
    /// Looks from a side at what it looks at now.
    fn from(&mut self, side: From);
    /// Steps back until a ball fits into the picture, in the direction that it looks in.
    fn frame(&mut self, center: Vec3, radius: f32, aspect: f32);
    /// The point at the depth of `pivot` under a place of the picture: -0.5 to 0.5 down, and so many heights across.
    fn under(&self, pivot: Vec3, place: Vec2) -> Vec3;
    /// The place of the picture that a point before the eye is seen at: what [`Eye::under`] asks for.
    fn place(&self, point: Vec3) -> Vec2;
    /// How far before the eye a point lies, along the view.
    fn depth(&self, point: Vec3) -> f32;
}

/// Height of the picture in world units at the depth of a point.
fn height_at(camera: &Camera, point: Vec3) -> f32 {
    let [_, _, back] = pose(camera);
    let depth = (camera.position - point).dot(back).abs().max(1e-6);
    2.0 * depth * (camera.fov / 2.0).tan()
}

impl Eye for Camera {
    fn orbit(&mut self, pivot: Vec3, drag: Vec2) {
        let up = unit(self.up);
        let [right, _, back] = pose(self);
        let around = Quat::from_axis_angle(up, -drag.x * std::f32::consts::PI);
        let wanted = -drag.y * std::f32::consts::PI;
        // From straight above to straight below.
        let fall = back.dot(up).clamp(-1.0, 1.0).acos();
        let tilt = (fall + wanted).clamp(STEEPEST, std::f32::consts::PI - STEEPEST) - fall;
        let turn = around * Quat::from_axis_angle(right, tilt);
        for point in [&mut self.position, &mut self.look_at] {
            *point = pivot + turn * (*point - pivot);
        }
    }

    fn pan(&mut self, pivot: Vec3, drag: Vec2) {
        let [right, up, _] = pose(self);
        let step = (right * -drag.x + up * drag.y) * height_at(self, pivot);
        self.position += step;
        self.look_at += step;
    }

    fn dolly(&mut self, point: Vec3, factor: f32) {
        self.position = point + (self.position - point) * factor;
        self.look_at = point + (self.look_at - point) * factor;
    }

    fn turn(&mut self, drag: Vec2) {
        let eye = self.position;
        // The same as turning the world about the eye, the other way.
        self.orbit(eye, -drag * (self.fov / std::f32::consts::PI));
    }

    fn fly(&mut self, way: Vec3) {
        let [right, up, back] = pose(self);
        let step = right * way.x + up * way.y - back * way.z;
        self.position += step;
        self.look_at += step;
    }

    fn look(&mut self, point: Vec3) {
        let [_, _, back] = pose(self);
        let toward = self.position - point;
        // Straight up or down there is no up in the picture.
        if toward.length() > 1e-6 && unit(toward).cross(unit(self.up)).length() > STEEPEST {
            self.look_at = point;
        } else {
            self.look_at = self.position - back * toward.length().max(1e-3);
        }
    }

    fn from(&mut self, side: From) {
        let [toward, up] = side.axes();
        self.position = self.look_at + unit(toward) * self.position.distance(self.look_at);
        self.up = up;
    }

    fn frame(&mut self, center: Vec3, radius: f32, aspect: f32) {
        let [_, _, back] = pose(self);
        let up = self.fov / 2.0;
        let across = (up.tan() * self.aspect.unwrap_or(aspect)).atan();
        let radius = radius.max(1e-6);
        let away = radius / up.min(across).sin();
        self.look_at = center;
        self.position = center + back * away;
        // What was seen up to now is not cut off by planes that were laid for another distance.
        self.near = self.near.min((away - radius).max(radius * 0.01));
        self.far = self.far.max(away + radius * 2.0);
    }

    fn under(&self, pivot: Vec3, place: Vec2) -> Vec3 {
        let [right, up, back] = pose(self);
        let depth = (self.position - pivot).dot(back).max(1e-6);
        let high = height_at(self, pivot);
        self.position - back * depth + right * (place.x * high) - up * (place.y * high)
    }

    fn place(&self, point: Vec3) -> Vec2 {
        let [right, up, _] = pose(self);
        let way = point - self.position;
        Vec2::new(way.dot(right), -way.dot(up)) / height_at(self, point)
    }

    fn depth(&self, point: Vec3) -> f32 {
        let [_, _, back] = pose(self);
        (self.position - point).dot(back)
    }
}
