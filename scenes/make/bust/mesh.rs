//! A distance function in, a closed triangle mesh out: marching tetrahedra over the blocks that the
//! surface passes through, then every vertex pulled onto the surface.

use glam::{IVec3, Vec3, vec3};
use rayon::prelude::*;
use std::collections::{HashMap, HashSet};

/// Positions and counter-clockwise triangles seen from outside.
pub struct Mesh {
    pub at: Vec<Vec3>,
    pub faces: Vec<[u32; 3]>,
}

/// Where to look for the surface, and how finely.
pub struct Grid {
    pub low: Vec3,
    pub high: Vec3,
    pub cell: f32,
}

const BLOCK: i32 = 8;

/// The corners of a cube's six tetrahedra, each a path from corner 0 to corner 7 along the axes
/// (Kuhn's subdivision): neighbouring cubes agree on their shared faces, so no crack can open.
const TETRAHEDRA: [[u8; 4]; 6] =
    [[0, 1, 3, 7], [0, 3, 2, 7], [0, 2, 6, 7], [0, 6, 4, 7], [0, 4, 5, 7], [0, 5, 1, 7]];

fn corner(i: u8) -> IVec3 {
    IVec3::new(i32::from(i & 1), i32::from(i >> 1 & 1), i32::from(i >> 2))
}

/// The surface where `f` is zero.
pub fn march(grid: &Grid, f: &(dyn Fn(Vec3) -> f32 + Sync)) -> Mesh {
    let cells = ((grid.high - grid.low) / grid.cell).ceil().as_ivec3();
    let blocks = (cells + BLOCK - 1) / BLOCK;
    let place = |c: IVec3| grid.low + c.as_vec3() * grid.cell;
    let reach = grid.cell * BLOCK as f32 * 0.87 * 1.5;
    let all: Vec<IVec3> = (0..blocks.z)
        .flat_map(|z| (0..blocks.y).flat_map(move |y| (0..blocks.x).map(move |x| IVec3::new(x, y, z) * BLOCK)))
        .collect();
    let mut next: Vec<IVec3> =
        all.into_par_iter().filter(|&b| f(place(b) + grid.cell * BLOCK as f32 * 0.5).abs() < reach).collect();
    let mut seen: HashSet<IVec3> = next.iter().copied().collect();
    let mut soups = Vec::new();
    while !next.is_empty() {
        let done: Vec<Piece> = next.par_iter().map(|&b| block(b, &place, f)).collect();
        // Should a bad bound have hidden a block, the surface that leaves its neighbour leads to it.
        let exits = next.iter().zip(&done).flat_map(|(&b, piece)| piece.exits.iter().map(move |&e| b + e * BLOCK));
        next = exits.filter(|&b| seen.insert(b)).collect();
        soups.extend(done.into_iter().map(|piece| piece.triangles));
    }
    let mut index = HashMap::new();
    let mut mesh = Mesh { at: Vec::new(), faces: Vec::new() };
    for triangle in soups.into_iter().flatten() {
        mesh.faces.push(triangle.map(|(key, p)| {
            *index.entry(key).or_insert_with(|| {
                mesh.at.push(p);
                mesh.at.len() as u32 - 1
            })
        }));
    }
    let mut mesh = largest(mesh);
    mesh.at.par_iter_mut().for_each(|p| *p = pull(f, *p, grid.cell));
    mesh
}

/// Drops crumbs and inner bubbles: all that does not hang together with the largest piece.
fn largest(mesh: Mesh) -> Mesh {
    let mut parent: Vec<u32> = (0..mesh.at.len() as u32).collect();
    fn root(parent: &mut [u32], mut k: u32) -> u32 {
        while parent[k as usize] != k {
            parent[k as usize] = parent[parent[k as usize] as usize];
            k = parent[k as usize];
        }
        k
    }
    for f in &mesh.faces {
        let a = root(&mut parent, f[0]);
        for &k in &f[1..] {
            let b = root(&mut parent, k);
            parent[b as usize] = a;
        }
    }
    let mut count = vec![0u32; mesh.at.len()];
    for f in &mesh.faces {
        count[root(&mut parent, f[0]) as usize] += 1;
    }
    let most = (0..count.len()).max_by_key(|&k| count[k]).unwrap_or(0) as u32;
    let mut rename = vec![u32::MAX; mesh.at.len()];
    let mut out = Mesh { at: Vec::new(), faces: Vec::new() };
    for f in mesh.faces.iter().filter(|f| root(&mut parent, f[0]) == most) {
        out.faces.push(f.map(|k| {
            if rename[k as usize] == u32::MAX {
                rename[k as usize] = out.at.len() as u32;
                out.at.push(mesh.at[k as usize]);
            }
            rename[k as usize]
        }));
    }
    out
}

