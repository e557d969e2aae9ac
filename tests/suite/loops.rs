//! lavapipe cuts loops after 65,535 turns without a word: the slices keep below, and a cut is noticed.

use twinlight::film::Run;
use twinlight::film::compare::{Standard, compare};
use twinlight::gpu::wgsl::Sources;
use twinlight::gpu::{Error, GpuTrace};
use twinlight::scene::{Plane, Scene};
use twinlight::tables::{MOST_TURNS, Slice};
use twinlight::trace::Trace as _;

use super::{Dice, gpu, on_cpu, on_gpu, root, small, tables_of};

/// More planes than a SIMD group of lavapipe can loop over at once: no tree holds them.
fn crowded() -> Scene {
    let mut scene = small(&root().join("scenes/pyramid.toml"), [9, 7], 1);
    let mut dice = Dice(1, 0);
    scene.trace.depth = 2;
    scene.planes = (0..70_000)
        .map(|_| Plane {
            point: dice.direction() * dice.within(20.0, 90.0),
            normal: dice.direction(),
            material: 1,
            tile: 1.0,
        })
        .collect();
    scene
}

#[test]
fn a_crowded_scene_is_the_same_on_both_sides() {
    let tables = tables_of(&crowded());
    let gpu = on_gpu(&Sources::default(), &tables).expect("a film");
    let comparison = compare(&on_cpu(&tables), &gpu, Standard::Exact).expect("one size");
    assert!(comparison.passes(), "{comparison:#?}");
}

#[test]
fn a_slice_that_is_too_long_is_noticed() {
    let tables = tables_of(&crowded());
    let expected = on_cpu(&tables);
    let gpu = gpu();
    let mut stages = GpuTrace::new(&gpu, &Sources::default(), &tables).expect("kernels");
    let slice = Slice { first: 0, count: expected.pixels(), samples: 1, budget: u32::MAX };
    let mut paths = stages.begin(&Run::new(0..expected.pixels(), 0), tables.samples).expect("room");
    stages.cast(&mut paths, &slice).expect("a dispatch");
    stages.follow(&mut paths, &slice).expect("a dispatch");
    stages.gather(&mut paths, &slice).expect("a dispatch");
    match stages.settle(&mut paths) {
        Err(Error::Incomplete(why)) => assert!(why.contains("cut"), "{why}"),
        Err(other) => panic!("{other}"),
        // A driver without the cut: then the long slice must have done it all.
        Ok(done) => {
            assert_eq!(done, expected.pixels(), "a cut went unnoticed");
            let film = stages.end(paths).expect("the film");
            let colors: Vec<_> = film.sums.iter().map(|s| [s[0], s[1], s[2]]).collect();
            let expected: Vec<_> = (0..expected.pixels()).map(|p| expected.color(p).to_array()).collect();
            assert_eq!(colors, expected);
        }
    }
}

#[test]
fn eight_lanes_on_eight_ways_stay_below_the_cut() {
    const { assert!(MOST_TURNS * 8 < 65_535) }
}
