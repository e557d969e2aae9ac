//! The two methods against each other: the same camera and the same scene, the same things seen, in the same light.

use twinlight::cpu::first::{First, first};
use twinlight::film::Film;
use twinlight::film::compare::{Measure, Standard, TOLERANCES};
use twinlight::math::Vec3;
use twinlight::prepare::{PLANE_FACES, sphere_faces};
use twinlight::scene::{Filter, Light, Method, Scene, Show, Specular};
use twinlight::tables::{CUT_OUT, NONE, ONE_SIDED, Tables};

use super::instances::crowd;
use super::raster_frames::painted;
use super::trace_lace::lace;
use super::{on_cpu, root, scene_on_cpu, small, tables_of};

/// One sample in the middle of each pixel, where the rasterizer's lies; light without ambient light and half shadows.
pub(super) fn alike(mut scene: Scene) -> Scene {
    scene.trace.samples = 1;
    scene.trace.filter = scene.raster.filter;
    scene.trace.specular = scene.raster.specular;
    scene.raster.samples = 1;
    scene.raster.shadow = 0.0;
    scene.raster.blur = 0;
    scene.raster.shadow_size = 2048;
    scene.raster.ambient = Vec3::ZERO;
    // Nothing is seen in mirrors, which the rasterizer does not draw.
    for material in &mut scene.materials {
        (material.reflect, material.refract) = (0.0, 0.0);
    }
    scene
}

/// The tables of a scene, seen through the middles of the pixels.
pub(super) fn centered(scene: &Scene) -> Tables {
    let mut tables = tables_of(scene);
    let view = &mut tables.view;
    view.back -= view.right * (0.5 / view.width as f32) + view.up * (0.5 / view.height as f32);
    tables
}

/// What a drawn face belongs to, as the ray tracer counts it: a sphere or a plane, or a triangle of its own.
pub(super) fn traced_id(scene: &Scene, id: u32) -> u32 {
    if id == NONE {
        return NONE;
    }
    let count = |n: usize| n as u32;
    let of = |mesh: &usize| count(scene.meshes[*mesh].model.triangles.len());
    let meshes: u32 = (0..scene.meshes.len()).map(|mesh| of(&mesh)).sum();
    // Traced, those that share a model come last.
    let traced_mesh = |mut rest: u32| {
        let (alone, shared) = scene.alone_and_shared();
        let order: Vec<usize> = alone.into_iter().chain(shared.concat()).collect();
        for mesh in 0..scene.meshes.len() {
            if rest < of(&mesh) {
                return order.iter().take_while(|other| **other != mesh).map(of).sum::<u32>() + rest;
            }
            rest -= of(&mesh);
        }
        rest
    };
    let [spheres, planes, triangles] = [scene.spheres.len(), scene.planes.len(), scene.triangles.len()].map(count);
    let of_spheres = sphere_faces(scene);
    // What is drawn of all spheres up to one.
    let up_to = |number: u32| of_spheres[..number as usize].iter().sum::<u32>();
    let sphere = |rest: u32| (0..spheres).take_while(|number| up_to(number + 1) <= rest).count() as u32;
    let before = [meshes, up_to(spheres), triangles, planes * PLANE_FACES];
    let mut rest = id;
    for (kind, count) in before.into_iter().enumerate() {
        if rest < count {
            return match kind {
                0 => spheres + planes + triangles + traced_mesh(rest),
                1 => sphere(rest),
                2 => spheres + planes + rest,
                _ => spheres + rest / PLANE_FACES,
            };
        }
        rest -= count;
    }
    panic!("there is no face {id}");
}

/// What was found where neither picture has an edge.
#[derive(Debug, Default)]
pub(super) struct Found {
    /// Pixels that see something, more than one off the next edge.
    pub(super) inner: u32,
    /// Those of them in which the methods see different things.
    pub(super) others: u32,
    /// Pixels in which they see the same, and the same share of the lights.
    pub(super) alike: u32,
    /// Those of them whose colors differ by more than 2/255.
    pub(super) off: u32,
}

