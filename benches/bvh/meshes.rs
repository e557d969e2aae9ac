//! the models of the bench: dragon (PLY), kitchen and sponza (OBJ), as triangles

use twinlight::math::Vec3;

/// Where the eye is, what it looks at and where the light is, in a model's own measure.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Seat {
    pub(crate) eye: Vec3,
    pub(crate) at: Vec3,
    pub(crate) light: Vec3,
}

#[derive(Debug)]
pub(crate) struct Mesh {
    pub(crate) triangles: Vec<[Vec3; 3]>,
    pub(crate) seat: Seat,
}

pub(crate) const NAMES: [&str; 3] = ["dragon", "kitchen", "sponza"];

pub(crate) fn mesh(name: &'static str) -> Mesh {
    let file = if name == "dragon" { "dragon.ply".to_owned() } else { format!("{name}.obj") };
    let text = std::fs::read(format!("target/bvh/{file}")).unwrap_or_else(|e| panic!("{file}: {e}"));
    let text = String::from_utf8_lossy(&text);
    let triangles = if name == "dragon" { ply(&text) } else { obj(&text) };
    let (low, high) = triangles
        .iter()
        .flatten()
        .fold((triangles[0][0], triangles[0][0]), |(low, high), v| (low.min(*v), high.max(*v)));
    // Shares of the model's box.
    let place = |x: f32, y: f32, z: f32| low + (high - low) * Vec3::new(x, y, z);
    let [eye, at, light] = match name {
        "dragon" => [place(0.4, 0.7, 2.9), place(0.5, 0.5, 0.5), place(1.5, 2.5, 3.0)],
        "kitchen" => [place(0.85, 0.55, 0.8), place(0.2, 0.4, 0.3), place(0.5, 0.85, 0.5)],
        _ => [place(0.15, 0.25, 0.5), place(0.9, 0.3, 0.45), place(0.5, 0.8, 0.5)],
    };
    Mesh { triangles, seat: Seat { eye, at, light } }
}

fn numbers(line: &str) -> Vec<f32> {
    line.split_whitespace().filter_map(|word| word.parse().ok()).collect()
}

fn point(line: &str) -> Vec3 {
    Vec3::from_slice(&numbers(line))
}

fn ply(text: &str) -> Vec<[Vec3; 3]> {
    let (head, body) = text.split_once("end_header\n").expect("a header");
    let count = head.lines().find_map(|line| line.strip_prefix("element vertex ")).expect("vertices");
    let count: usize = count.trim().parse().expect("a number");
    let vertices: Vec<Vec3> = body.lines().take(count).map(point).collect();
    let corners = |line: &str| {
        let n = numbers(line);
        [1, 2, 3].map(|i: usize| vertices[n[i] as usize])
    };
    body.lines().skip(count).filter(|line| !line.trim().is_empty()).map(corners).collect()
}

fn obj(text: &str) -> Vec<[Vec3; 3]> {
    let mut vertices = Vec::new();
    let mut triangles = Vec::new();
    for line in text.lines() {
        if let Some(line) = line.strip_prefix("v ") {
            vertices.push(point(line));
        } else if let Some(line) = line.strip_prefix("f ") {
            let number = |word: &str| word.split('/').next().and_then(|n| n.parse::<i64>().ok());
            let at = |n: i64| vertices[if n < 0 { vertices.len() as i64 + n } else { n - 1 } as usize];
            let corners: Vec<Vec3> = line.split_whitespace().filter_map(number).map(at).collect();
            triangles.extend((2..corners.len()).map(|i| [corners[0], corners[i - 1], corners[i]]));
        }
    }
    triangles
}
