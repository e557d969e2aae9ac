//! Mesh with normals missing or unusable -> mesh in which every corner has a normal one unit long.
//!
//! A corner without a normal gets the mean of the faces around its position, as its `s` line says:
//! `s off` the face's own normal; `s 1` the mean over smoothing group 1; and where the file has no `s`
//! line, the mean over the faces that turn away by less than about 60 degrees, so that a cube stays a
//! cube and a bust becomes smooth.

use glam::{DVec3, Vec3};

use super::budget::{Budget, Spent};
use super::obj::{Mesh, Smoothing};
use super::{Corner, Error, NONE, Triangle, Warnings};

/// Cosine of the largest angle that is smoothed over where the file does not say: a little more than
/// 60 degrees, so that a hexagonal column is safely on one side of it.
const CREASE: f64 = 0.48;

/// Cosine between a triangle's own normal and those at its corners from which on these are believed: on a sliver the
/// neighbors' may stand across it, or a little beyond.
const CONTRARY: f64 = -0.2;

/// A position with more corners than this has one normal for all but its `s off` ones: comparing each
/// corner with each takes the square of them, and a hostile file has a million around one position.
const CROWD: usize = 128;

/// One corner at the position at hand.
#[derive(Clone, Copy)]
struct Around {
    /// Triangle's number times 3, plus the corner's place in it.
    corner: u32,
    smoothing: Smoothing,
    /// Of the triangle, one unit long; 0 if it has no area.
    face: DVec3,
    weighted: DVec3,
}

/// Makes all normals one unit long and works out those that are missing.
pub(super) fn complete(
    mesh: &mut Mesh,
    file: &str,
    budget: &mut Budget,
    warnings: &mut Warnings,
) -> Result<(), Error> {
    let unusable = normalize(mesh);
    if unusable > 0 {
        let text = format!("{unusable} corners have a normal that is zero or not finite, and get a computed one");
        warnings.add(file, 0, text);
    }
    let turned = turn(mesh);
    if turned > 0 {
        let text = format!("{turned} triangles go the other way round than their normals say, and are turned over");
        warnings.add(file, 0, text);
    }
    let missing = mesh.triangles.iter().flat_map(|triangle| triangle.corners).any(|corner| corner.normal == NONE);
    if !missing {
        return Ok(());
    }
    fill_in(mesh, budget).map_err(|Spent| Error::too_much(file, 0, "bytes of memory for this model", budget.whole))
}

/// Returns how many corners lost a normal that has no direction.
fn normalize(mesh: &mut Mesh) -> u64 {
    let mut all_usable = true;
    for normal in &mut mesh.normals {
        let unit = normal.as_dvec3().normalize_or_zero().as_vec3();
        let is_usable = normal.is_finite() && unit != Vec3::ZERO;
        all_usable &= is_usable;
        // What no corner uses any more is at least a unit vector.
        *normal = if is_usable { unit } else { Vec3::NAN };
    }
    if all_usable {
        return 0;
    }
    let mut lost = 0;
    for corner in mesh.triangles.iter_mut().flat_map(|triangle| &mut triangle.corners) {
        if mesh.normals.get(corner.normal as usize).is_some_and(|normal| normal.is_nan()) {
            corner.normal = NONE;
            lost += 1;
        }
    }
    for normal in mesh.normals.iter_mut().filter(|normal| normal.is_nan()) {
        *normal = Vec3::Y;
    }
    lost
}

/// Makes triangles go counterclockwise seen from where all three of their normals point to. Returns how many did not.
fn turn(mesh: &mut Mesh) -> u64 {
    let Mesh { positions, normals, triangles, .. } = mesh;
    let is_contrary = |triangle: &Triangle| {
        let [a, b, c] = triangle.corners.map(|corner| positions.get(corner.position as usize));
        let (Some(a), Some(b), Some(c)) = (a, b, c) else { return false };
        let [a, b, c] = [a, b, c].map(|p| p.as_dvec3());
        let face = (b - a).cross(c - a).normalize_or_zero();
        let normal = |corner: Corner| normals.get(corner.normal as usize).map(|n| n.as_dvec3());
        triangle.corners.iter().all(|&corner| normal(corner).is_some_and(|n| n.dot(face) < CONTRARY))
    };
    let contrary = triangles.iter_mut().filter(|triangle| is_contrary(triangle));
    contrary.map(|triangle| triangle.corners.swap(1, 2)).count() as u64
}

