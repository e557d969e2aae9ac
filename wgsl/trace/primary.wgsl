// a pixel and a sample -> the primary ray's direction
#import "tables/view.wgsl"
#import "math/fence.wgsl"
#import "math/vector.wgsl"
#import "math/whole.wgsl"

@group(0) @binding(10) var<uniform> view: View;

// Where in its pixel a sample lies, in [0, 1)^2 from the lower left corner.
fn place(sample: u32) -> vec2f {
    // Exact below 2^22 samples; lavapipe divides integers lane by lane.
    let grid = f32(max(view.grid, 1u));
    let row = floor((f32(sample) + 0.5) / grid);
    let on_grid = vec2f(f32(sample) - row * grid, row) / grid;
    // The R2 sequence (Roberts, 2018): multiples of 1/p and 1/p^2, p = 1.3247..., as fractions of 2^32.
    let in_sequence = vec2f(
        f32((sample * 3242174889u) >> 8u) * 5.9604645e-8,
        f32((sample * 2447445414u) >> 8u) * 5.9604645e-8,
    );
    // No branch: see FILTERING in shade/texture.
    return select(in_sequence, on_grid, view.grid > 0u);
}

// A pixel's column, and its row from the bottom.
fn corner(pixel: u32) -> vec2f {
    let row = whole(pixel, view.width);
    return vec2f(vec2u(pixel - row * view.width, view.height - 1u - row));
}

// Spec 2.2, with the film plane at distance one. `corner`: a pixel's column, and its row from the bottom.
// `zero`: see math/fence.
fn primary(corner: vec2f, sample: u32, zero: u32) -> vec3f {
    let at = place(sample);
    let x = (corner.x + at.x) / f32(view.width) - 0.5;
    let y = (corner.y + at.y) / f32(view.height) - 0.5;
    return unit(fence(view.right * x + view.up * y, zero) - view.back);
}

// A new tree: nothing is met yet and nothing waits.
fn seed(sample: u32, direction: vec3f) -> Path {
    return Path(
        view.eye, NONE, direction, FAR, vec3f(1.0), 1u, vec3f(0.0), view.inside, SEEK, sample, NONE, 0u, 0u, 0u, 0u,
        NONE,
    );
}
