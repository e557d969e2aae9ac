//! Nothing in; `scenes/meshes/{bust,ground}.*` and `scenes/textures/{bust,ground}_*.png` out, under the folder
//! named on the command line (default: the current one). The same bytes on every run.
//!
//! shape -> mesh -> simplify -> unwrap -> bake -> files

#![forbid(unsafe_code)]
#![allow(unreachable_pub, clippy::pedantic, reason = "numbers of a sculpture, cast and named as sculptors do")]

mod bake;
mod ground;
mod hair;
mod head;
mod lock;
mod mesh;
mod model;
mod noise;
mod pack;
mod patina;
mod sdf;
mod shape;
mod simplify;
mod torso;
mod unwrap;

use glam::{Vec3, vec3};
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder};
use std::path::Path;

type Outcome = Result<(), Box<dyn std::error::Error>>;

const TRIANGLES: usize = 32_000;
const SIZE: usize = 2048;
/// Texels between charts.
const GUTTER: usize = 8;

fn main() -> Outcome {
    let root = std::env::args().nth(1).unwrap_or_else(|| ".".into());
    let root = Path::new(&root).join("scenes");
    std::fs::create_dir_all(root.join("meshes"))?;
    std::fs::create_dir_all(root.join("textures"))?;
    bust(&root)?;
    ground::write(&root)
}

fn bust(root: &Path) -> Outcome {
    let start = std::time::Instant::now();
    let say = |what: &str| eprintln!("{:6.1} s  {what}", start.elapsed().as_secs_f32());
    let bust = shape::Bust::new();
    let grid = mesh::Grid { low: vec3(-0.80, -0.90, -0.70), high: vec3(0.80, 1.15, 0.80), cell: 0.0070 };
    let fine = mesh::march(&grid, &|p| bust.distance(p, false));
    say(&format!("marched {} triangles", fine.faces.len()));
    let mut coarse = simplify::simplify(&fine, TRIANGLES, &worth);
    model::settle(&mut coarse);
    say(&format!("simplified to {}", coarse.faces.len()));
    let face = (vec3(0.08, 0.45, 0.5), vec3(0.2, -0.02, 1.0).normalize());
    let atlas = unwrap::unwrap(&coarse, SIZE, GUTTER, &|p| worth(p).sqrt(), &[face]);
    say(&format!("unwrapped into {} charts", atlas.charts));
    let model = model::Model::new(coarse, atlas);
    say(&model.check()?);
    let maps = bake::bake(&model, &bust, SIZE, GUTTER);
    say("baked");
    std::fs::write(root.join("meshes/bust.obj"), model.obj("bust"))?;
    std::fs::write(root.join("meshes/bust.mtl"), mtl("bust", 40.0))?;
    let colour = maps.colour.as_flattened();
    png(root, "bust_diffuse", colour, maps.size, ExtendedColorType::Rgb8)?;
    png(root, "bust_normal", maps.normal.as_flattened(), maps.size, ExtendedColorType::Rgb8)?;
    png(root, "bust_specular", &maps.shine, maps.size, ExtendedColorType::L8)?;
    say("written");
    Ok(())
}

/// How much detail a place deserves: the face most, the back and the foot least.
fn worth(p: Vec3) -> f32 {
    let face = 1.0 - (p.distance(vec3(0.07, 0.45, 0.40)) / 0.38).min(1.0);
    let low = sdf::smooth(-0.05, -0.4, p.y);
    let under = sdf::smooth(-0.845, -0.8495, p.y);
    let eyes = 1.0 - (p.distance(vec3(0.09, 0.49, 0.30)) / 0.22).min(1.0);
    (1.0 + 2.0 * face + 6.0 * eyes) * (1.0 - 0.45 * low) * (1.0 - 0.9 * under)
}

fn mtl(name: &str, shine: f32) -> String {
    format!(
        "# Made by scenes/make; do not edit.\nnewmtl {name}\nKd 1 1 1\nKs 1 1 1\nNs {shine}\n\
         map_Kd ../textures/{name}_diffuse.png\nnorm ../textures/{name}_normal.png\n"
    ) + &if name == "bust" {
        format!("map_Ks ../textures/{name}_specular.png\nmap_Ns ../textures/{name}_specular.png\n")
    } else {
        String::new()
    }
}

fn png(root: &Path, name: &str, bytes: &[u8], size: usize, kind: ExtendedColorType) -> Outcome {
    let side = u32::try_from(size)?;
    let mut smallest = Vec::new();
    // Few levels pack best as they are, many as differences; no rule beats trying.
    for filter in [FilterType::NoFilter, FilterType::Paeth] {
        let mut out = Vec::new();
        PngEncoder::new_with_quality(&mut out, CompressionType::Best, filter)
            .write_image(bytes, side, side, kind)?;
        if smallest.is_empty() || out.len() < smallest.len() {
            smallest = out;
        }
    }
    std::fs::write(root.join(format!("textures/{name}.png")), smallest)?;
    Ok(())
}
