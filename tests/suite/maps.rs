//! Pictures on a scene's own objects: where their texels lie, and what is said of those that cannot be read.

use glam::{Vec2, Vec3};
use twinlight::cpu::first::first;
use twinlight::cpu::raster::CpuRaster;
use twinlight::prepare::{draw, prepare};
use twinlight::raster;
use twinlight::scene::model::{Content, Map, Texture};
use twinlight::scene::{self, Error, Filter, Maps, Plane, Scene, Show, Sphere, Triangle};

use super::{root, small};

/// Red, green / blue, white.
const FOUR: [[u8; 4]; 4] = [[255, 0, 0, 255], [0, 255, 0, 255], [0, 0, 255, 255], [255, 255, 255, 255]];

/// The color of the film's only pixel, by either method, which looks along -z from `eye`.
fn seen(scene: &Scene, eye: Vec3) -> Vec3 {
    let mut scene = scene.clone();
    scene.camera.position = eye;
    scene.camera.look_at = eye - Vec3::Z;
    let drawing = draw(&scene);
    let Ok(film) = raster::frame(&mut CpuRaster::new(&drawing), &drawing, &mut |_| ());
    let traced = first(&prepare(&scene), 0..1, 0..1)[0].albedo;
    assert_eq!(film.color(0), traced, "drawn and traced, from {eye}");
    traced
}

/// One material, with the four texels as its color.
fn painted() -> Scene {
    let mut scene = small(&root().join("scenes/stones.toml"), [1, 1], 1);
    (scene.spheres, scene.planes, scene.triangles) = (Vec::new(), Vec::new(), Vec::new());
    let (file, content) = (String::new(), Content::Color);
    let texels = FOUR.into();
    scene.textures = vec![Texture { file, content, width: 2, height: 2, texels, has_alpha: false }];
    let map = Map { texture: 0, scale: Vec2::ONE, offset: Vec2::ZERO, clamp: false, strength: 1.0 };
    scene.materials.truncate(1);
    scene.materials[0].maps = Maps { color: Some(map), ..Maps::default() };
    scene.raster.show = Show::Albedo;
    scene.raster.filter = Filter::Nearest;
    scene.trace.filter = Filter::Nearest;
    scene.camera.fov = 0.01;
    scene
}

const RED: Vec3 = Vec3::X;
const GREEN: Vec3 = Vec3::Y;
const BLUE: Vec3 = Vec3::Z;
const WHITE: Vec3 = Vec3::ONE;

#[test]
fn a_plane_is_tiled_in_world_units_from_its_point() {
    let mut scene = painted();
    scene.planes = vec![Plane { point: Vec3::new(10.0, 20.0, 0.0), normal: Vec3::Z, material: 0, tile: 4.0 }];
    // Copies four units wide and high, from the point to the right and up, and on all sides.
    for [x, y] in [[0.0, 0.0], [4.0, 0.0], [-8.0, 12.0], [-12.0, -4.0]] {
        let at = |u: f32, v: f32| seen(&scene, Vec3::new(10.0 + x + u, 20.0 + y + v, 5.0));
        assert_eq!([at(1.0, 3.0), at(3.0, 3.0), at(1.0, 1.0), at(3.0, 1.0)], [RED, GREEN, BLUE, WHITE], "{x} {y}");
    }
    scene.materials[0].maps.color.as_mut().expect("a map").scale = Vec2::splat(2.0);
    assert_eq!(seen(&scene, Vec3::new(12.5, 20.5, 5.0)), BLUE, "twice as many, half as large");
}

#[test]
fn a_sphere_has_its_picture_once_around() {
    let mut scene = painted();
    scene.spheres = vec![Sphere { center: Vec3::ZERO, radius: 1.0, material: 0 }];
    // +z lies at u = 3/4, so the right half of the picture faces the eye.
    assert_eq!([seen(&scene, Vec3::new(0.1, 0.5, 5.0)), seen(&scene, Vec3::new(0.1, -0.5, 5.0))], [GREEN, WHITE]);
    // From the other side, through a sphere that is seen from within.
    scene.spheres[0].center.z = 5.0;
    assert_eq!([seen(&scene, Vec3::new(0.1, 0.5, 5.0)), seen(&scene, Vec3::new(0.1, -0.5, 5.0))], [RED, BLUE]);
}

