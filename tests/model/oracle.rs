//! tobj 4.0.5 as the second opinion, on generated files that it reads well.

use twinlight::scene::model::NONE;

use crate::fuzz::Random;
use crate::scratch::read;

/// A random well-formed file: convex polygons, all kinds of corners, indices from both ends.
fn generate(random: &mut Random) -> String {
    let mut text = String::new();
    let (has_uvs, has_normals) = (random.below(2) == 0, random.below(2) == 0);
    let (mut vertices, mut uvs, mut normals) = (0, 0, 0);
    for _ in 0..1 + random.below(20) {
        match random.below(6) {
            0 => text += &format!("usemtl m{}\n", random.below(4)),
            1 => text += &format!("g part {}\n", random.below(4)),
            2 => text += "# a comment\n\n",
            _ => {}
        }
        // A regular polygon in a random place is convex, and tobj's fan is right.
        let corners = 3 + random.below(4);
        let (at, size) = (random.below(1000) as f64 / 7.0 - 50.0, 1.0 + random.below(100) as f64);
        for corner in 0..corners {
            let angle = corner as f64 / corners as f64 * std::f64::consts::TAU;
            text += &format!("v {} {:.5} {:e}\n", angle.cos() * size + at, angle.sin() * size, at);
            vertices += 1;
            if has_uvs {
                text += &format!("vt {} {}\n", random.below(100) as f64 / 33.0, random.below(100) as f64 / 99.0);
                uvs += 1;
            }
            if has_normals {
                text += &format!("vn {} {} {}\n", random.below(9), random.below(9), 1 + random.below(9));
                normals += 1;
            }
        }
        text += "f";
        for corner in (0..corners).rev() {
            let from_end = random.below(2) == 0;
            let index = |count: u64| if from_end { -(corner as i64) - 1 } else { (count - corner) as i64 };
            text += &match (has_uvs, has_normals) {
                (false, false) => format!(" {}", index(vertices)),
                (true, false) => format!(" {}/{}", index(vertices), index(uvs)),
                (false, true) => format!(" {}//{}", index(vertices), index(normals)),
                (true, true) => format!(" {}/{}/{}", index(vertices), index(uvs), index(normals)),
            };
        }
        text += "\n";
    }
    text
}

#[test]
fn tobj_agrees() {
    let mut random = Random(0x5EED);
    let mut triangles = 0;
    for _ in 0..400 {
        let text = generate(&mut random);
        let ours = read(&text).unwrap_or_else(|error| panic!("{error}\n{text}"));
        let options = tobj::LoadOptions { triangulate: true, ..Default::default() };
        let (theirs, _) =
            tobj::load_obj_buf(&mut text.as_bytes(), &options, |_| Err(tobj::LoadError::OpenFileFailed)).unwrap();
        // tobj gives a model for each group and material, in the file's order; corners by their values.
        let mut corner = ours.triangles.iter().flat_map(|triangle| triangle.corners);
        for model in &theirs {
            let mesh = &model.mesh;
            for at in 0..mesh.indices.len() {
                let own = corner.next().unwrap_or_else(|| panic!("too few triangles\n{text}"));
                let three = |list: &[f32], index: u32| [0, 1, 2].map(|axis| list[index as usize * 3 + axis]);
                assert_eq!(
                    ours.positions[own.position as usize].to_array(),
                    three(&mesh.positions, mesh.indices[at]),
                    "{text}"
                );
                if mesh.texcoord_indices.is_empty() {
                    assert_eq!(own.uv, NONE);
                } else {
                    let index = mesh.texcoord_indices[at] as usize;
                    assert_eq!(
                        ours.uvs[own.uv as usize].to_array(),
                        [mesh.texcoords[index * 2], mesh.texcoords[index * 2 + 1]]
                    );
                }
                if !mesh.normal_indices.is_empty() {
                    let normal = glam::Vec3::from(three(&mesh.normals, mesh.normal_indices[at])).normalize();
                    assert!(ours.normals[own.normal as usize].distance(normal) < 1e-6);
                }
            }
        }
        assert!(corner.next().is_none(), "too many triangles\n{text}");
        triangles += ours.triangles.len();
    }
    assert!(triangles > 4000, "the generator makes too little: {triangles}");
}
