//! a tree -> the same tree with eight boxes, and eight triangles, side by side

use glam::Vec3;

use super::LANES;
use crate::tables::{INSTANCE, Leaf, Node, SPHERE, Tables};

/// The tree as the lanes walk it: boxes as they are, where a node's bytes are a little larger.
///
/// It takes three times the room of the nodes and as much as the leaves once more.
#[derive(Debug)]
pub struct Wides {
    pub(super) nodes: Vec<Wide>,
    pub(super) blocks: Vec<Block>,
}

/// A node.
#[repr(align(32))]
#[derive(Debug, Clone)]
pub(super) struct Wide {
    /// Lower and upper sides of the children's boxes in x, y and z; of no child what no ray meets.
    pub(super) sides: [[f32; LANES]; 6],
    /// Of each child its node, or the first of its leaves.
    pub(super) children: [u32; LANES],
    /// A bit for each child, and for each that is a node.
    pub(super) taken: u32,
    pub(super) inner: u32,
    /// Two bits for each child: how many leaves it has, none if it is a node.
    pub(super) many: u32,
    /// The first of the blocks of all other children, and which of the children each of them holds.
    pub(super) first: u32,
    pub(super) held: [u32; 3],
}

/// Up to eight triangles, corner by corner and axis by axis.
#[repr(align(32))]
#[derive(Debug, Clone)]
pub(super) struct Block {
    pub(super) corners: [[[f32; LANES]; 3]; 3],
    /// The first of the leaves.
    pub(super) first: u32,
    /// A bit for each triangle, for each sphere, and for each instance.
    pub(super) triangles: u32,
    pub(super) spheres: u32,
    pub(super) instances: u32,
}

impl Wides {
    /// The tree of these tables.
    #[must_use]
    pub fn new(tables: &Tables) -> Self {
        let mut blocks = Vec::new();
        let mut nodes: Vec<Wide> =
            tables.nodes.iter().map(|node| wide(node, &tables.leaves, &mut blocks)).collect();
        // Children stand behind their parents.
        for i in (0..nodes.len()).rev() {
            let inner = nodes[i].inner;
            for child in (0..LANES).filter(|child| inner & 1 << child != 0) {
                let below = &nodes[nodes[i].children[child] as usize].sides;
                let around: [f32; 6] = std::array::from_fn(|side| {
                    let all = below[side].iter().copied();
                    if side % 2 == 0 {
                        all.fold(f32::INFINITY, f32::min)
                    } else {
                        all.fold(f32::NEG_INFINITY, f32::max)
                    }
                });
                for (sides, side) in nodes[i].sides.iter_mut().zip(around) {
                    sides[child] = side;
                }
            }
        }
        Self { nodes, blocks }
    }
}

/// A node whose children are leaves; what is around its other children is not known yet.
fn wide(node: &Node, leaves: &[Leaf], blocks: &mut Vec<Block>) -> Wide {
    let inner = node.inner & 255;
    let nothing: [[f32; LANES]; 6] =
        std::array::from_fn(|side| [if side % 2 == 0 { f32::INFINITY } else { f32::NEG_INFINITY }; LANES]);
    let mut wide = Wide {
        sides: nothing,
        children: std::array::from_fn(|i| node.children + i as u32),
        taken: inner,
        inner,
        many: 0,
        first: blocks.len() as u32,
        held: [0; 3],
    };
    let mut count = 0;
    for child in (0..LANES).filter(|child| node.held >> (3 * child) & 7 != 0) {
        let (first, many) = (count, (node.held >> (3 * child) & 7).count_ones() as usize);
        count += many;
        wide.taken |= 1 << child;
        wide.many |= (many as u32) << (2 * child);
        wide.children[child] = node.leaves + first as u32;
        for i in first..first + many {
            wide.held[i / LANES] |= 1 << child;
            let (low, high) = reach(&leaves[node.leaves as usize + i]);
            for axis in 0..3 {
                let sides = &mut wide.sides;
                sides[2 * axis][child] = sides[2 * axis][child].min(low[axis]);
                sides[2 * axis + 1][child] = sides[2 * axis + 1][child].max(high[axis]);
            }
        }
    }
    let own = &leaves[leaves.len().min(node.leaves as usize)..];
    blocks.extend(own[..count].chunks(LANES).zip(0..).map(|(own, i)| block(own, node.leaves + i * LANES as u32)));
    wide
}

/// The corners of the box around a leaf.
fn reach(leaf: &Leaf) -> (Vec3, Vec3) {
    if leaf.kind == SPHERE {
        let r = leaf.b.x;
        return (leaf.a.map(|x| (x - r).next_down()), leaf.a.map(|x| (x + r).next_up()));
    }
    if leaf.kind == INSTANCE {
        return (leaf.a, leaf.b);
    }
    (leaf.a.min(leaf.b).min(leaf.c), leaf.a.max(leaf.b).max(leaf.c))
}

fn block(leaves: &[Leaf], first: u32) -> Block {
    let mut block = Block { corners: [[[0.0; LANES]; 3]; 3], first, triangles: 0, spheres: 0, instances: 0 };
    for (i, leaf) in leaves.iter().enumerate() {
        match leaf.kind {
            SPHERE => block.spheres |= 1 << i,
            INSTANCE => block.instances |= 1 << i,
            _ => block.triangles |= 1 << i,
        }
        for (corner, place) in [leaf.a, leaf.b, leaf.c].into_iter().zip(&mut block.corners) {
            for (axis, place) in corner.to_array().into_iter().zip(place) {
                place[i] = axis;
            }
        }
    }
    block
}