#[test]
fn a_triangle_has_the_part_of_the_picture_that_its_corners_name() {
    let mut scene = painted();
    let vertices = [Vec3::ZERO, Vec3::new(4.0, 0.0, 0.0), Vec3::new(0.0, 4.0, 0.0)];
    scene.triangles = vec![Triangle { vertices, material: 0, uvs: Triangle::UVS }];
    let at = |scene: &Scene| [[0.5, 2.5], [0.5, 0.5], [2.5, 0.5]].map(|[x, y]| seen(scene, Vec3::new(x, y, 5.0)));
    assert_eq!(at(&scene), [RED, BLUE, WHITE]);
    scene.triangles[0].uvs = [Vec2::ONE, Vec2::Y, Vec2::X];
    assert_eq!(at(&scene), [WHITE, GREEN, RED]);
}

/// A scene whose only material has these lines; the seventh line of the text is their first.
fn with(lines: &str) -> Result<Scene, Error> {
    let text =
        format!("[camera]\nposition = [0, 0, 5]\nlook_at = [0, 0, 0]\n\n[[material]]\nname = \"a\"\n{lines}\n");
    scene::parse(&text, &root().join("scenes/with.toml"))
}

#[test]
fn pictures_are_read_once_for_each_use() {
    let normal = "normal_map = \"meshes/textures/ground_normal.png\"";
    let scene = with(&format!(
        "{normal}\nbump = 0.5\nrepeat = [2, 3]\ncolor_map = \"pictures/room.png\"\n\
         specular_map = \"./pictures/room.png\"\n[[material]]\nname = \"b\"\n{normal}\nbump = 0.5"
    ));
    let scene = scene.unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(scene.textures.len(), 3, "two uses, two names, one file read twice for two materials");
    let [a, b] = [0, 1].map(|i| scene.materials[i].maps.normal.expect("a map"));
    assert_eq!((a.texture, a.scale, a.strength), (b.texture, Vec2::new(2.0, 3.0), 0.5));
    assert_eq!(b.scale, Vec2::ONE);
}

#[test]
fn heights_become_normals_and_take_their_strength_with_them() {
    // The bust's specular map is gray.
    let scene =
        with("normal_map = \"meshes/textures/bust_specular.png\"\nbump = 2").unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(scene.textures[0].content, Content::Normal);
    assert!(scene.textures[0].texels.iter().all(|t| t[2] >= 127), "a normal points outward");
    assert_eq!(scene.materials[0].maps.normal.expect("a map").strength, 1.0);
}

#[test]
fn pictures_that_cannot_be_read_are_told_where_they_are_named() {
    let cases = [
        ("color_map = \"no.png\"", "found \"no.png\"; there is no such file; wanted the name of a file"),
        ("color_map = \"../README.md\"", "the name leads out of the scene's folder; wanted a relative name"),
        ("color_map = \"/dev/zero\"", "the name leads out of the scene's folder"),
        ("color_map = \"meshes\"", "this is not a regular file; wanted a file, not a folder"),
        ("color_map = \"room.toml\"", "it is neither a PNG nor a JPEG nor a TGA file"),
        ("normal_map = \"pictures/room.png\"", "normals are bluish and heights are gray, and this is neither"),
        ("color_map = 3", "invalid type: integer `3`"),
        ("bump = 2", "only a material with a `normal_map` has a strength of it"),
        ("repeat = [2, 2]", "only a material with a `color_map`, `normal_map` or `specular_map` repeats it"),
        ("repeat = [2, 0]", "a length is a number from 1e-6"),
    ];
    for (line, words) in cases {
        let told = with(line).map(|_| ()).expect_err(line).to_string();
        let field = format!(
            ":7:{}: material[0].{}: ",
            line.find('=').expect("=") + 3,
            line.split(' ').next().expect("a field")
        );
        assert!(told.contains(&field), "{line}: wanted {field}\n{told}");
        assert!(told.contains(words), "{line}: wanted {words:?}\n{told}");
    }
}
