//! A frame in parts, and one that is stopped and taken up again, have the bits of one that was made at once.

use std::collections::HashMap;
use std::ops::ControlFlow;

use twinlight::cpu::trace::CpuTrace;
use twinlight::film::{Film, Run, Watch};
use twinlight::gpu::GpuTrace;
use twinlight::gpu::wgsl::Sources;
use twinlight::tables::Tables;
use twinlight::trace::{BLOCK, Part, Trace, frame, part};

use super::{Sliced, gpu, on_cpu, root, small, tables_of};

/// Enough samples for three blocks, the last of them short.
const SAMPLES: u32 = 2 * BLOCK + 5;

fn tables(scene: &str, few: bool) -> Tables {
    let mut tables = tables_of(&small(&root().join(scene), [23, 11], SAMPLES));
    tables.few &= few;
    tables
}

fn blocks() -> Vec<Part> {
    let starts = (0..SAMPLES).step_by(BLOCK as usize);
    starts.map(|start| Part { columns: 0..23, rows: 0..11, samples: start..SAMPLES.min(start + BLOCK) }).collect()
}

/// The film whose samples are those of all films, added in their order.
fn added(films: &[Film]) -> Film {
    let mut run = Run::new(0..films[0].pixels(), 0);
    for film in films {
        run.add(run.samples.end + film.samples(0) as u32, film.sums(), film.squares(), film.ids());
    }
    let mut film = Film::new(films[0].width(), films[0].height());
    film.put(0, &run.sums, &run.ids);
    film.put_squares(0, &run.squares);
    film
}

fn make<T: Trace>(stages: &mut T, tables: &Tables, parts: &[Part]) -> Vec<Film> {
    let films = parts.iter().map(|wanted| part(stages, tables, wanted, &mut |_| ()));
    films.map(|film| film.unwrap_or_else(|_| panic!("no film"))).collect()
}

#[test]
fn blocks_of_samples_add_up_on_both_sides() {
    let gpu = gpu();
    for (scene, few) in
        [("scenes/room.toml", true), ("scenes/room-diffuse.toml", false), ("scenes/pyramid.toml", false)]
    {
        let tables = tables(scene, few);
        let whole = on_cpu(&tables);
        let on_cpu = make(&mut CpuTrace::new(&tables), &tables, &blocks());
        let mut stages = GpuTrace::new(&gpu, &Sources::default(), &tables).expect("kernels");
        let on_gpu = make(&mut stages, &tables, &blocks());
        assert!(on_cpu == on_gpu, "{scene}: both sides make the same parts");
        assert!(added(&on_cpu) == whole, "{scene}: all parts together are the whole");
        let mut turned = on_cpu;
        turned.swap(0, 1);
        assert!(added(&turned) != whole, "{scene}: and in another order they are not, so order is seen");
    }
}

#[test]
fn rectangles_are_those_of_the_whole() {
    let tables = tables("scenes/room.toml", true);
    let whole = on_cpu(&tables);
    for middle in [1, 4, 10] {
        let rows = [0..middle, middle..11].map(|rows| Part { columns: 0..23, rows, samples: 0..SAMPLES });
        let films = make(&mut CpuTrace::new(&tables), &tables, &rows);
        let sums = [films[0].sums(), films[1].sums()].concat();
        assert!(sums == whole.sums(), "cut at {middle}");
    }
    let corner = [Part { columns: 5..9, rows: 3..10, samples: 0..SAMPLES }];
    let film = &make(&mut CpuTrace::new(&tables), &tables, &corner)[0];
    let wanted = (3..10).flat_map(|y| (5..9).map(move |x| y * 23 + x));
    assert_eq!(film.pixels(), 28);
    assert!(wanted.zip(0..).all(|(from, to)| whole.sums()[from] == film.sums()[to]), "a rectangle of it");
}

/// Stops after so many calls, and keeps what it is offered.
#[derive(Default)]
struct Keeper {
    calls: u32,
    runs: HashMap<u32, Run>,
    offered: u32,
}

impl Watch for Keeper {
    fn done(&mut self, fraction: f64) -> ControlFlow<()> {
        assert!((0.0..=1.0).contains(&fraction), "{fraction}");
        self.calls = self.calls.saturating_sub(1);
        if self.calls == 0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    fn kept(&mut self, first: u32) -> Option<Run> {
        self.runs.get(&first).cloned()
    }

    fn keep(&mut self, run: &Run) {
        self.offered += 1;
        self.runs.insert(run.pixels.start, run.clone());
    }
}

#[test]
fn a_frame_that_is_stopped_again_and_again_is_the_same() {
    let tables = tables("scenes/room.toml", false);
    let whole = on_cpu(&tables);
    let mut keeper = Keeper::default();
    let mut film = Film::new(1, 1);
    let mut tries = 0;
    while film.pixels() == 1 || (0..film.pixels()).any(|pixel| film.samples(pixel) == 0.0) {
        // Portions of another size on every try: what was kept does not mind.
        tries += 1;
        keeper.calls = 3 * BLOCK;
        let stages = CpuTrace::new(&tables);
        let mut stages = Sliced { stages, budget: u32::MAX, pixels: 40 + tries, rounds: 1 };
        let Ok(made) = frame(&mut stages, &tables, &mut keeper);
        film = made;
        assert!(tries < 100, "it gets nowhere");
    }
    assert!(tries > 3, "it was stopped only {tries} times");
    assert!(film == whole, "stopped {tries} times");
    let needed = keeper.runs.len() as u32 * 3;
    assert!(keeper.offered <= needed + tries, "{} blocks were made, {needed} are needed", keeper.offered);
    // A planted fault: one bit of what was kept shows.
    let run = keeper.runs.get_mut(&0).expect("a run");
    run.sums[7][1] = f32::from_bits(run.sums[7][1].to_bits() ^ 1);
    keeper.calls = u32::MAX;
    let Ok(film) = frame(&mut CpuTrace::new(&tables), &tables, &mut keeper);
    assert!(film != whole);
}
