//! Whole frames beside the peer's: a sun with a shadow map of 4096 x 4096 texels, Phong with diffuse, normal and
//! specular maps, read bilinearly.

use std::path::Path;

use twinlight::gpu::wgsl::Sources;
use twinlight::gpu::{Gpu, GpuRaster, Variant};
use twinlight::prepare::draw as drawing_of;
use twinlight::raster::{Look as _, Raster as _, draw, marked};
use twinlight::scene::{Filter, Light};
use twinlight::tables::{Drawing, NO_DEPTH};

use super::full::Full;
use super::{Clock, Make, TURNS, median, scenes};

pub(crate) const SCENES: [(&str, Make); 2] = [("frame: the bust", bust), ("frame: 1 M of 2 px", sheet)];

/// The bust on its ground, under its sun alone.
fn bust(size: [u32; 2]) -> Drawing {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/bust.toml");
    let mut scene = twinlight::scene::load(&path).unwrap_or_else(|e| panic!("{e}"));
    scene.film.size = size;
    scene.lights.retain(|light| matches!(light, Light::Directional { .. }));
    scene.raster.shadow_size = 4096;
    scene.raster.samples = 1;
    scene.raster.blur = 0;
    scene.raster.filter = Filter::Bilinear;
    drawing_of(&scene)
}

/// A waving sheet that wears the bust's maps.
fn sheet(size: [u32; 2]) -> Drawing {
    let dressed = bust(size);
    let paint = dressed.faces[0].paint;
    let bare = scenes::sheets(size, [1000, 500], 1);
    scenes::lit(Drawing {
        faces: bare.faces.iter().map(|face| twinlight::tables::Face { paint, ..*face }).collect(),
        vertices: bare.vertices,
        eyes: bare.eyes,
        ..dressed
    })
}

/// Both ways in turns, and how many pixels have the same color.
pub(crate) fn whole(gpu: &Gpu, name: &str, drawing: &Drawing, by_stage: bool, clock: Clock) {
    let (sun, eye) = (&drawing.lenses[0], &drawing.eyes[0]);
    let peer = Full::new(gpu, drawing);
    let best = Variant::of(gpu);
    let mut variants =
        vec![("", best), (", 32 bits", Variant { wide: false, ..best }), (", portable", Variant::PORTABLE)];
    variants.dedup_by_key(|(_, variant)| *variant);
    for (way, variant) in variants {
        let sources = Sources::default();
        let mut ours = GpuRaster::of(gpu, &sources, drawing, variant).unwrap_or_else(|e| panic!("{name}: {e}"));
        let mut shadows = ours.image(drawing.shadow_words(), false).expect("an image");
        let mut image = ours.image(eye.pixels() as usize, true).expect("an image");
        let mut times = [Vec::new(), Vec::new()];
        for turn in 0..=TURNS {
            let start = clock();
            peer.draw();
            let theirs = clock() - start;
            let start = clock();
            ours.clear(&mut shadows).expect("clear");
            draw(&mut ours, sun, &mut shadows).expect("shadows");
            let lit = clock() - start;
            ours.clear(&mut image).expect("clear");
            draw(&mut ours, eye, &mut image).expect("a drawing");
            marked(&mut ours, eye, &mut image).expect("mark");
            ours.told().expect("marks");
            let seen = clock() - start;
            ours.sift(eye, &image).expect("sift");
            ours.shade(eye, &image, &shadows).expect("shade");
            ours.ground(eye).expect("ground");
            let took = clock() - start;
            if turn > 0 {
                times[0].push(theirs);
                times[1].push(took);
            }
            if by_stage && turn == TURNS {
                let [lit, seen, took] = [lit, seen, took].map(|at| at * 1e3);
                println!("    shadows {lit:.1} ms, eye {:.1} ms, shade {:.1} ms", seen - lit, took - seen);
            }
        }
        let ids = ours.seen(&image).expect("ids");
        let sums: Vec<[f32; 4]> = ours.sums().expect("colors");
        let colors = peer.colors();
        let alike = sums.iter().zip(&colors).filter(|(ours, theirs)| {
            ours[..3].iter().zip(&theirs[..3]).all(|(o, t)| (o / ours[3] - t).abs() < 0.02)
        });
        let alike = alike.count() as f64 / sums.len() as f64;
        let drawn = ids.0.iter().filter(|depth| **depth != NO_DEPTH).count() as f64 / sums.len() as f64;
        let [theirs, took] = times.map(median);
        println!(
            "{:<40} {theirs:8.2} ms  {took:8.2} ms   {:5.2} x   {:8.4} % (of {:.0} % drawn)",
            [name, way].concat(),
            theirs / took,
            alike * 100.0,
            drawn * 100.0
        );
    }
}
