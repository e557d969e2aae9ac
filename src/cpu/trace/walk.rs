//! a ray and the scene -> its nearest hit, or the first that stands in its way

#![expect(clippy::inline_always, reason = "see `aim`")]

use fearless_simd::{Level, Simd, dispatch};

use crate::cpu::trace::aim::Ray;
use crate::cpu::trace::boxes::{Gaze, boxes_met};
use crate::cpu::trace::instanced::primitive_at;
use crate::cpu::trace::meet::meet_plane;
use crate::cpu::trace::seat::Seat;
use crate::cpu::trace::stack::{Group, INSTANCES, put};
use crate::cpu::trace::triangle::{Sight, meet_triangle};
use crate::tables::{FAR, INSTANCE, NONE, Plane, SPHERE, Tables};

/// Where a walk is, and what it has found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Walk {
    /// Only what is nearer than this counts; the distance to the hit once there is one.
    pub t: f32,
    /// The leaf, or [`NONE`]; of two at one distance the one whose number is lower.
    pub hit: u32,
    /// See [`Path`](crate::tables::Path).
    pub next: u32,
    /// Steps taken: a node or a primitive asked is one.
    pub turns: u32,
    /// [`STACK_FULL`](crate::tables::STACK_FULL).
    pub flags: u32,
}

impl Walk {
    /// A walk that has not begun; only what is nearer than `t` counts.
    #[must_use]
    pub fn new(t: f32) -> Self {
        Self { t, hit: NONE, next: 0, turns: 0, flags: 0 }
    }

    /// Whether there is nothing left to ask.
    #[must_use]
    pub fn over(&self, tables: &Tables, any: bool) -> bool {
        self.next == tables.settings.planes + 1 || (any && self.hit != NONE)
    }
}

/// Asks the planes: they lie below no node.
#[must_use]
pub fn past_planes(tables: &Tables, ray: Ray, mut walk: Walk, most: u32, any: bool) -> Walk {
    while walk.next < tables.settings.planes && walk.turns < most && !(any && walk.hit != NONE) {
        let i = walk.next;
        let leaf = &tables.leaves[i as usize];
        let t = meet_plane(ray, &Plane { point: leaf.a, material: 0, normal: leaf.b, pad: 0 });
        if t < walk.t && ray.leaves != i {
            walk.t = t;
            walk.hit = i;
        }
        walk.next = i + 1;
        walk.turns += 1;
    }
    walk
}

/// Goes on from `start` until `most` steps are taken, or a few more: all primitives of a node are asked in one go.
/// With `any`, stops at the first that is met.
///
/// `stack` has `deep` places: the children of nodes that are still to be asked, where a node's places begin, and a bit for
/// each of them, at `place ^ octant`. Or instances that are still to be asked: where a node's leaves begin, with the
/// highest bit, and a bit for each. Where there are instances, the last place says in which of them the walk is.
#[must_use]
pub fn walk(tables: &Tables, stack: &mut [[u32; 2]], ray: Ray, start: Walk, most: u32, any: bool) -> Walk {
    if tables.instances.is_empty() {
        dispatch!(Level::new(), simd => go_on::<_, false>(simd, tables, stack, &ray, start, most, any))
    } else {
        dispatch!(Level::new(), simd => go_on::<_, true>(simd, tables, stack, &ray, start, most, any))
    }
}

/// A seat, and the ray there as boxes and as triangles ask for it: none of them changes without the others.
#[inline(always)]
fn seated<S: Simd>(simd: S, seat: Seat) -> (Seat, Gaze<S>, Sight<S>) {
    let gaze = Gaze::new(simd, &seat);
    let sight = Sight::new(simd, &seat);
    (seat, gaze, sight)
}

