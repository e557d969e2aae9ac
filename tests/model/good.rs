//! OBJ texts that people write, and what must come of them.

use glam::{Vec2, Vec3};
use twinlight::scene::model::{Model, NONE};

use crate::scratch::{read, warnings};

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

fn positions(model: &Model) -> Vec<[u32; 3]> {
    model.triangles.iter().map(|triangle| triangle.corners.map(|corner| corner.position)).collect()
}

/// All spellings of one square give the same two triangles and nothing to complain about.
#[test]
fn spellings_of_a_square() {
    let spellings: &[&[u8]] = &[
        b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n",
        b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf -4 -3 -2 -1",
        b"\xEF\xBB\xBFv 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\nv 0 1 0\r\nf 1 2 3 4\r\n",
        b"v 0 0 0\rv 1 0 0\rv 1 1 0\rv 0 1 0\rf 1 2 3 4\r",
        b"v 0 0 0\nv 1 0 \\\n0\nv 1 1 0\nv 0 1 0\nf 1 2 \\\n 3 \\\r\n  4\n",
        b"  v\t0 0.0 -0\n\n\nv 1e0 0 0 1.0\nv +1 1. .0\nv 0 1 0 # a corner\n#f 9 9 9\nf   1// 2/ 3  4   # a face\n\n",
        b"# from C:\\models\\\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n",
        b"# caf\xe9 \xff\xfe\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n",
        b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nfo 1 2 3 4 \\",
    ];
    for spelling in spellings {
        let text = String::from_utf8_lossy(spelling);
        let model = read(spelling).unwrap_or_else(|error| panic!("{error} in {text}"));
        assert_eq!(model.positions, [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y], "{text}");
        assert_eq!(positions(&model), [[0, 1, 2], [0, 2, 3]], "{text}");
        assert_eq!(warnings(&model), [""; 0], "{text}");
        assert!(
            model
                .triangles
                .iter()
                .flat_map(|t| t.corners)
                .all(|corner| model.normals[corner.normal as usize] == Vec3::Z)
        );
    }
}

