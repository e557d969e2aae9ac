//! triangles -> how long a tree over them takes beside Embree's, in turns, on one thread and on two

use std::time::{Duration, Instant};

use rayon::ThreadPoolBuilder;
use rayon::prelude::*;
use twinlight::math::Vec3;
use twinlight::prepare::bvh::{Binned, Bounds, Builder, Kept, Tree};
use twinlight::prepare::prepare;
use twinlight::scene::Scene;
use twinlight::tables::{Leaf, TRIANGLE};

use crate::meshes::Mesh;
use crate::peer::{self, Peer};

/// What Embree has when it has built: a tree, and the triangles in its order.
fn tree(triangles: &[[Vec3; 3]], builder: &dyn Builder) -> (Tree, Vec<Leaf>) {
    let tree = builder.build(triangles.par_iter().map(|corners| Bounds::around(*corners)).collect());
    let leaf = |&id: &u32| {
        let [a, b, c] = triangles[id as usize];
        Leaf { a, id, b, material: 0, c, kind: TRIANGLE }
    };
    let leaves = tree.order.par_iter().map(leaf).collect();
    (tree, leaves)
}

fn took<T>(what: impl FnOnce() -> T) -> Duration {
    let start = Instant::now();
    let made = what();
    let took = start.elapsed();
    drop(made);
    took
}

/// Prints the best times of so many turns: of the tree with its triangles, of all the tables of the scene, and of the
/// tree when it is kept on disk.
pub(crate) fn build(name: &str, mesh: &Mesh, scene: &Scene, turns: usize) {
    peer::write(name, &mesh.triangles, &[], &[]);
    let folder = "target/bvh/trees".as_ref();
    tree(&mesh.triangles, &Kept::new(folder, &Binned));
    for threads in [1, 2] {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        let [mut alone, mut all, mut kept, mut theirs] = [Duration::MAX; 4];
        for _ in 0..turns {
            theirs = theirs.min(Peer::new(name, threads, 0, &[]).build);
            for _ in 0..5 {
                alone = alone.min(pool.install(|| took(|| tree(&mesh.triangles, &Binned))));
                let found = || tree(&mesh.triangles, &Kept::new(folder, &Binned));
                kept = kept.min(pool.install(|| took(found)));
                all = all.min(pool.install(|| took(|| prepare(scene))));
            }
        }
        let told = |what: &str, time: Duration| {
            let share = time.as_secs_f64() / theirs.as_secs_f64();
            format!("{what} {:.1} ms: {share:.2}", time.as_secs_f64() * 1e3)
        };
        println!(
            "{name:>8}    build  on {threads}: Embree {:.1} ms, {}, {}, {}",
            theirs.as_secs_f64() * 1e3,
            told("ours", alone),
            told("all tables", all),
            told("kept on disk", kept),
        );
    }
}