/// Without `PLACED` there are no instances, and nothing is asked about them. The ray is not copied: a copy that reads
/// sixteen bytes at a time what was just written eight at a time waits for the cache, and so does all that comes after.
#[inline(always)]
fn go_on<S: Simd, const PLACED: bool>(
    simd: S,
    tables: &Tables,
    stack: &mut [[u32; 2]],
    ray: &Ray,
    start: Walk,
    most: u32,
    any: bool,
) -> Walk {
    let mut walk = start;
    let planes = tables.settings.planes;
    if walk.next < planes {
        walk = past_planes(tables, *ray, walk, most, any);
        if walk.next < planes {
            return walk;
        }
    }

    let (mut seat, mut gaze, mut sight) = seated(simd, Seat::in_world(tables, *ray));
    let room = stack.len() - usize::from(PLACED);
    // The instance that the walk is in, and how much of the stack is the world's then.
    let (mut within, mut base) = (NONE, 0);
    // The number of the hit; nothing wins a tie against the reach of a ray.
    let mut id = if walk.hit == NONE { 0 } else { primitive_at(tables, walk.hit).leaf.id };
    // What of the stack is in hand.
    let mut group = if walk.next == planes { Group::root(0, seat.aim.octant) } else { Group::NONE };
    let mut size = (walk.next.max(planes + 1) - planes - 1) as usize;
    if PLACED && size > 0 {
        [within, base] = stack[room];
        if let Some(placed) = tables.instances.get(within as usize) {
            (seat, gaze, sight) = seated(simd, Seat::in_instance(tables, *ray, placed));
        }
    }
    while walk.turns < most && !(any && walk.hit != NONE) && (size > 0 || group.is_open()) {
        if PLACED && within != NONE && size == base as usize && !group.is_open() {
            // Back to the world.
            within = NONE;
            (seat, gaze, sight) = seated(simd, Seat::in_world(tables, *ray));
        }
        if !group.is_open() {
            size -= 1;
            let [begin, left] = stack[size];
            group = Group { begin, left };
        }
        if PLACED && group.begin >= INSTANCES {
            // The next of some instances: its root, the only child of nothing.
            within = tables.leaves[((group.begin ^ INSTANCES) + group.left.trailing_zeros()) as usize].material;
            group.left &= group.left - 1;
            size = put(stack, room, group, size, &mut walk.flags);
            base = size as u32;
            let placed = &tables.instances[within as usize];
            (seat, gaze, sight) = seated(simd, Seat::in_instance(tables, *ray, placed));
            group = Group::root(placed.root, seat.aim.octant);
        }
        let first_bit = group.left.ilog2();
        group.left ^= 1 << first_bit;
        let node = &tables.nodes[(group.begin + (first_bit ^ seat.aim.octant)) as usize];
        let [below, mut met] = boxes_met(simd, node, &gaze, walk.t);
        // What is left of a group stays in hand, unless there is more below.
        if below != 0 {
            size = put(stack, room, group, size, &mut walk.flags);
            group = Group { begin: node.children, left: below };
        }
        walk.turns += 1;
        // Those of the primitives that are instances.
        let mut later = 0;
        while met != 0 && !(any && walk.hit != NONE) {
            let place = (node.held & !met & (met - 1)).count_ones();
            let i = node.leaves + place;
            met &= met - 1;
            let leaf = &tables.leaves[i as usize];
            walk.turns += 1;
            if PLACED && leaf.kind == INSTANCE {
                later |= 1 << place;
                continue;
            }
            let number = i.wrapping_add(seat.numbers);
            let t = if leaf.kind == SPHERE {
                seat.meet_sphere(leaf, number)
            } else if seat.ray.leaves == number {
                FAR
            } else {
                meet_triangle(simd, leaf, &sight)
            };
            let nearer = t < walk.t || (t == walk.t && leaf.id + seat.ids < id);
            if nearer && seat.is_solid(tables, leaf, any) {
                walk.t = t;
                walk.hit = number;
                id = leaf.id + seat.ids;
            }
        }
        if PLACED && later != 0 {
            size = put(stack, room, group, size, &mut walk.flags);
            group = Group { begin: node.leaves | INSTANCES, left: later };
        }
    }
    size = put(stack, room, group, size, &mut walk.flags);
    if PLACED {
        stack[room] = [within, base];
    }
    walk.next = planes + 1 + size as u32;
    walk
}
