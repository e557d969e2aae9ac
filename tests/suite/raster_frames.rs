//! Whole drawn frames: GPU against CPU in every bit.

use twinlight::cpu::shade::scale::HEATS;
use twinlight::film::compare::{Standard, compare};
use twinlight::film::pass::{Pass, Values};
use twinlight::gpu::wgsl::Sources;
use twinlight::gpu::{self, Wanted};
use twinlight::math::Vec3;
use twinlight::prepare::draw;
use twinlight::render::{Backend, Renderer, Work};
use twinlight::scene::model::{Content, Map, Texture};
use twinlight::scene::{Camera, Filter, Light, Maps, Method, Scene, Show, Specular, Triangle};
use twinlight::tables::{NONE, ONE_SIDED};

use super::{Dice, planted, random_scene, root, scene_on_cpu, scene_on_gpu, small};

/// A random scene to be drawn, with pictures on its materials.
pub(super) fn painted(number: u32) -> Scene {
    let mut dice = Dice(number, 3);
    let mut scene = random_scene(number);
    scene.method = Method::Raster;
    scene.raster.shadow_size = 128;
    scene.raster.samples = [1, 4][dice.below(2)];
    scene.raster.blur = dice.below(3) as u32;
    scene.raster.specular = [Specular::Phong, Specular::Blinn][dice.below(2)];
    scene.raster.filter = [Filter::Nearest, Filter::Bilinear, Filter::Mipmap][dice.below(3)];
    paint(&mut scene, &mut dice);
    scene
}

#[test]
fn drawn_random_scenes_are_the_same_to_the_bit() {
    for number in 0..30 {
        let scene = painted(number);
        let gpu = scene_on_gpu(&Sources::default(), &scene).expect("a film");
        let comparison = compare(&scene_on_cpu(&scene), &gpu, Standard::Exact).expect("one size");
        assert!(comparison.passes(), "random scene {number}: {comparison:#?}");
    }
}

/// Pictures of noise over some of the materials, and other cameras for some of the shadows.
fn paint(scene: &mut Scene, dice: &mut Dice) {
    let mut texture = |content| {
        let [width, height] = [1, 1].map(|least| least + dice.below(20) as u32);
        let texels = (0..width * height).map(|_| dice.bits().to_le_bytes()).collect();
        Texture { file: String::new(), content, width, height, texels, has_alpha: true }
    };
    scene.textures = [Content::Color, Content::Normal, Content::Color].map(&mut texture).into();
    for i in 0..scene.materials.len() {
        let mut map = |texture| {
            let (scale, offset) = (dice.point(3.0).truncate(), dice.point(1.0).truncate());
            let map = Map { texture, scale, offset, clamp: i == 3, strength: dice.within(0.0, 3.0) };
            (dice.below(2) == 0).then_some(map)
        };
        scene.materials[i].maps = Maps { color: map(0), normal: map(1), specular: map(2) };
    }
    for light in &mut scene.lights {
        if let Light::Directional { toward, camera, .. } = light
            && dice.below(2) == 0
        {
            let (position, fov) = (*toward * dice.within(3.0, 9.0), dice.within(0.3, 2.0));
            *camera = Some(Camera { position, look_at: dice.point(1.0), fov, far: 40.0, ..scene.camera.clone() });
        }
    }
    for plane in &mut scene.planes {
        plane.tile = dice.within(0.3, 5.0);
    }
    for triangle in &mut scene.triangles {
        triangle.uvs = [(); 3].map(|()| dice.point(2.0).truncate());
    }
}

#[test]
fn every_view_and_filter_is_the_same_to_the_bit() {
    let mut scene = small(&root().join("scenes/bust.toml"), [90, 90], 1);
    let shows = [
        Show::Color,
        Show::Depth,
        Show::Shadow,
        Show::Normal,
        Show::Uv,
        Show::Albedo,
        Show::Ambient,
        Show::Diffuse,
        Show::Specular,
        Show::Id,
        Show::Tiles,
        Show::Wire,
    ];
    let filters = [Filter::Nearest, Filter::Bilinear, Filter::Mipmap];
    for (i, show) in shows.into_iter().enumerate() {
        scene.raster.show = show;
        scene.raster.filter = filters[i % 3];
        let gpu = scene_on_gpu(&Sources::default(), &scene).expect("a film");
        let comparison = compare(&scene_on_cpu(&scene), &gpu, Standard::Exact).expect("one size");
        assert!(comparison.passes(), "{show:?}: {comparison:#?}");
    }
}

