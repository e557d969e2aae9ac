//! what a ray tree tells while it is followed -> its rays, each with what it meets and what comes of it

use glam::{Vec2, Vec3};

use super::drawn::Maps;
use super::things::{self, Thing};
use super::traced::{Kind, Meeting, Onward, ShadowRay, Traced, TracedSample, Way};
use crate::cpu::trace::instanced::primitive_at;
use crate::cpu::trace::surface::Surface;
use crate::cpu::trace::tree::Lit;
use crate::cpu::trace::unrolled::nearest;
use crate::cpu::trace::walk::{Walk, walk};
use crate::cpu::witness::{Fork, Picture, Witness};
use crate::scene::Scene;
use crate::tables::{NONE, PLANE, Path, SPHERE, Tables};

/// What was told so far.
pub(super) struct Heard<'a> {
    scene: &'a Scene,
    tables: &'a Tables,
    rays: Vec<Traced>,
    /// The parent of the ray that is followed next, and which way it goes.
    next: Option<(u32, Way)>,
    /// The same for rays that wait, as they lie on the tree's own stack.
    waiting: Vec<(u32, Way)>,
    /// Of the hit that is looked at.
    maps: Maps,
    tangents: Option<[Vec3; 2]>,
}

impl<'a> Heard<'a> {
    pub(super) fn new(scene: &'a Scene, tables: &'a Tables) -> Self {
        Self {
            scene,
            tables,
            rays: Vec::new(),
            next: None,
            waiting: Vec::new(),
            maps: Maps::default(),
            tangents: None,
        }
    }

    pub(super) fn sample(self, color: Vec3) -> TracedSample {
        TracedSample { at: Vec2::ZERO, rays: self.rays, color }
    }

    /// The ray in hand; a new one if the tree has taken up another.
    fn ray(&mut self, path: &Path) -> &mut Traced {
        if path.rays as usize == self.rays.len() {
            let from = self.next.take().or_else(|| self.waiting.pop());
            self.rays.push(Traced {
                way: from.map_or(Way::Primary, |(_, way)| way),
                parent: from.map(|(parent, _)| parent),
                depth: path.depth,
                inside: path.inside == 1,
                weight: path.weight,
                origin: path.origin,
                direction: path.direction,
                meets: None,
                background: None,
            });
        }
        &mut self.rays[path.rays as usize]
    }

    /// A hit is a leaf, or in a scene of few things a primitive's own number.
    fn thing(&self, hit: u32) -> (Thing, Kind) {
        let own = if self.tables.few { self.tables.leaves.iter().find(|leaf| leaf.id == hit) } else { None };
        let leaf = own.copied().unwrap_or_else(|| primitive_at(self.tables, hit).leaf);
        let kind = match leaf.kind {
            SPHERE => Kind::Sphere,
            PLANE => Kind::Plane,
            _ => Kind::Triangle,
        };
        (things::traced(self.scene, leaf.id), kind)
    }

    /// What a shadow ray meets first.
    fn blocker(&self, asked: &Lit) -> Option<Thing> {
        let hit = if self.tables.few { nearest(self.tables, asked.shadow).hit } else { self.first(asked) };
        (hit != NONE).then(|| self.thing(hit).0)
    }

    /// The nearest of all that a shadow ray may stop at. A walk to the nearest hit would pass backs of one-sided faces,
    /// which keep light away; so it is the last of walks to any hit, each before the one that was found.
    fn first(&self, asked: &Lit) -> u32 {
        let mut stack = vec![[0; 2]; self.tables.deep as usize];
        let mut nearer = |t| walk(self.tables, &mut stack, asked.shadow, Walk::new(t), u32::MAX, true);
        let mut first = nearer(asked.reach);
        let mut next = first;
        while next.hit != NONE {
            first = next;
            next = nearer(first.t);
        }
        first.hit
    }
}

impl Witness for Heard<'_> {
    fn texel(&mut self, of: Picture, value: Vec3) {
        self.maps.put(of, value);
    }

    fn tangents(&mut self, tangents: [Vec3; 2]) {
        self.tangents = Some(tangents);
    }

    fn met(&mut self, path: &Path, t: f32, surface: &Surface) {
        if self.ray(path).meets.is_some() {
            return;
        }
        let (thing, kind) = self.thing(path.hit);
        let (maps, tangents) = (std::mem::take(&mut self.maps), self.tangents.take());
        self.ray(path).meets = Some(Meeting {
            thing,
            kind,
            t,
            point: surface.point,
            normal: surface.normal,
            maps,
            tangents,
            shading: surface.shading,
            color: surface.material.color,
            specular: surface.specular,
            local: surface.material.local_weight,
            exponent: surface.material.exponent,
            lights: Vec::new(),
            random: Vec2::ZERO,
            ways: Vec::new(),
        });
    }

    fn missed(&mut self, path: &Path, light: Vec3) {
        self.ray(path).background = Some(light);
    }

    fn light(&mut self, asked: &Lit, arrives: bool) {
        let before = asked.reach > 0.0;
        let blocker = if before && !arrives { self.blocker(asked) } else { None };
        let scene = self.scene;
        let Some(Traced { meets: Some(meeting), .. }) = self.rays.last_mut() else { return };
        meeting.lights.push(ShadowRay {
            light: things::light(scene, meeting.lights.len()),
            toward: asked.shadow.direction,
            phong: asked.phong,
            color: asked.color,
            before,
            arrives,
            blocker,
        });
    }

    fn fork(&mut self, told: &Fork) {
        let number = self.rays.len() as u32 - 1;
        let kinds = if told.swapped { [Way::Refracted, Way::Reflected] } else { [Way::Reflected, Way::Refracted] };
        if told.goes[1] {
            self.waiting.push((number, kinds[1]));
        }
        if told.goes[0] {
            self.next = Some((number, kinds[0]));
        }
        let Some(ray) = self.rays.last_mut() else { return };
        ray.background = told.ends;
        let Some(meeting) = &mut ray.meets else { return };
        meeting.random = told.random;
        for (branch, (way, followed)) in told.ways.iter().zip(kinds.into_iter().zip(told.goes)) {
            meeting.ways.push(Onward { way, direction: branch.direction, weight: branch.weight, followed });
        }
        meeting.ways.sort_by_key(|onward| onward.way == Way::Refracted);
    }
}
