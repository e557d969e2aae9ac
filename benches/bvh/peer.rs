//! Embree in a process of its own: `embree.c`

use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdout, Command, Stdio};
use std::time::Duration;

use twinlight::math::Vec3;

use crate::rays::Asked;

/// One pass over a set of rays.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pass {
    /// Seconds of the processor.
    pub(crate) took: f64,
    pub(crate) hits: usize,
    /// Of the distances.
    pub(crate) sum: f64,
}

#[derive(Debug)]
pub(crate) struct Peer {
    child: Child,
    lines: BufReader<ChildStdout>,
    /// The best of its builds.
    pub(crate) build: Duration,
}

pub(crate) fn write(name: &str, triangles: &[[Vec3; 3]], names: &[&str], sets: &[Vec<Asked>]) {
    std::fs::write(format!("target/bvh/{name}.mesh"), bytemuck::cast_slice(triangles)).expect("room on the disk");
    for (set, rays) in names.iter().zip(sets) {
        std::fs::write(format!("target/bvh/{name}.{set}"), bytemuck::cast_slice(rays)).expect("room on the disk");
    }
}

impl Peer {
    /// Builds a tree of medium quality over what was written by this name; `flags` are the scene's.
    pub(crate) fn new(name: &str, threads: usize, flags: u32, sets: &[&str]) -> Self {
        let mut child = Command::new("target/bvh/embree-rays")
            .arg(format!("target/bvh/{name}.mesh"))
            .args([threads.to_string(), "1".to_owned(), flags.to_string()])
            .args(sets.iter().map(|set| format!("target/bvh/{name}.{set}")))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap_or_else(|e| panic!("embree-rays: {e}"));
        let lines = BufReader::new(child.stdout.take().expect("its words"));
        let mut peer = Self { child, lines, build: Duration::ZERO };
        peer.build = Duration::from_secs_f64(peer.line()[0]);
        peer
    }

    fn line(&mut self) -> Vec<f64> {
        let mut line = String::new();
        self.lines.read_line(&mut line).expect("an answer");
        line.split_whitespace().map(|word| word.parse().expect("a number")).collect()
    }

    pub(crate) fn pass(&mut self, set: usize) -> Pass {
        let input = self.child.stdin.as_mut().expect("its ear");
        writeln!(input, "{set}").expect("it listens");
        let line = self.line();
        Pass { took: line[0], hits: line[1] as usize, sum: line[2] }
    }
}

impl Drop for Peer {
    fn drop(&mut self) {
        drop(self.child.stdin.take());
        let _ = self.child.wait();
    }
}