/// What one block holds of the surface, and the sides by which the surface leaves it.
struct Piece {
    triangles: Vec<[(u64, Vec3); 3]>,
    exits: Vec<IVec3>,
}

/// The triangles of one block; a vertex is known by the lattice edge that it lies on.
fn block(origin: IVec3, place: &dyn Fn(IVec3) -> Vec3, f: &dyn Fn(Vec3) -> f32) -> Piece {
    const SIDE: i32 = BLOCK + 1;
    let mut field = vec![0.0f32; (SIDE * SIDE * SIDE) as usize];
    let slot = |c: IVec3| ((c.z * SIDE + c.y) * SIDE + c.x) as usize;
    for z in 0..SIDE {
        for y in 0..SIDE {
            for x in 0..SIDE {
                let c = IVec3::new(x, y, z);
                let d = f(place(origin + c));
                // Nothing may lie exactly on the lattice, or triangles would have no area.
                field[slot(c)] = if d.abs() < 1e-6 { 1e-6 } else { d };
            }
        }
    }
    let mut out = Vec::new();
    let cross = |a: IVec3, b: IVec3| {
        let (va, vb) = (field[slot(a)], field[slot(b)]);
        let t = (va / (va - vb)).clamp(0.2, 0.8);
        let low = origin + a.min(b);
        let kind = (b - a).abs().dot(IVec3::new(1, 2, 4)) as u64;
        let key = ((low.z as u64 * 4096 + low.y as u64) * 4096 + low.x as u64) * 8 + kind;
        (key, place(origin + a).lerp(place(origin + b), t))
    };
    for i in 0..BLOCK * BLOCK * BLOCK {
        let cell = IVec3::new(i % BLOCK, i / BLOCK % BLOCK, i / (BLOCK * BLOCK));
        for tetrahedron in TETRAHEDRA {
            let c = tetrahedron.map(|k| cell + corner(k));
            let (inside, outside): (Vec<IVec3>, Vec<IVec3>) = c.iter().partition(|&&q| field[slot(q)] < 0.0);
            let quad = match (inside.len(), outside.len()) {
                (1, 3) => {
                    vec![cross(inside[0], outside[0]), cross(inside[0], outside[1]), cross(inside[0], outside[2])]
                }
                (3, 1) => {
                    vec![cross(inside[0], outside[0]), cross(inside[1], outside[0]), cross(inside[2], outside[0])]
                }
                (2, 2) => vec![
                    cross(inside[0], outside[0]),
                    cross(inside[0], outside[1]),
                    cross(inside[1], outside[1]),
                    cross(inside[1], outside[0]),
                ],
                _ => continue,
            };
            let middle = |s: &[IVec3]| s.iter().map(|q| q.as_vec3()).sum::<Vec3>() / s.len() as f32;
            let outward = middle(&outside) - middle(&inside);
            for k in 2..quad.len() {
                let (a, b, c) = (quad[0], quad[k - 1], quad[k]);
                let faces_out = (b.1 - a.1).cross(c.1 - a.1).dot(outward) > 0.0;
                out.push(if faces_out { [a, b, c] } else { [a, c, b] });
            }
        }
    }
    Piece { triangles: out, exits: exits(&field) }
}

/// The sides of a block on which its field changes sign.
fn exits(field: &[f32]) -> Vec<IVec3> {
    let side = BLOCK as usize + 1;
    let stride = [1, side, side * side];
    let mut out = Vec::new();
    for axis in 0..3 {
        let (u, v) = (stride[(axis + 1) % 3], stride[(axis + 2) % 3]);
        for (start, way) in [(0, -1), (stride[axis] * BLOCK as usize, 1)] {
            let inside = (0..side * side).filter(|i| field[start + i % side * u + i / side * v] < 0.0).count();
            if inside > 0 && inside < side * side {
                out.push(IVec3::AXES[axis] * way);
            }
        }
    }
    out
}

/// Gradient by four samples at the corners of a tetrahedron.
pub fn slope(f: &dyn Fn(Vec3) -> f32, p: Vec3, e: f32) -> Vec3 {
    let k = [vec3(1.0, -1.0, -1.0), vec3(-1.0, -1.0, 1.0), vec3(-1.0, 1.0, -1.0), vec3(1.0, 1.0, 1.0)];
    k.iter().map(|&k| k * f(p + k * e)).sum::<Vec3>() / (4.0 * e)
}

/// Newton steps onto the surface, never further than half a cell.
fn pull(f: &dyn Fn(Vec3) -> f32, p: Vec3, cell: f32) -> Vec3 {
    let mut q = p;
    for _ in 0..2 {
        let g = slope(f, q, cell * 0.15);
        q -= g * f(q) / g.length_squared().max(0.25);
    }
    if q.distance(p) < cell * 0.5 { q } else { p }
}
