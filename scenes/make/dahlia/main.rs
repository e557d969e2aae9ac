//! Nothing in; `scenes/dahlia.toml` and `scenes/meshes/petal.obj` out, under the folder named on the command line
//! (default: the current one): a flower of one petal that stands in many places. The same bytes on every run.

#![forbid(unsafe_code)]

use std::f32::consts::PI;
use std::fmt::Write as _;
use std::path::Path;

/// Petals, the innermost first.
const PETALS: u32 = 121;
/// Each is turned by this from the one before: no two lie above each other.
const GOLDEN: f32 = 137.50777;
/// Rings along a petal, and places around each.
const ALONG: u32 = 14;
const AROUND: u32 = 12;

fn main() -> std::io::Result<()> {
    let root = std::env::args().nth(1).unwrap_or_else(|| ".".into());
    let root = Path::new(&root).join("scenes");
    std::fs::create_dir_all(root.join("meshes"))?;
    std::fs::write(root.join("meshes/petal.obj"), petal())?;
    std::fs::write(root.join("dahlia.toml"), scene())
}

/// A closed leaf of length one that grows from the origin along y, is cupped towards z, and ends in a point.
fn petal() -> String {
    let mut text = "# A petal, made by scenes/make/dahlia.\n".to_owned();
    let mut put = |[x, y, z]: [f32; 3]| {
        let _ = writeln!(text, "v {x:.5} {y:.5} {z:.5}");
    };
    put([0.0; 3]);
    for ring in 1..ALONG {
        let t = ring as f32 / ALONG as f32;
        let width = 0.21 * (PI * t.powf(0.85)).sin().powf(0.9);
        let thick = 0.035 * (PI * t).sin().sqrt();
        for place in 0..AROUND {
            let (sin, cos) = (2.0 * PI * place as f32 / AROUND as f32).sin_cos();
            // Its sides bend up, as a boat's; its end bends down.
            let bend = 0.6 * width * cos * cos - 0.3 * t.powi(3);
            put([width * cos, t, bend + thick * sin]);
        }
    }
    put([0.0, 1.0, -0.3]);
    let ring = |ring: u32, place: u32| 2 + (ring - 1) * AROUND + place % AROUND;
    let last = 2 + (ALONG - 1) * AROUND;
    let mut face = |a: u32, b: u32, c: u32| {
        let _ = writeln!(text, "f {a} {b} {c}");
    };
    for place in 0..AROUND {
        face(1, ring(1, place + 1), ring(1, place));
        for at in 1..ALONG - 1 {
            let [a, b, c, d] = [ring(at, place), ring(at, place + 1), ring(at + 1, place + 1), ring(at + 1, place)];
            face(a, b, c);
            face(a, c, d);
        }
        face(ring(ALONG - 1, place), ring(ALONG - 1, place + 1), last);
    }
    text
}

/// The flower, a dark pond that mirrors it, and drops of glass.
fn scene() -> String {
    let mut text = HEAD.to_owned();
    for petal in 0..PETALS {
        let share = petal as f32 / (PETALS - 1) as f32;
        let turn = petal as f32 * GOLDEN % 360.0;
        // From upright in the middle to below level outside.
        let tilt = 8.0 + 88.0 * share.powf(0.7);
        let scale = 0.35 + 0.95 * share.powf(0.6);
        let (sin, cos) = turn.to_radians().sin_cos();
        let out = 0.04 + 0.2 * share;
        let [x, y, z] = [out * sin, 0.62 - 0.44 * share, out * cos];
        let material = if petal < 13 {
            "heart"
        } else if share < 0.45 {
            "inner"
        } else {
            "outer"
        };
        let _ = writeln!(
            text,
            "    {{ translate = [{x:.4}, {y:.4}, {z:.4}], rotate = [{tilt:.2}, {turn:.2}, 0], scale = {scale:.3}, \
             material = \"{material}\" }},"
        );
    }
    text + "]\n"
}

const HEAD: &str = r##"#:schema ./scene.schema.json
# A dahlia: one petal in 121 places, each turned by the golden angle from the one before, on a dark pond.
# Made by `cargo run --release --example dahlia`.

method = "trace"

[camera]
position = [0.5, 2.5, 3.0]
look_at = [0, 0.25, 0.08]
fov = 42

[film]
size = [480, 360]
background = "#31436a"

[trace]
samples = 9
depth = 5

[raster]
ambient = [0.006, 0.006, 0.01]

[[light.directional]]
toward = [-0.7, 1.0, 0.5]
color = [1.0, 0.93, 0.82]
intensity = 1.5

[[light.directional]]
toward = [0.9, 0.8, 1.0]
color = [0.62, 0.7, 1.0]
intensity = 0.7

[[material]]
name = "outer"
color = "#a0174a"
exponent = 40
reflect = 0.08

[[material]]
name = "inner"
color = "#e2603a"
exponent = 40
reflect = 0.08

[[material]]
name = "heart"
color = "#f6c945"
exponent = 30
reflect = 0.05

[[material]]
name = "drop"
color = "#ffffff"
behavior = "glass"
index = 1.33
local = 0.02
reflect = 0.15
refract = 0.95

[[material]]
name = "pond"
color = "#141c2c"
exponent = 200
reflect = 0.45

[[object.plane]]
point = [0, 0, 0]
normal = [0, 1, 0]
material = "pond"

[[object.sphere]]
center = [1.35, 0.14, 1.1]
radius = 0.14
material = "drop"

[[object.sphere]]
center = [-1.5, 0.1, 0.9]
radius = 0.1
material = "drop"

[[object.mesh]]
path = "meshes/petal.obj"
instance = [
"##;
