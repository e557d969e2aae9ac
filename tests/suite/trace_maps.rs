//! Pictures and bent normals in the ray tracer: GPU against CPU in every bit, and what a normal map may not do.

use twinlight::cpu::trace::scatter::scatter;
use twinlight::cpu::trace::surface::Surface;
use twinlight::film::compare::{Standard, compare};
use twinlight::gpu::wgsl::Sources;
use twinlight::math::{Vec2, Vec3};
use twinlight::scene::{Filter, Scene};
use twinlight::tables::{GLASS, MIRROR, Material};

use super::raster_frames::painted;
use super::{Dice, on_cpu, on_gpu, planted, root, small, tables_of};

const FILTERS: [Filter; 3] = [Filter::Nearest, Filter::Bilinear, Filter::Mipmap];

/// Everything with pictures on it, and in every fourth scene the bust, covered with a material of the scene's own.
fn traced(number: u32) -> Scene {
    let mut scene = painted(number);
    scene.trace.filter = FILTERS[number as usize % 3];
    if number.is_multiple_of(4) {
        let mut meshes = small(&root().join("scenes/bust.toml"), [8, 8], 1).meshes;
        meshes.truncate(1);
        meshes[0].scale = 3.0;
        meshes[0].material = [None, Some(0), Some(1), Some(2)][number as usize / 4 % 4];
        scene.meshes = meshes;
    }
    scene
}

#[test]
fn traced_pictures_are_the_same_to_the_bit() {
    for number in 0..24 {
        let tables = tables_of(&traced(number));
        let gpu = on_gpu(&Sources::default(), &tables).expect("a film");
        let comparison = compare(&on_cpu(&tables), &gpu, Standard::Exact).expect("one size");
        assert!(comparison.passes(), "random scene {number}: {comparison:#?}");
    }
}

#[test]
fn shipped_drawn_scenes_are_traced_the_same_to_the_bit() {
    for name in ["bust", "stones"] {
        for filter in FILTERS {
            let mut scene = small(&root().join(format!("scenes/{name}.toml")), [61, 43], 2);
            scene.trace.filter = filter;
            let tables = tables_of(&scene);
            let gpu = on_gpu(&Sources::default(), &tables).expect("a film");
            let comparison = compare(&on_cpu(&tables), &gpu, Standard::Exact).expect("one size");
            assert!(comparison.passes(), "{name}, {filter:?}: {comparison:#?}");
        }
    }
}

#[test]
fn planted_faults_in_details_are_seen() {
    let faults = [
        ("trace/detail", "view.right / f32(view.width)", "view.right / f32(view.height)"),
        ("trace/detail", "way - view.up", "way + view.up"),
        ("trace/detail", "ray.leaves != NONE ||", ""),
        ("trace/detail", "floor(uv.x - near.x + 0.5)", "0.0"),
        ("trace/detail", "-away.z", "away.z"),
        ("trace/detail", "vec3f(normal.z, 0.0, -normal.x)", "vec3f(-normal.z, 0.0, normal.x)"),
        ("trace/detail", "max(weights_at(p, normal, leaf.a, leaf.b", "max(weights_at(p, normal, leaf.b, leaf.a"),
        ("trace/instanced", "found.leaf.id - settings.spheres", "found.leaf.id - settings.planes"),
        ("trace/surface", "shading = -shading", "shading = shading"),
        ("trace/surface", "unit(material.color), size", "material.color, size"),
        ("trace/tree", "&& dot(l, surface.shading) > 0.0", ""),
        ("trace/tree", "surface.specular * terms.y", "vec3f(terms.y)"),
        ("trace/scatter", "n = surface.normal;\n    }", "n = surface.shading;\n    }"),
        ("trace/scatter", "root < 0.0 || above", "root < 0.0"),
        ("shade/look", "paint.specular_map, u", "paint.diffuse_map, u"),
        ("shade/texture", "detail - floor(detail)", "detail - floor(detail) * 0.999"),
        ("math/angle", "0.25 - turns", "0.2501 - turns"),
    ];
    let tables: Vec<_> = (0..16).map(|number| tables_of(&traced(number))).collect();
    let wanted: Vec<_> = tables.iter().map(on_cpu).collect();
    planted(&faults, &tables, &wanted, |sources, thing| Some(on_gpu(sources, thing).expect("a film")));
}

/// However a normal is bent: what is reflected in a mirror stays on its side, and what is refracted goes through.
#[test]
fn bent_normals_send_no_ray_to_the_wrong_side() {
    let mut dice = Dice(77, 0);
    let (mut through, mut bent) = (0, 0);
    for i in 0..100_000 {
        let normal = dice.direction();
        let direction = dice.direction();
        let normal = if normal.dot(direction) > 0.0 { -normal } else { normal };
        let material = Material {
            color: Vec3::ONE,
            local_weight: 0.0,
            tint: Vec3::ONE,
            reflect_weight: 0.5,
            refract_weight: 0.5,
            exponent: 1.0,
            index: dice.within(1.0, 2.5),
            behavior: [MIRROR, GLASS][i % 2],
        };
        let shading = dice.direction();
        let surface = Surface {
            point: Vec3::ZERO,
            normal,
            shading,
            material,
            specular: Vec3::ONE,
            margin: 0.0,
            back: Vec3::ZERO,
        };
        let ways = scatter(direction, (i / 2 % 2) as u32, &surface, Vec2::ZERO);
        assert!(ways.reflected.direction.dot(normal) > -1e-6, "{surface:?} {ways:?}");
        if ways.refracted.weight != Vec3::ZERO {
            assert!(ways.refracted.direction.dot(normal) < 1e-6, "{surface:?} {ways:?}");
            through += 1;
        }
        let mirror = twinlight::math::vector::mirror(-direction, shading);
        bent += u32::from((ways.reflected.direction - mirror).length() < 1e-6);
    }
    assert!(through > 20_000 && bent > 10_000, "{through} rays went through, {bent} were bent");
}