fn fill_in(mesh: &mut Mesh, budget: &mut Budget) -> Result<(), Spent> {
    let (mut starts, mut corners) = corners_by_position(mesh, budget)?;
    let mut around: Vec<Around> = Vec::new();
    // Normals made for the position at hand, to be shared by corners that get the same one.
    let mut made: Vec<(Vec3, u32)> = Vec::new();
    for range in starts.windows(2) {
        let &[start, end] = range else { continue };
        around.clear();
        let here = corners.get(start as usize..end as usize).unwrap_or_default();
        around.extend(here.iter().filter_map(|&corner| look_around(mesh, corner)));
        made.clear();
        let crowd = around.len() > CROWD;
        let whole = around.iter().map(|other| other.weighted).sum::<DVec3>();
        for own in &around {
            let Some(slot) = normal_slot(mesh, own.corner) else { continue };
            if *slot != NONE {
                continue;
            }
            let sum = match own.smoothing {
                Smoothing::Off => own.face,
                _ if crowd => whole,
                _ => around.iter().filter(|other| are_smooth(own, other)).map(|other| other.weighted).sum(),
            };
            // A triangle without area has no side to show, so that any direction will do.
            let normal = sum.try_normalize().or(own.face.try_normalize()).unwrap_or(DVec3::Y).as_vec3();
            // Looking through more than a crowd would take too long; `s off` corners rarely agree anyway.
            let known = made.iter().rev().take(CROWD).find(|(other, _)| *other == normal).map(|&(_, index)| index);
            let index = if let Some(index) = known {
                index
            } else {
                let index = mesh.normals.len() as u32;
                budget.push(&mut mesh.normals, normal)?;
                made.push((normal, index));
                index
            };
            if let Some(slot) = normal_slot(mesh, own.corner) {
                *slot = index;
            }
        }
    }
    budget.give_back(&mut starts);
    budget.give_back(&mut corners);
    Ok(())
}

/// For each position, where its corners start and end in the list of all corners.
fn corners_by_position(mesh: &Mesh, budget: &mut Budget) -> Result<(Vec<u32>, Vec<u32>), Spent> {
    let positions =
        || mesh.triangles.iter().flat_map(|triangle| triangle.corners).map(|corner| corner.position as usize);
    let mut starts = budget.filled(mesh.positions.len() + 1, 0_u32)?;
    for position in positions() {
        if let Some(count) = starts.get_mut(position) {
            *count += 1;
        }
    }
    // After this sum each entry is its position's end; filling from behind turns it into the start.
    let mut total = 0;
    for entry in &mut starts {
        total += *entry;
        *entry = total;
    }
    let mut corners = budget.filled(mesh.triangles.len() * 3, 0_u32)?;
    for (corner, position) in (0..mesh.triangles.len() as u32 * 3).rev().zip(reversed(mesh)) {
        let Some(end) = starts.get_mut(position) else { continue };
        *end -= 1;
        if let Some(slot) = corners.get_mut(*end as usize) {
            *slot = corner;
        }
    }
    Ok((starts, corners))
}

/// The positions of all corners, last corner first.
fn reversed(mesh: &Mesh) -> impl Iterator<Item = usize> + '_ {
    let corners = |triangle: &super::Triangle| triangle.corners.into_iter().rev();
    mesh.triangles.iter().rev().flat_map(corners).map(|corner| corner.position as usize)
}

fn look_around(mesh: &Mesh, corner: u32) -> Option<Around> {
    let (triangle, place) = (corner as usize / 3, corner as usize % 3);
    let smoothing = mesh.smoothing.get(triangle).copied()?;
    let mut corners = mesh.triangles.get(triangle)?.corners;
    corners.rotate_left(place);
    let [a, b, c] = corners.map(|corner| mesh.positions.get(corner.position as usize).map(|p| p.as_dvec3()));
    let (to_b, to_c) = (b? - a?, c? - a?);
    let normal = to_b.cross(to_c);
    // Max 1999, "Weights for Computing Vertex Normals from Facet Normals": right for spheres, hardly
    // moved by how a polygon is cut, and without the arc cosine of angle weights, whose last bit
    // depends on the machine.
    let weighted = normal / (to_b.length_squared() * to_c.length_squared());
    let weighted = if weighted.is_finite() { weighted } else { DVec3::ZERO };
    Some(Around { corner, smoothing, face: normal.normalize_or_zero(), weighted })
}

fn are_smooth(own: &Around, other: &Around) -> bool {
    own.smoothing == other.smoothing && (own.smoothing != Smoothing::Unsaid || own.face.dot(other.face) > CREASE)
}

fn normal_slot(mesh: &mut Mesh, corner: u32) -> Option<&mut u32> {
    let triangle = mesh.triangles.get_mut(corner as usize / 3)?;
    triangle.corners.get_mut(corner as usize % 3).map(|corner| &mut corner.normal)
}