impl Found {
    pub(super) fn agrees(&self) -> bool {
        let most = |measure| {
            let mut asked =
                TOLERANCES.iter().filter(|row| row.what == measure && row.asked.contains(&Standard::Near));
            asked.next().expect("a row of the table").most
        };
        f64::from(self.others) <= most(Measure::InnerIds)
            && f64::from(self.off) <= most(Measure::Steps) * f64::from(self.alike)
    }
}

/// Compares what was drawn, and what of it was open to the lights, with what was traced.
fn judge(scene: &Scene, color: &Film, open: &Film, traced: &Film, met: &[First]) -> Found {
    let (width, height) = (color.width() as i32, color.height() as i32);
    let ids: [Vec<u32>; 2] = [color.ids().iter().map(|id| traced_id(scene, *id)).collect(), traced.ids().to_vec()];
    let mut found = Found::default();
    for p in 0..color.pixels() {
        let (x, y) = (p as i32 % width, p as i32 / width);
        let around = (-1..=1).flat_map(|j| (-1..=1).map(move |i| (x + i, y + j)));
        let inside = around.filter(|(x, y)| (0..width).contains(x) && (0..height).contains(y));
        let around: Vec<usize> = inside.map(|(x, y)| (y * width + x) as usize).collect();
        let here = p as usize;
        // What is nearer or farther than the planes is the ray tracer's alone.
        let drawn = scene.camera.near * 1.001..scene.camera.far * 0.999;
        if ids[0][here] == NONE
            || !around.iter().all(|&q| drawn.contains(&met[q].depth))
            || ids.iter().any(|ids| around.iter().any(|&q| ids[q] != ids[here]))
        {
            continue;
        }
        found.inner += 1;
        if ids[0][here] != ids[1][here] {
            found.others += 1;
            continue;
        }
        // Shadow maps have edges of their own.
        if around.iter().any(|&q| open.color(q as u32).x != met[here].shadow || met[q].shadow != met[here].shadow) {
            continue;
        }
        found.alike += 1;
        let apart = (color.color(p) - traced.color(p)).abs().max_element();
        found.off += u32::from(apart > 2.0 / 255.0);
    }
    found
}

pub(super) fn found(scene: &Scene, tables: &Tables) -> Found {
    let drawn = |show| {
        let mut scene = scene.clone();
        (scene.method, scene.raster.show) = (Method::Raster, show);
        scene_on_cpu(&scene)
    };
    let [width, height] = scene.film.size;
    let met = first(tables, 0..width, 0..height);
    judge(scene, &drawn(Show::Color), &drawn(Show::Shadow), &on_cpu(tables), &met)
}

fn bust() -> Scene {
    let mut scene = small(&root().join("scenes/bust.toml"), [480, 480], 1);
    scene.camera.fov *= 0.6;
    scene.lights.truncate(1);
    alike(scene)
}

/// A scene of everything with pictures on it, under one light.
fn disorder(number: u32) -> Scene {
    let mut scene = painted(number);
    scene.resize([200, 150]).expect("it fits");
    let toward = Vec3::new(0.48, 0.6, 0.64);
    scene.lights = vec![Light::Directional { toward, power: Vec3::splat(0.9), camera: None }];
    // At the edges of texels of noise the last bit counts for all of their difference.
    scene.raster.filter = [Filter::Bilinear, Filter::Mipmap][number as usize % 2];
    for plane in &mut scene.planes {
        plane.tile *= 10.0;
    }
    // What is drawn of a sphere has corners.
    scene.spheres.clear();
    alike(scene)
}

#[test]
fn the_bust_looks_the_same_by_both_methods() {
    let mut scene = bust();
    for filter in [Filter::Nearest, Filter::Bilinear, Filter::Mipmap] {
        for specular in [Specular::Phong, Specular::Blinn] {
            (scene.trace.filter, scene.raster.filter) = (filter, filter);
            (scene.trace.specular, scene.raster.specular) = (specular, specular);
            let found = found(&scene, &centered(&scene));
            let enough = found.alike * 4 > found.inner * 3 && found.alike > 30_000;
            assert!(found.agrees() && enough, "{filter:?}, {specular:?}: {found:?}");
        }
    }
}