/// The grays of depths go over what is seen, from near to far, and are the same for each part of a picture.
#[test]
fn depths_are_told_apart_by_their_grays() {
    for name in ["bust", "room", "stones", "dahlia"] {
        let mut scene = small(&root().join(format!("scenes/{name}.toml")), [97, 61], 1);
        (scene.method, scene.raster.show) = (Method::Raster, Show::Depth);
        let work = || Work::new(&scene, Method::Raster).expect("there is room");
        let mut renderer = Renderer::open(Backend::Cpu, &Wanted::Best).expect("the CPU");
        let film = renderer.make(&work(), &mut |_| ()).expect("a film").film;
        let pass = renderer.layers(&work(), &film, &[Pass::Depth], &mut |_| ()).expect("a pass");
        let Values::One(depths) = &pass[0].values else { panic!("a depth is one number") };
        let mut seen: Vec<_> = (0..97 * 61)
            .filter(|&i| film.ids()[i as usize] != NONE)
            .map(|i| (depths[i as usize], film.color(i).x))
            .collect();
        seen.sort_by(|a, b| a.0.total_cmp(&b.0));
        let falls = |pair: &[(f32, f32)]| pair[0].1 >= pair[1].1 - 1e-5;
        assert!(seen.windows(2).all(falls), "{name}: something is darker than what is farther");
        assert!(seen.iter().all(|(_, gray)| (0.0999..=1.0).contains(gray)), "{name}: a gray that is none");
        let [nearest, farthest] = [seen[seen.len() / 50].1, seen[seen.len() * 49 / 50].1];
        assert!((nearest - 1.0).abs() < 0.1 && (farthest - 0.1).abs() < 0.1, "{name}: {nearest} to {farthest}");
        let part = work().crop(13..40, 7..30).expect("it lies within");
        let part = renderer.make(&part, &mut |_| ()).expect("a film").film;
        assert!((0..27 * 23).all(|i| part.color(i) == film.color((i / 27 + 7) * 97 + i % 27 + 13)), "{name}");
    }
}

/// Eq. 1.1 - 1.5 on paper: half way down the film between depths 1 and 3 lies a quarter of the way along.
#[test]
fn perspective_weights_are_the_papers() {
    use twinlight::cpu::raster::{snap::to_clip, weights::weights};
    let scene = small(&root().join("scenes/bust.toml"), [64, 64], 1);
    let mut lens = draw(&scene).eyes[0];
    lens.x = glam::Vec4::X;
    lens.y = glam::Vec4::Y;
    lens.w = -glam::Vec4::Z;
    let corners = [Vec3::new(-1.0, 0.0, -1.0), Vec3::new(3.0, 0.0, -3.0), Vec3::new(0.0, 5.0, -1.0)];
    let found = weights(&lens, corners.map(|p| to_clip(&lens, p)), glam::Vec2::new(32.0, 32.0));
    assert!((found - Vec3::new(0.75, 0.25, 0.0)).length() < 1e-6, "{found}");
}

#[test]
fn one_sided_models_are_marked() {
    let mut scene = small(&root().join("scenes/bust.toml"), [16, 16], 1);
    assert!(draw(&scene).faces.iter().all(|face| face.paint & ONE_SIDED == 0));
    scene.meshes.truncate(1);
    scene.meshes[0].one_sided = true;
    assert!(draw(&scene).faces.iter().all(|face| face.paint & ONE_SIDED != 0));
}

#[test]
fn lights_beyond_the_room_for_shadow_maps_are_told() {
    let mut scene = small(&root().join("scenes/pyramid.toml"), [31, 23], 1);
    let render = |scene: &Scene| {
        let mut renderer = Renderer::open(Backend::Cpu, &Wanted::Best).expect("the CPU");
        renderer.render(scene, Method::Raster, &mut |_| ()).expect("a film").notes
    };
    assert_eq!(render(&scene), [""; 0]);
    scene.lights = vec![Light::Point { position: Vec3::new(1.0, 3.0, 2.0), power: Vec3::ONE }; 6];
    let notes = render(&scene);
    assert!(notes.len() == 1 && notes[0].starts_with("1 light casts no shadows"), "{notes:?}");
}

