//! any bytes -> each parser: whether it takes them, and a panic where it breaks what it promises
//!
//! The tests change seeds at random (`tests/model/fuzz.rs`, `tests/suite/fuzz.rs`); libFuzzer follows coverage
//! (`tests/fuzz/run`).

use std::path::Path;

use twinlight::film::ledger::Reader;
use twinlight::film::merge::merge;
use twinlight::scene::model::texture::decode;
use twinlight::scene::model::{Budget, Limits, Model, Warnings, mtl as sheet, read_text};
use twinlight::scene::{Error, Scene, parse};

/// Little, so that what asks for more than it may is told soon.
#[must_use]
pub fn limits() -> Limits {
    Limits { line_bytes: 4096, obj_bytes: 1 << 20, texture_bytes: 4 << 20, memory: 64 << 20, ..Limits::default() }
}

/// A scene; an error of its text names the file.
///
/// # Panics
/// If an error does not.
#[must_use]
pub fn scene(bytes: &[u8]) -> Option<Scene> {
    match parse(std::str::from_utf8(bytes).ok()?, Path::new("fuzz.toml")) {
        Ok(scene) => Some(scene),
        Err(error @ Error::Text(_)) => {
            assert!(error.to_string().starts_with("fuzz.toml:"), "{error}");
            None
        }
        Err(other) => panic!("{other}"),
    }
}

/// A model.
#[must_use]
pub fn obj(bytes: &[u8]) -> bool {
    read_text(bytes, "m.obj", &limits()).is_ok_and(|model| {
        promises(&model);
        true
    })
}

/// A model's materials.
///
/// # Panics
/// If one of them has numbers that no material has.
#[must_use]
pub fn mtl(bytes: &[u8]) -> bool {
    let list = sheet::parse(bytes, "m.mtl", &limits(), &mut Warnings::default());
    for written in &list {
        assert!(written.material.diffuse.is_finite() && written.material.exponent >= 0.0);
        assert!(written.maps.iter().all(|asked| !asked.name.is_empty() && asked.scale.is_finite()));
    }
    !list.is_empty()
}

/// A picture of any kind: its first bytes say which.
///
/// # Panics
/// If it has not as many texels as its size says.
#[must_use]
pub fn picture(bytes: &[u8]) -> bool {
    let limits = limits();
    decode(bytes, "p.tga", &limits, &mut Budget::new(&limits)).is_ok_and(|picture| {
        assert_eq!(picture.texels.len(), picture.width as usize * picture.height as usize);
        true
    })
}

/// A TGA: what is none of the others.
#[must_use]
pub fn tga(bytes: &[u8]) -> bool {
    picture(bytes)
}

/// A PNG from its first chunk on.
#[must_use]
pub fn png(bytes: &[u8]) -> bool {
    picture(&[b"\x89PNG\r\n\x1a\n", bytes].concat())
}

/// A JPEG from its first segment on.
#[must_use]
pub fn jpeg(bytes: &[u8]) -> bool {
    picture(&[b"\xff\xd8", bytes].concat())
}

/// What an EXR is known by.
#[must_use]
pub fn exr(bytes: &[u8]) -> bool {
    twinlight::film::exr::stamp_in(bytes).is_some()
}

/// Runs of pixels that were kept, and the picture that they make.
///
/// # Panics
/// If a run has not as many sums as pixels.
#[must_use]
pub fn part(bytes: &[u8]) -> bool {
    let Some(mut reader) = Reader::new(bytes) else { return false };
    while let Some(run) = reader.run() {
        assert!(run.sums.len() == run.pixels.len() && run.ids.len() == run.pixels.len());
    }
    merge(vec![("a.part".to_owned(), bytes)]).is_ok()
}

/// What [`Model`] promises to whoever indexes without looking.
///
/// # Panics
/// If it is not so.
pub fn promises(model: &Model) {
    let inside = |index: u32, count: usize| (index as usize) < count;
    assert!(!model.triangles.is_empty());
    for triangle in &model.triangles {
        assert!(inside(triangle.material, model.materials.len()));
        assert!(inside(triangle.group, model.groups.len()));
        for corner in triangle.corners {
            assert!(inside(corner.position, model.positions.len()));
            assert!(inside(corner.normal, model.normals.len()));
            assert!(corner.uv == twinlight::scene::model::NONE || inside(corner.uv, model.uvs.len()));
        }
    }
    assert!(model.positions.iter().all(|position| position.is_finite()));
    assert!(model.uvs.iter().all(|uv| uv.is_finite()));
    assert!(model.normals.iter().all(|normal| (normal.length() - 1.0).abs() < 1e-6));
    for material in &model.materials {
        let colors = [material.ambient, material.diffuse, material.specular, material.emission];
        assert!(colors.iter().all(|color| color.is_finite() && color.min_element() >= 0.0));
        assert!(material.exponent.is_finite() && material.exponent >= 0.0);
        assert!((0.0..=1.0).contains(&material.opacity));
        let maps = [
            material.diffuse_map,
            material.specular_map,
            material.exponent_map,
            material.opacity_map,
            material.normal_map,
        ];
        for map in maps.into_iter().flatten() {
            assert!(inside(map.texture, model.textures.len()));
            assert!(map.scale.is_finite() && map.offset.is_finite() && map.strength.is_finite());
        }
    }
    for texture in &model.textures {
        assert_eq!(texture.texels.len(), texture.width as usize * texture.height as usize);
        assert!(!texture.texels.is_empty());
    }
    assert!(model.warnings.len() <= twinlight::scene::model::Warnings::MOST);
}
