//! The order in which faces stand, and by how many they are worked on at once, cannot be seen in the picture.

use twinlight::gpu::GpuRaster;
use twinlight::gpu::wgsl::Sources;
use twinlight::tables::{Drawing, NO_DEPTH, NONE};

use super::raster_exact::{on_cpu, on_gpu, random_drawing};
use super::{Dice, gpu};

/// What each face alone covers, drawn on the CPU.
fn alone(drawing: &Drawing) -> Vec<Vec<u32>> {
    let one = |face| {
        let drawing = Drawing { faces: vec![face], ..drawing.clone() };
        let (_, [depths, _]) = on_cpu(&drawing);
        depths
    };
    drawing.faces.iter().copied().map(one).collect()
}

/// Depths and ids of faces in an order, put together from what each of them alone covers.
fn together(alone: &[Vec<u32>], order: &[usize]) -> [Vec<u32>; 2] {
    let least = |pixel: usize| {
        let seen = order.iter().zip(0..).map(|(&face, id)| (alone[face][pixel], id));
        let least = seen.min().unwrap_or((NO_DEPTH, NONE));
        if least.0 == NO_DEPTH { (NO_DEPTH, NONE) } else { least }
    };
    let (depths, ids) = (0..alone[0].len()).map(least).unzip();
    [depths, ids]
}

fn shuffled(count: usize, dice: &mut Dice) -> Vec<usize> {
    let mut order: Vec<_> = (0..count).collect();
    (1..count).for_each(|i| order.swap(i, dice.below(i + 1)));
    order
}

#[test]
fn shuffled_faces_are_the_sum_of_each_alone_on_both_sides() {
    let gpu = gpu();
    let kernels = GpuRaster::new(&gpu, &Sources::default(), &random_drawing(0)).expect("kernels");
    for number in 0..300 {
        let mut dice = Dice(number, 11);
        let drawing = random_drawing(number);
        let parts = alone(&drawing);
        for _ in 0..3 {
            let order = shuffled(drawing.faces.len(), &mut dice);
            let faces = order.iter().map(|&i| drawing.faces[i]).collect();
            let drawing = Drawing { faces, ..drawing.clone() };
            let wanted = together(&parts, &order);
            assert!(on_cpu(&drawing).1 == wanted, "drawing {number} on the CPU in the order {order:?}");
            let found = on_gpu(&kernels, &drawing, 1024).expect("a drawing");
            assert!(found == wanted, "drawing {number} on the GPU in the order {order:?}");
        }
    }
}

/// The sum of another order is another one: coincident faces are there to tell.
#[test]
fn a_forgotten_shuffle_is_seen() {
    let differ = (0..300).filter(|&number| {
        let drawing = random_drawing(number);
        let order = shuffled(drawing.faces.len(), &mut Dice(number, 11));
        on_cpu(&drawing).1 != together(&alone(&drawing), &order)
    });
    assert!(differ.count() > 250);
}