/// A light's own camera sees what is shadowed; what lies outside of its frustum, before or beside it, is lit.
#[test]
fn what_a_lights_camera_does_not_see_is_lit() {
    let mut scene = small(&root().join("scenes/stones.toml"), [1, 1], 1);
    scene.spheres.clear();
    scene.raster.show = Show::Shadow;
    scene.raster.blur = 0;
    scene.camera.fov = 0.01;
    // A roof two units above the floor, twenty wide; its shadow lies right below it.
    let roof = [[-10.0, -10.0], [10.0, -10.0], [0.0, 20.0]].map(|[x, z]| Vec3::new(x, 2.0, z));
    scene.triangles = vec![Triangle { vertices: roof, material: 0, uvs: Triangle::UVS }];
    let seen = |scene: &mut Scene, x: f32| {
        scene.camera.position = Vec3::new(x, 1.0, 0.5);
        scene.camera.look_at = Vec3::new(x, 0.0, 0.0);
        scene_on_cpu(scene).color(0).x
    };
    scene.lights = vec![Light::Directional { toward: Vec3::Y, power: Vec3::ONE, camera: None }];
    let camera = Camera { aspect: None, fov: 1.0, near: 1.0, far: 100.0, ..scene.camera.clone() };
    let above = Camera { position: Vec3::new(0.0, 6.0, 0.0), look_at: Vec3::ZERO, up: Vec3::Z, ..camera };
    assert_eq!([0.0, 3.2, 3.4, 6.0, 14.0].map(|x| seen(&mut scene, x)), [0.0, 0.0, 0.0, 0.0, 1.0]);
    // The floor is 6 below the eye, whose view reaches 6 tan(0.5) = 3.28 to each side.
    scene.lights = vec![Light::Directional { toward: Vec3::Y, power: Vec3::ONE, camera: Some(above.clone()) }];
    assert_eq!([0.0, 3.2, 3.4, 6.0, 14.0].map(|x| seen(&mut scene, x)), [0.0, 0.0, 1.0, 1.0, 1.0]);
    // A roof before the near plane casts nothing.
    let late = Camera { near: 4.5, ..above };
    scene.lights = vec![Light::Directional { toward: Vec3::Y, power: Vec3::ONE, camera: Some(late) }];
    assert_eq!(seen(&mut scene, 0.0), 1.0);
}

/// Faults planted in the kernels that color pixels are seen by the comparison above.
#[test]
fn planted_faults_in_shading_are_seen() {
    let faults = [
        ("shade/texture", "level.height - 1 -", "level.height + 1 -"),
        ("shade/texture", "-step, x >= size", "-step, x > size"),
        ("shade/texture", "select(size, 1, clamped)", "size"),
        ("shade/texture", "x - floor(x), select(", "x - floor(x), 1.0 - select("),
        ("shade/texture", "detail - floor(detail)", "detail - floor(detail) * 0.999"),
        ("shade/texture", "+ map.shift", "- map.shift"),
        ("raster/weights", "1.0 - at.y", "0.999 - at.y"),
        ("raster/shadow", "row + j", "row"),
        ("raster/shadow", "way.y < 0.0", "way.y > 0.0"),
        ("shade/look", "select(1.0, -1.0, turn < 0.0)", "1.0"),
        ("shade/look", "vec2f(paint.bump), v", "vec2f(1.0), v"),
        ("shade/look", "scale < vec2f(0.0)", "scale < vec2f(-9.0)"),
        ("shade/look", "paint.specular_map, u", "paint.diffuse_map, u"),
        ("raster/shade", "n = -n", "n = n"),
    ];
    let scenes: Vec<_> = (0..12).map(painted).collect();
    let wanted: Vec<_> = scenes.iter().map(scene_on_cpu).collect();
    planted(&faults, &scenes, &wanted, |sources, thing| Some(scene_on_gpu(sources, thing).expect("a film")));
}