/// Triangles of different materials and groups, with different uvs and normals, share their positions.
#[test]
fn topology_survives() {
    let model = read(format!(
        "{SQUARE}vt 0 0\nvt 1 1\nvt 0.5 0.5 0\nvn 0 0 1\nvn 0 0 2\n\
         o one\ng left\nusemtl red\nf 1/1/1 2/2/1 3/3/1\no two\nusemtl blue\nf 1/3/2 3/1/2 4\n"
    ))
    .unwrap();
    assert_eq!(model.positions.len(), 4);
    assert_eq!(positions(&model), [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(model.triangles[0].corners.map(|corner| corner.uv), [0, 1, 2]);
    assert_eq!(model.triangles[1].corners.map(|corner| corner.uv), [2, 0, NONE]);
    assert_eq!(model.triangles[1].corners[1].normal, 1);
    assert_eq!(model.uv(model.triangles[1].corners[0]), Vec2::splat(0.5));
    assert_eq!(model.uv(model.triangles[1].corners[2]), Vec2::ZERO);
    assert_eq!(model.groups, ["", "one", "left", "two"]);
    assert_eq!(model.triangles.iter().map(|t| (t.material, t.group)).collect::<Vec<_>>(), [(1, 2), (2, 3)]);
    assert_eq!(model.materials.iter().map(|m| m.name.as_str()).collect::<Vec<_>>(), ["", "red", "blue"]);
}

/// Negative indices count from where they stand.
#[test]
fn negative_indices() {
    let model = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf -3 -2 -1\n").unwrap();
    assert_eq!(positions(&model), [[0, 1, 2], [3, 4, 5]]);
}

/// A cube as its file says: smooth, flat, or (nothing said) flat because its sides turn by 90 degrees.
#[test]
fn computed_normals() {
    let cube = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";
    let faces = "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
    for (said, flat) in [("", true), ("s off\n", true), ("s 0\n", true), ("s 1\n", false), ("s on\n", false)] {
        let model = read(format!("{cube}{said}{faces}")).unwrap();
        for triangle in &model.triangles {
            let [a, b, c] = triangle.corners.map(|corner| model.positions[corner.position as usize]);
            let face = (b - a).cross(c - a).normalize();
            for corner in triangle.corners {
                let out = (model.positions[corner.position as usize] - 0.5).normalize();
                let wanted = if flat { face } else { out };
                assert!(model.normals[corner.normal as usize].distance(wanted) < 1e-6, "{said:?} {triangle:?}");
            }
        }
        // Shared where they are the same: 3 at each of 8 corners, or 1.
        let expected = if said.contains('o') && said.contains("off") || flat { 24 } else { 8 };
        assert_eq!(model.normals.len(), expected, "{said:?}");
    }
    // Two groups part the cube in top and rest.
    let parted =
        read(format!("{cube}s 1\nf 5 6 7 8\ns 2\nf 1 4 3 2\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"))
            .unwrap();
    assert!(parted.triangles[0].corners.iter().all(|corner| parted.normals[corner.normal as usize] == Vec3::Z));
}

/// A low-poly ball without normals looks round: Max's weights are right on spheres.
#[test]
fn a_ball_is_smooth() {
    let mut text = String::new();
    let (rings, slices) = (8, 16);
    for ring in 0..=rings {
        for slice in 0..slices {
            let (a, b) = (
                ring as f64 / rings as f64 * std::f64::consts::PI,
                slice as f64 / slices as f64 * std::f64::consts::TAU,
            );
            text += &format!("v {} {} {}\n", a.sin() * b.cos(), a.cos(), a.sin() * b.sin());
        }
    }
    for ring in 0..rings {
        for slice in 0..slices {
            let at = |r: usize, s: usize| r * slices + s % slices + 1;
            text += &format!(
                "f {} {} {} {}\n",
                at(ring, slice),
                at(ring, slice + 1),
                at(ring + 1, slice + 1),
                at(ring + 1, slice)
            );
        }
    }
    let model = read(text).unwrap();
    for corner in model.triangles.iter().flat_map(|t| t.corners) {
        let position = model.positions[corner.position as usize];
        // The poles are fans of their own positions; there only the faces speak.
        if position.y.abs() < 0.95 {
            assert!(model.normals[corner.normal as usize].dot(position) > 0.98, "{position}");
        }
    }
}

/// Normals of the file are made unit vectors; those without direction are computed anew, with a word.
#[test]
fn normals_of_the_file() {
    let model = read(format!("{SQUARE}vn 0 3 4\nvn 0 0 0\nvn nan 0 0\nf 1//1 2//2 3//3\n")).unwrap();
    let normals = model.triangles[0].corners.map(|corner| model.normals[corner.normal as usize]);
    assert!(normals[0].distance(Vec3::new(0.0, 0.6, 0.8)) < 1e-6);
    assert_eq!(&normals[1..], [Vec3::Z, Vec3::Z]);
    assert_eq!(
        warnings(&model),
        ["m.obj: 2 corners have a normal that is zero or not finite, and get a computed one"]
    );
}

/// A model of which no good picture can be made is told of, and read.
#[test]
fn sizes() {
    for (size, told) in [("1e-13", true), ("1e-12", false), ("1", false), ("1e12", false), ("1e13", true)] {
        let model = read(format!("v 0 0 0\nv {size} 0 0\nv 0 {size} 0\nf 1 2 3\n")).unwrap();
        let said =
            format!("m.obj: a model {size} across is drawn with errors that show; scale it to 1e-12 to 1e12");
        assert_eq!(warnings(&model), vec![said; usize::from(told)], "{size}");
    }
}

/// Triangles that go the other way round than all of their normals say are turned, and no others.
#[test]
fn triangles_against_their_normals() {
    let read = |normals: &str, face: &str| read(format!("{SQUARE}{normals}{face}")).unwrap();
    let up = "vn 0 0 1\nvn 0 0.5 1\nvn 0 0.5 -1\n";
    let model = read(up, "f 1//1 3//2 2//1\nf 1//1 2//1 3//1\nf 1//1 4//1 3//1\n");
    assert_eq!(positions(&model), [[0, 1, 2], [0, 1, 2], [0, 2, 3]]);
    assert_eq!(model.triangles[0].corners.map(|corner| corner.normal), [0, 0, 1]);
    let said = "m.obj: 2 triangles go the other way round than their normals say, and are turned over";
    assert_eq!(warnings(&model), [said]);
    for face in ["f 1//1 3//1 2//3\n", "f 1//1 3//1 2\n", "f 1 3 2\n"] {
        let model = read(up, face);
        assert_eq!((positions(&model), warnings(&model).len()), (vec![[0, 2, 1]], 0), "{face}");
    }
    // A little beyond a right angle, as on a sliver.
    assert_eq!(warnings(&read("vn 0 1 0.15\n", "f 1//1 3//1 2//1\n")).len(), 0);
    assert_eq!(warnings(&read("vn 0 1 0.25\n", "f 1//1 3//1 2//1\n")), [said.replace("2 tri", "1 tri")]);
}

/// What is passed over is told, once, with the first line and the count.
#[test]
fn passed_over() {
    let cases = [
        ("l 1 2\nl 2 3\np 1\n", "m.obj:5: points and lines (`p`, `l`) are not drawn (3 times)"),
        ("curv 0 1 1 2\nend\n", "m.obj:5: free-form curves and surfaces are not drawn (2 times)"),
        ("call rm.obj\n", "m.obj:5: other files and commands (`call`, `csh`) are never run"),
        ("usemtl\n", "m.obj:5: `usemtl` without a name chooses the default material"),
        ("s five\n", "m.obj:5: the smoothing group `five` is not a number, and is passed over"),
        ("f 1 2\n", "m.obj:5: a face with fewer than three corners is not drawn"),
        ("f 1 1 2\nf 3 2 2\n", "m.obj:5: a triangle with two corners in one place is not drawn (2 times)"),
        ("v 1 2 3 0.5 0.5 0.5\n", "m.obj:5: colors of vertices are not used"),
        ("wobble 3\n", "m.obj:5: the statement `wobble` is not known, and is passed over"),
        ("v nan 0 0\nf 1 2 5\n", "m.obj:6: a face with a vertex that is not finite is not drawn"),
        ("v 0 nan 0\nf 1 2 5\n", "m.obj:6: a face with a vertex that is not finite is not drawn"),
        ("v 0 0 -inf\nf 1 2 5\n", "m.obj:6: a face with a vertex that is not finite is not drawn"),
        ("v 1e999 0 0\nf 1 2 3 5\n", "m.obj:6: a face with a vertex that is not finite is not drawn"),
        ("v 1.#QNAN 0 -1.#IND\nf 1 2 5\n", "m.obj:6: a face with a vertex that is not finite is not drawn"),
        ("vt inf 0\n", "m.obj: 1 texture coordinates that are not finite are taken as 0"),
        ("usemtl gold\n", "m.obj:5: material `gold` is defined in no MTL file, and is drawn light gray"),
        ("mtllib no.mtl\n", "m.obj:5: the MTL file `no.mtl` is not used: there is no such file"),
        ("mtllib\n", "m.obj:5: `mtllib` names no file"),
    ];
    for (lines, sentence) in cases {
        let model = read(format!("{SQUARE}{lines}f 1 2 3\n")).unwrap();
        assert_eq!(warnings(&model), [sentence], "{lines}");
        assert_eq!(positions(&model), [[0, 1, 2]], "{lines}");
    }
}

/// A triangle with three places in a line is kept: it closes the seam to its neighbor's long side.
#[test]
fn slivers_are_kept() {
    let model = read("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 1 1 0\nf 1 2 3\nf 1 3 4\n").unwrap();
    assert_eq!((model.triangles.len(), warnings(&model).len()), (2, 0));
}

#[test]
fn capitals() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\ng a\ns 1\nf 1/1/1 2/1/1 3/1/1\n";
    let upper = text.to_ascii_uppercase().replace('A', "a");
    assert_eq!(read(upper).unwrap(), read(text).unwrap());
}
