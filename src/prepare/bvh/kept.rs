//! boxes -> the tree that was built over them before, on disk, or else a new one, which is kept there
//!
//! A file is known by all that its tree depends on: the boxes, and the text of what builds it. It is written whole or
//! not at all, so that processes may share a folder; and nothing in it is believed that was not checked.

use std::cell::RefCell;
use std::fs::File;
use std::io::{self, Read as _};
use std::path::{Path, PathBuf};

use bytemuck::{Pod, Zeroable};

use super::sound::is_sound;
use super::{Bounds, Builder, Tree};
use crate::film::replace;
use crate::tables::Node;

/// Builds what it does not find in a folder.
pub struct Kept<'a> {
    folder: &'a Path,
    builder: &'a dyn Builder,
    notes: RefCell<Vec<String>>,
}

/// Trees over fewer boxes are built as soon as they are read.
pub const LEAST_KEPT: usize = 1000;

/// What is on disk, and what builds it: other texts, other trees.
const BUILT_BY: [&str; 14] = [
    include_str!("../../tables/node.rs"),
    include_str!("../bvh.rs"),
    include_str!("binary.rs"),
    include_str!("binned.rs"),
    include_str!("bins.rs"),
    include_str!("collapse.rs"),
    include_str!("count.rs"),
    include_str!("grow.rs"),
    include_str!("kept.rs"),
    include_str!("pack.rs"),
    include_str!("reinsert.rs"),
    include_str!("sides.rs"),
    include_str!("split.rs"),
    include_str!("ways.rs"),
];

const MAGIC: [u8; 16] = *b"twinlight tree 1";

/// How a file begins; nodes, then the order, then a checksum of all before it follow.
#[repr(C)]
#[derive(Clone, Copy, PartialEq, Pod, Zeroable)]
struct Head {
    magic: [u8; 16],
    key: [u8; 32],
    nodes: u32,
    boxes: u32,
    deep: u32,
}

const SUM: usize = 32;

/// Why a file is not believed.
#[derive(Debug, thiserror::Error)]
enum Fault {
    #[error("{0}")]
    Read(#[from] io::Error),
    #[error("it is not a file")]
    NoFile,
    #[error("it is of another version, or of other boxes")]
    Foreign,
    #[error("it is shorter or longer than it says")]
    Length,
    #[error("some of its bits have changed")]
    Bent,
    #[error("what it says is no tree")]
    Unsound,
}

impl<'a> Kept<'a> {
    /// In a folder, which is made if it is not there.
    #[must_use]
    pub fn new(folder: &'a Path, builder: &'a dyn Builder) -> Self {
        Self { folder, builder, notes: RefCell::default() }
    }

    /// What was wrong with files and folders, a sentence each; the trees are right all the same.
    #[must_use]
    pub fn notes(self) -> Vec<String> {
        self.notes.into_inner()
    }

    fn note(&self, file: &Path, why: &str) {
        self.notes.borrow_mut().push(format!("{}: {why}", file.display()));
    }

    fn keep(&self, file: &Path, key: [u8; 32], tree: &Tree) {
        let [nodes, boxes] = [tree.nodes.len(), tree.order.len()].map(|count| count as u32);
        let head = Head { magic: MAGIC, key, nodes, boxes, deep: tree.deep };
        let mut bytes = bytemuck::bytes_of(&head).to_vec();
        bytes.extend_from_slice(bytemuck::cast_slice(&tree.nodes));
        bytes.extend_from_slice(bytemuck::cast_slice(&tree.order));
        bytes.extend_from_slice(blake3::hash(&bytes).as_bytes());
        let made = std::fs::create_dir_all(self.folder).map_err(|error| error.to_string());
        if let Err(why) = made.and_then(|()| replace(file, &bytes).map_err(|error| error.to_string())) {
            self.note(file, &format!("the tree cannot be kept: {why}"));
        }
    }
}

impl Builder for Kept<'_> {
    fn build(&self, boxes: Vec<Bounds>) -> Tree {
        if boxes.len() < LEAST_KEPT {
            return self.builder.build(boxes);
        }
        let key = key(&boxes);
        let file = self.folder.join(format!("{}.tree", blake3::Hash::from(key).to_hex()));
        match read(&file, key, &boxes) {
            Ok(Some(tree)) => return tree,
            Ok(None) => {}
            Err(fault) => self.note(&file, &format!("the kept tree is of no use: {fault}; it is built anew")),
        }
        let count = boxes.len();
        let tree = self.builder.build(boxes);
        // One that was stopped on the way lacks some.
        if tree.order.len() == count {
            self.keep(&file, key, &tree);
        }
        tree
    }
}

/// What a tree over boxes is known by.
fn key(boxes: &[Bounds]) -> [u8; 32] {
    let mut hasher = blake3::Hasher::new();
    for text in BUILT_BY {
        hasher.update(&(text.len() as u64).to_le_bytes()).update(text.as_bytes());
    }
    *hasher.update(bytemuck::cast_slice(boxes)).finalize().as_bytes()
}

/// The tree of a file; nothing if there is no file.
fn read(path: &PathBuf, key: [u8; 32], boxes: &[Bounds]) -> Result<Option<Tree>, Fault> {
    let about = match std::fs::metadata(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
        about => about?,
    };
    // A pipe of this name would be waited for.
    if !about.is_file() {
        return Err(Fault::NoFile);
    }
    let mut file = File::open(path)?;
    let mut hasher = blake3::Hasher::new();
    let mut next = |bytes: &mut [u8]| {
        file.read_exact(bytes).map_err(|error| match error.kind() {
            io::ErrorKind::UnexpectedEof => Fault::Length,
            _ => Fault::Read(error),
        })?;
        hasher.update(bytes);
        Ok::<_, Fault>(hasher.finalize())
    };
    let mut head = Head::zeroed();
    next(bytemuck::bytes_of_mut(&mut head))?;
    if head.magic != MAGIC || head.key != key {
        return Err(Fault::Foreign);
    }
    let [count, order] = [head.nodes, head.boxes].map(|count| count as usize);
    let length = size_of::<Head>() + count * size_of::<Node>() + order * size_of::<u32>() + SUM;
    // What is not there is not allocated.
    if order != boxes.len() || about.len() != length as u64 {
        return Err(Fault::Length);
    }
    let mut nodes = vec![Node::zeroed(); count];
    next(bytemuck::cast_slice_mut(&mut nodes))?;
    let mut order = vec![0; order];
    let expected = next(bytemuck::cast_slice_mut(&mut order))?;
    let mut sum = [0; SUM];
    next(&mut sum)?;
    if expected != sum {
        return Err(Fault::Bent);
    }
    let bounds = boxes.iter().fold(Bounds::NOTHING, |all, one| all.join(*one));
    let tree = Tree { nodes, order, deep: head.deep, bounds };
    if is_sound(&tree) { Ok(Some(tree)) } else { Err(Fault::Unsound) }
}