/// Runs of pixels that are lost, doubled or taken for others are noticed before anybody compares, or by the comparison.
#[test]
fn planted_faults_in_runs_are_seen() {
    let faults = [
        ("raster/sift", "image[2u * i] != 0u", "image[2u * i] == 7u"),
        ("raster/sift", "runs[atomicAdd(&tally.shown, 1u)] = run", "runs[atomicAdd(&tally.shown, 1u)] = 0u"),
        ("raster/sift", "run * GROUP < pixels", "run * GROUP < pixels - GROUP"),
        ("raster/ground", "arrayLength(&runs) - 1u - number", "arrayLength(&runs) - 1u"),
        ("raster/call", "fold(atomicLoad(&tally.bare))", "vec4u(1u, 1u, 1u, 0u)"),
    ];
    let scenes: Vec<_> = (0..8).map(painted).collect();
    let wanted: Vec<_> = scenes.iter().map(scene_on_cpu).collect();
    for (file, right, wrong) in faults {
        let text = Sources::default().get(file).expect("the file").into_owned();
        assert!(text.contains(right), "{file} has no {right}");
        let sources = Sources::default().with(file, text.replace(right, wrong));
        let seen = scenes.iter().zip(&wanted).any(|(scene, wanted)| {
            let film = scene_on_gpu(&sources, scene);
            !film.is_ok_and(|film| compare(wanted, &film, Standard::Exact).expect("one size").passes())
        });
        assert!(seen, "nobody sees {wrong} in {file}");
    }
}

/// One face over all of the film, and small ones in one of its tiles.
#[test]
fn tiles_are_colored_by_how_many_faces_they_have() {
    let mut scene = small(&root().join("scenes/stones.toml"), [64, 64], 1);
    scene.spheres.clear();
    scene.planes.clear();
    scene.raster.show = Show::Tiles;
    let camera = Camera { position: Vec3::ZERO, look_at: Vec3::NEG_Z, ..scene.camera };
    scene.camera = Camera { fov: std::f32::consts::FRAC_PI_2, near: 0.5, ..camera };
    // At distance 1 the film reaches from -1 to 1: a pixel is 1/32.
    let face = |x: f32, y: f32, size: f32| {
        let corner = |x: f32, y: f32| Vec3::new(x / 32.0 - 1.0, 1.0 - y / 32.0, -1.0);
        let vertices = [corner(x, y), corner(x, y + size), corner(x + size, y)];
        Triangle { vertices, material: 0, uvs: Triangle::UVS }
    };
    scene.triangles = vec![face(-5.0, -5.0, 500.0)];
    scene.triangles.extend([1.0, 3.0, 5.0].map(|step| face(20.0 + step, 36.0, 1.5)));
    // Over the corner of four tiles.
    scene.triangles.push(face(46.0, 46.0, 4.0));
    let film = scene_on_cpu(&scene);
    assert!(film == scene_on_gpu(&Sources::default(), &scene).expect("a film"));
    for pixel in 0..film.pixels() {
        let tile = [pixel % 64 / 16, pixel / 64 / 16];
        let faces: u32 = match tile {
            [1, 2] => 4,
            [2 | 3, 2 | 3] => 2,
            _ => 1,
        };
        let wanted = HEATS[32 - faces.leading_zeros() as usize];
        assert_eq!(film.color(pixel).to_array(), wanted, "{tile:?}");
    }
}

#[test]
fn more_lights_than_a_dispatch_asks_are_an_error() {
    let mut scene = painted(1);
    scene.lights = vec![Light::Directional { toward: Vec3::Y, power: Vec3::splat(1e-4), camera: None }; 16_384];
    let gpu = scene_on_gpu(&Sources::default(), &scene).expect("as many as there may be");
    assert!(compare(&scene_on_cpu(&scene), &gpu, Standard::Exact).expect("one size").passes());
    scene.lights.push(scene.lights[0].clone());
    let error = scene_on_gpu(&Sources::default(), &scene).expect_err("one too many");
    assert!(matches!(error, gpu::Error::Lights { lights: 16_385, most: 16_384 }), "{error}");
}
