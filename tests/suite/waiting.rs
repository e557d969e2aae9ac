//! A tree in the making: what is told of it, and how it is stopped.

use std::ops::ControlFlow;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use twinlight::prepare::bvh::{Binned, Bounds, Builder, Tree, Watched};
use twinlight::render::{Error, Work};
use twinlight::scene::{Method, Reach};

use super::bvh::{scene_of, soup};

const COUNT: usize = 50_000;

fn boxes() -> Vec<Bounds> {
    soup(31, COUNT).iter().map(|corners| Bounds::around(*corners)).collect()
}

/// Builds on three threads.
fn build(told: &(dyn Fn(f64) -> ControlFlow<()> + Sync)) -> Tree {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build().expect("threads");
    let boxes = boxes();
    pool.install(|| Watched(told).build(boxes))
}

#[test]
fn what_is_told_of_a_tree_grows_to_all_of_it() {
    let shares = Mutex::new(Vec::new());
    let tree = build(&|share| {
        shares.lock().expect("no panic").push(share);
        ControlFlow::Continue(())
    });
    assert!(tree == Binned.build(boxes()), "who is watched builds the same");
    let mut shares = shares.into_inner().expect("no panic");
    shares.sort_by(f64::total_cmp);
    assert!(shares.len() >= 20 && shares[0] < 0.2, "{} times, from {:?} on", shares.len(), shares.first());
    assert!(shares.windows(2).all(|two| two[0] < two[1]), "each time more: {shares:?}");
    assert_eq!(shares.last(), Some(&1.0), "at last all");
}

#[test]
fn a_tree_is_stopped_on_its_way() {
    let all = AtomicUsize::new(0);
    build(&|_| {
        all.fetch_add(1, Ordering::Relaxed);
        ControlFlow::Continue(())
    });
    let told = AtomicUsize::new(0);
    let tree = build(&|_| {
        told.fetch_add(1, Ordering::Relaxed);
        ControlFlow::Break(())
    });
    // What is in hand on other threads is finished.
    let [told, all] = [told.into_inner(), all.into_inner()];
    assert!(told <= 3 && tree.order.len() < COUNT / 2, "{told} of {all}, with {} boxes", tree.order.len());
}

#[test]
fn work_that_is_stopped_leaves_nothing_behind() {
    let folder = tempfile::tempdir().expect("a folder");
    let reach = Reach { cache: Some(folder.path().to_owned()), ..Reach::default() };
    let scene = scene_of(&soup(32, 5000));
    let stopped = Work::watched(&scene, Method::Trace, &reach, &|_| ControlFlow::Break(()));
    assert!(matches!(stopped, Err(Error::Stopped)), "{stopped:?}");
    assert_eq!(folder.path().read_dir().expect("a folder").count(), 0, "half a tree is not kept");
    let told = AtomicUsize::new(0);
    let more = |_| {
        told.fetch_add(1, Ordering::Relaxed);
        ControlFlow::Continue(())
    };
    Work::watched(&scene, Method::Trace, &reach, &more).expect("work");
    assert_eq!(folder.path().read_dir().expect("a folder").count(), 1, "a whole one is");
    assert!(told.load(Ordering::Relaxed) > 0);
    let before = told.load(Ordering::Relaxed);
    Work::watched(&scene, Method::Trace, &reach, &more).expect("work");
    assert_eq!(told.load(Ordering::Relaxed), before, "what is found is not built");
}
