//! Corners of one polygon in space -> its triangles, as places in the list of corners.
//!
//! n corners always give n - 2 triangles in which every side of the polygon appears once: a neighbor
//! that shares a side still meets it, whatever the polygon looks like, so that no crack opens. Corners
//! on a straight side are kept for the same reason. (The crate `earcut` 0.4 gives fewer triangles for
//! polygons that touch or cross themselves, and reads memory unchecked.)

use glam::{DVec2, DVec3, Vec3};

/// How much work [`Cutter::cut`] may put into concave polygons, in corners looked at; when it is spent,
/// they are fanned. The work grows with the square of the corners: this is a second or so.
pub const FUEL: u64 = 1 << 29;

/// How a polygon was cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cut {
    /// Convex, or of three corners: a fan from the first corner.
    Fan,
    /// Concave: by ears.
    Ears,
    /// It crosses or touches itself, so that no way is right; all corners are used.
    Crossing,
    /// Concave, but with too many corners for the fuel that was left: a fan.
    TooLarge,
}

/// Cuts polygons; keeps its lists between them.
#[derive(Debug)]
pub struct Cutter {
    fuel: u64,
    flat: Vec<DVec2>,
    next: Vec<u32>,
    previous: Vec<u32>,
    /// Corners that are not convex: only they can lie in an ear.
    hollow: Vec<u32>,
}

impl Default for Cutter {
    fn default() -> Self {
        Self { fuel: FUEL, flat: Vec::new(), next: Vec::new(), previous: Vec::new(), hollow: Vec::new() }
    }
}

impl Cutter {
    /// Replaces `triangles` with the polygon's. Its corners run the same way around.
    pub fn cut(&mut self, corners: &[Vec3], triangles: &mut Vec<[u32; 3]>) -> Cut {
        triangles.clear();
        let count = corners.len() as u32;
        if count <= 3 || !self.flatten(corners) {
            fan(count, triangles);
            return Cut::Fan;
        }
        self.link(count);
        let mut hollow = std::mem::take(&mut self.hollow);
        hollow.extend((0..count).filter(|&at| self.turn_at(at) <= 0.0));
        self.hollow = hollow;
        // Straight corners alone leave a polygon convex.
        if self.hollow.iter().all(|&at| self.turn_at(at) == 0.0) {
            fan(count, triangles);
            return Cut::Fan;
        }
        self.cut_ears(count, triangles)
    }

    /// Lays the polygon into the coordinate plane that it faces most, by leaving one coordinate out:
    /// nothing is rounded. False if it has no area.
    fn flatten(&mut self, corners: &[Vec3]) -> bool {
        let normal = newell(corners);
        let size = normal.abs();
        let (onto, facing): (fn(Vec3) -> DVec2, f64) = if size.x >= size.y && size.x >= size.z {
            (|p| DVec2::new(p.y.into(), p.z.into()), normal.x)
        } else if size.y >= size.z {
            (|p| DVec2::new(p.z.into(), p.x.into()), normal.y)
        } else {
            (|p| DVec2::new(p.x.into(), p.y.into()), normal.z)
        };
        // Seen from behind the polygon runs clockwise; a mirror puts that right.
        let mirror = DVec2::new(1_f64.copysign(facing), 1.0);
        self.flat.clear();
        self.flat.extend(corners.iter().map(|&p| onto(p) * mirror));
        facing != 0.0
    }

    fn link(&mut self, count: u32) {
        self.next.clear();
        self.previous.clear();
        self.hollow.clear();
        self.next.extend((0..count).map(|at| (at + 1) % count));
        self.previous.extend((0..count).map(|at| (at + count - 1) % count));
    }

    /// Takes ears off (Meisters 1975): a convex corner with no other corner in its triangle. Goes on two
    /// corners further after each, which avoids slivers.
    fn cut_ears(&mut self, count: u32, triangles: &mut Vec<[u32; 3]>) -> Cut {
        let mut result = Cut::Ears;
        let mut left = count;
        let mut at = 0;
        // Corners tried since the last ear.
        let mut tried = 0;
        while left > 3 {
            let cost = self.hollow.len() as u64 + 1;
            if self.fuel < cost {
                triangles.clear();
                fan(count, triangles);
                return Cut::TooLarge;
            }
            self.fuel -= cost;
            let stuck = tried > left;
            // A simple polygon always has an ear; another one gives the first corner that turns left,
            // or in the end any.
            let is_ear = if stuck { self.turn_at(at) > 0.0 || tried > 2 * left } else { self.is_ear(at) };
            let (before, after) = self.neighbors(at);
            if !is_ear {
                at = after;
                tried += 1;
                continue;
            }
            if stuck {
                result = Cut::Crossing;
            }
            let ear = at;
            triangles.push([before, ear, after]);
            set(&mut self.next, before, after);
            set(&mut self.previous, after, before);
            left -= 1;
            tried = 0;
            at = self.neighbors(after).1;
            // Taking an ear can only open its neighbors, never close them.
            let mut hollow = std::mem::take(&mut self.hollow);
            hollow.retain(|&corner| {
                let opened = (corner == before || corner == after) && self.turn_at(corner) > 0.0;
                corner != ear && !opened
            });
            self.hollow = hollow;
        }
        if self.turn_at(at) < 0.0 {
            result = Cut::Crossing;
        }
        let (before, after) = self.neighbors(at);
        triangles.push([before, at, after]);
        result
    }

    fn is_ear(&self, at: u32) -> bool {
        let (before, after) = self.neighbors(at);
        let [a, b, c] = [before, at, after].map(|corner| self.point(corner));
        turn(a, b, c) > 0.0
            && !self.hollow.iter().any(|&corner| {
                let p = self.point(corner);
                // A corner in the same place (as of a hole that is joined by a bridge) touches only.
                p != a && p != b && p != c && turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0
            })
    }

    fn turn_at(&self, at: u32) -> f64 {
        let (before, after) = self.neighbors(at);
        turn(self.point(before), self.point(at), self.point(after))
    }

    fn neighbors(&self, at: u32) -> (u32, u32) {
        let of = |list: &[u32]| list.get(at as usize).copied().unwrap_or(0);
        (of(&self.previous), of(&self.next))
    }

    fn point(&self, at: u32) -> DVec2 {
        self.flat.get(at as usize).copied().unwrap_or(DVec2::ZERO)
    }
}

fn set(list: &mut [u32], at: u32, value: u32) {
    if let Some(slot) = list.get_mut(at as usize) {
        *slot = value;
    }
}

fn fan(count: u32, triangles: &mut Vec<[u32; 3]>) {
    triangles.extend((2..count).map(|at| [0, at - 1, at]));
}

/// Twice the triangle's area, above 0 if it runs counterclockwise.
fn turn(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b - a).perp_dot(c - a)
}

/// Twice the polygon's area along its normal (Newell; see Sutherland, Sproull & Schumacker 1974),
/// seen from its first corner, so that a polygon far from the origin keeps its digits.
fn newell(corners: &[Vec3]) -> DVec3 {
    let origin = corners.first().map_or(DVec3::ZERO, |first| first.as_dvec3());
    let sides = corners.iter().zip(corners.iter().cycle().skip(1));
    sides.map(|(a, b)| (a.as_dvec3() - origin).cross(b.as_dvec3() - origin)).sum()
}