#[test]
fn scenes_in_disorder_look_the_same_by_both_methods() {
    let mut alike = 0;
    for number in 0..40 {
        let scene = disorder(number);
        let found = found(&scene, &centered(&scene));
        assert!(found.agrees(), "scene {number}: {found:?}");
        alike += found.alike;
    }
    assert!(alike > 300_000, "{alike} pixels are no test");
}

/// Holes, and faces that are not seen from their backs; light falls through the ones and not through the others.
#[test]
fn holes_and_backs_look_the_same_by_both_methods() {
    let (mut alike, mut through) = (0, 0);
    for number in 0..8 {
        let mut scene = disorder(number);
        scene.meshes = vec![lace(number, number.is_multiple_of(2))];
        let tables = centered(&scene);
        let found = found(&scene, &tables);
        assert!(found.agrees(), "scene {number}: {found:?}");
        alike += found.alike;
        let mut faults = [tables.clone(), tables.clone(), tables.clone()];
        faults[0].leaves.iter_mut().for_each(|leaf| leaf.kind &= !CUT_OUT);
        faults[1].leaves.iter_mut().for_each(|leaf| leaf.kind &= !ONE_SIDED);
        faults[2].paints.iter_mut().for_each(|paint| paint.opacity_map.shift += 0.3);
        through += faults.iter().filter(|tables| !self::found(&scene, tables).agrees()).count();
    }
    assert!(alike > 40_000, "{alike} pixels are no test");
    assert!(through >= 12, "only {through} of 20 planted faults are seen");
}

/// Models that are in the tree once and stand in many places.
#[test]
fn instances_look_the_same_by_both_methods() {
    let mut alike = 0;
    for number in 0..6 {
        let mut scene = disorder(number);
        scene.meshes = crowd(number, 9);
        let tables = centered(&scene);
        assert!(tables.instances.len() >= 8, "scene {number}");
        let found = found(&scene, &tables);
        assert!(found.agrees(), "scene {number}: {found:?}");
        alike += found.alike;
        let mut faults = [tables.clone(), tables.clone(), tables.clone()];
        faults[0].instances.iter_mut().for_each(|of| of.origin.x += 0.3);
        faults[1].instances.iter_mut().for_each(|of| of.id += 1);
        faults[2].instances.iter_mut().for_each(|of| std::mem::swap(&mut of.x, &mut of.z));
        for (i, tables) in faults.iter().enumerate() {
            assert!(!self::found(&scene, tables).agrees(), "scene {number}: nobody sees fault {i}");
        }
    }
    assert!(alike > 30_000, "{alike} pixels are no test");
}

/// A smooth sphere, of which the rasterizer draws 96 x 48 squares.
#[test]
fn a_sphere_looks_the_same_by_both_methods() {
    let mut scene = small(&root().join("scenes/stones.toml"), [200, 150], 1);
    scene.lights.truncate(1);
    scene.planes.clear();
    let scene = alike(scene);
    let found = found(&scene, &centered(&scene));
    assert!(found.agrees() && found.alike > 3000, "{found:?}");
}

#[test]
fn planted_disagreements_are_seen() {
    let scene = bust();
    let faults: [fn(&mut Tables); 8] = [
        |t| t.view.back += t.view.right * (0.5 / t.view.width as f32),
        |t| t.vertices.iter_mut().for_each(|v| v.normal = (v.normal + Vec3::X * 0.05).normalize()),
        |t| t.paints.iter_mut().for_each(|p| p.bump *= 1.2),
        |t| t.paints.iter_mut().for_each(|p| p.exponent *= 3.0),
        |t| t.paints.iter_mut().for_each(|p| p.specular *= 0.5),
        |t| t.paints.iter_mut().for_each(|p| p.diffuse_map.shift.x += 0.01),
        |t| t.lights[0].power *= 1.2,
        |t| t.leaves.iter_mut().for_each(|leaf| leaf.id ^= 1),
    ];
    for (i, fault) in faults.into_iter().enumerate() {
        let mut tables = centered(&scene);
        fault(&mut tables);
        let found = found(&scene, &tables);
        assert!(!found.agrees(), "nobody sees fault {i}: {found:?}");
    }
}
