//! World points in, the bust's distance and its parts out: where head, hair, horns, body and
//! plinth come together.

use crate::hair;
use crate::head;
use crate::lock::Lock;
use crate::sdf::{common, join, smooth};
use crate::torso;
use glam::{Mat3, Vec3, vec3};

const SCALE: f32 = 0.80;
const PLACE: Vec3 = vec3(0.0, 0.50, 0.03);

/// Distances to the parts at one point, in world units.
#[derive(Clone, Copy)]
pub struct Parts {
    pub skin: f32,
    pub hair: f32,
    pub horn: f32,
    pub cloak: f32,
    pub plinth: f32,
    pub all: f32,
    /// The point as the head sees it, both halves folded onto one.
    pub face: Vec3,
}

pub struct Bust {
    turn: Mat3,
    hair: Vec<Lock>,
    near: Vec<Near>,
    horns: Vec<Lock>,
}

/// For one cube of head space, the locks that pass close by, and how far off the others stay.
struct Near {
    locks: Vec<u16>,
    rest: f32,
}

/// Cubes along each axis, over -1..1.
const CUBES: usize = 28;

impl Bust {
    pub fn new() -> Bust {
        // The head is turned and bowed a little: stiff symmetry looks dead.
        let turn = Mat3::from_rotation_y(0.20) * Mat3::from_rotation_z(-0.05) * Mat3::from_rotation_x(0.06);
        let mut bust = Bust { turn, hair: Vec::new(), near: Vec::new(), horns: hair::horns() };
        bust.hair = hair::hair(&|p| bust.ground(p));
        let side = 2.0 / CUBES as f32;
        for i in 0..CUBES * CUBES * CUBES {
            let cube = vec3((i % CUBES) as f32, (i / CUBES % CUBES) as f32, (i / CUBES / CUBES) as f32);
            let middle = (cube + 0.5) * side - 1.0;
            let mut near = Near { locks: Vec::new(), rest: 1.0 };
            for (k, lock) in bust.hair.iter().enumerate() {
                let gap = lock.bound(middle) - side * 0.87;
                if gap < 0.19 { near.locks.push(k as u16) } else { near.rest = near.rest.min(gap) }
            }
            bust.near.push(near);
        }
        bust
    }

    fn to_head(&self, p: Vec3) -> Vec3 {
        self.turn.transpose() * (p - PLACE) / SCALE
    }

    fn to_world(&self, p: Vec3) -> Vec3 {
        self.turn * (p * SCALE) + PLACE
    }

    /// What hair lies on, in head space.
    fn ground(&self, p: Vec3) -> f32 {
        join(head::base(p), torso::body(self.to_world(p)) / SCALE, 0.05)
    }

    /// All the distances at a point; `fine` adds what only the maps can hold.
    pub fn parts(&self, p: Vec3, fine: bool) -> Parts {
        let q = self.to_head(p);
        // Parts that are far off are answered by a bound, for speed; 0.13 is the least such answer.
        let (body, cloak) = if p.y > 0.72 { (p.y - 0.55, p.y - 0.55) } else { torso::figure(p) };
        let plinth = if p.y > -0.25 { p.y + 0.40 } else { torso::plinth(p) };
        let base = if q.y < -1.0 { -0.8 - q.y } else { head::base(q) };
        let face = if q.y < -1.0 { base } else { head::face(q, base) } * SCALE;
        let skin = join(face, body, 0.05);
        let mut hair = cap(q, base) * SCALE;
        let outside = q.abs().max_element() - 1.0;
        if outside < 0.0 {
            let cube = ((q + 1.0) * 0.5 * CUBES as f32).as_uvec3().to_array().map(|x| (x as usize).min(CUBES - 1));
            let near = &self.near[(cube[2] * CUBES + cube[1]) * CUBES + cube[0]];
            for lock in near.locks.iter().map(|&k| &self.hair[k as usize]) {
                let limit = hair / SCALE + 0.0125;
                if lock.bound(q) < limit {
                    hair = join(hair, lock.distance(q, fine, limit) * SCALE, 0.010);
                }
            }
            hair = hair.min(near.rest * SCALE);
        } else {
            hair = hair.min((outside + 0.19) * SCALE);
        }
        let mut horn = f32::MAX;
        for h in &self.horns {
            let bound = h.bound(q);
            horn = horn.min(if bound > 0.18 { bound } else { h.distance(q, fine, 0.3) } * SCALE);
        }
        let mut all = join(skin, hair, 0.012);
        all = join(all, horn, 0.012);
        all = join(all, cloak, 0.008);
        all = join(all, plinth, 0.01);
        Parts { skin, hair, horn, cloak, plinth, all, face: head::fold(q) }
    }

    pub fn distance(&self, p: Vec3, fine: bool) -> f32 {
        self.parts(p, fine).all
    }
}

/// Hair between the locks, so that neither scalp nor jaw shows.
fn cap(q: Vec3, base: f32) -> f32 {
    let line = 0.33 - 1.1 * smooth(0.22, -0.10, q.z);
    let scalp = base - 0.035 * smooth(line - 0.03, line + 0.08, q.y) + 0.01;
    // The beard's edge runs from the ear down the cheek and under the lip.
    let x = q.x.abs();
    let edge = -0.10 - 0.26 * smooth(0.26, 0.10, x) - 0.1 * smooth(0.1, 0.0, x);
    let jaw = common(base - 0.03, (q.y - edge).max(-0.02 - q.z), 0.03);
    scalp.min(jaw)
}
