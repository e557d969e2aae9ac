//! Trees that are kept on disk: the same as built ones, and built anew where a file is not what it should be.

use std::cell::Cell;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use twinlight::prepare::bvh::{Binned, Bounds, Builder, Kept, LEAST_KEPT, Tree};

use super::bvh::{bust, soup};
use super::root;

/// Counts how often it builds.
#[derive(Default)]
struct Counting(Cell<usize>);

impl Builder for Counting {
    fn build(&self, boxes: Vec<Bounds>) -> Tree {
        self.0.set(self.0.get() + 1);
        Binned.build(boxes)
    }
}

fn boxes(count: usize) -> Vec<Bounds> {
    soup(21, count).iter().map(|corners| Bounds::around(*corners)).collect()
}

/// The tree, whether it was built, and what was said.
fn tree(folder: &Path, boxes: &[Bounds]) -> (Tree, bool, Vec<String>) {
    let counting = Counting::default();
    let kept = Kept::new(folder, &counting);
    let tree = kept.build(boxes.to_vec());
    let notes = kept.notes();
    (tree, counting.0.get() > 0, notes)
}

/// The one file of a folder.
fn file(folder: &Path) -> PathBuf {
    let files: Vec<_> = folder.read_dir().expect("a folder").map(|entry| entry.expect("a file").path()).collect();
    assert_eq!(files.len(), 1, "{files:?}");
    files[0].clone()
}

#[test]
fn a_tree_is_built_once_and_found_as_it_was() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path().join("made/on/the/way");
    let boxes = boxes(2000);
    let built = tree(&folder, &boxes);
    assert!(built.0 == Binned.build(boxes.clone()) && built.1 && built.2.is_empty(), "{:?}", built.2);
    let found = tree(&folder, &boxes);
    assert!(found.0 == built.0 && !found.1 && found.2.is_empty(), "{:?}", found.2);
    file(&folder);
    // The last bit of one corner makes another key, and what is quick to build is not kept.
    let mut others = boxes.clone();
    others[1999].high.x = others[1999].high.x.next_up();
    assert!(tree(&folder, &others).1);
    assert!(tree(&folder, &boxes[..LEAST_KEPT - 1]).1);
    assert_eq!(folder.read_dir().expect("a folder").count(), 2);
}

/// Bytes of a file before its nodes, those of a node, and of the checksum.
const HEAD: usize = 60;
const NODE: usize = 80;
const SUM: usize = 32;

/// What stands there instead of a kept tree is refused for this reason, and replaced.
fn refused(folder: &Path, boxes: &[Bounds], right: &Tree, bytes: &[u8], why: &str) {
    let file = file(folder);
    let whole = std::fs::read(&file).expect("a file");
    std::fs::write(&file, bytes).expect("room");
    let (found, built, notes) = tree(folder, boxes);
    assert!(built && found == *right, "{why}: it is believed");
    assert!(notes.len() == 1 && notes[0].contains(why) && notes[0].contains("built anew"), "{why}: {notes:?}");
    assert!(std::fs::read(&file).expect("a file") == whole, "{why}: it is not replaced");
}

#[test]
fn a_file_that_is_bent_cut_or_foreign_is_built_anew() {
    let folder = tempfile::tempdir().expect("a folder");
    let (folder, boxes) = (folder.path(), boxes(1500));
    let (right, ..) = tree(folder, &boxes);
    let whole = std::fs::read(file(folder)).expect("a file");
    let order = HEAD + right.nodes.len() * NODE;
    let end = whole.len();
    assert_eq!(end, order + 4 * right.order.len() + SUM);
    let regions = [
        (0, "another version"),
        (15, "another version"),
        (16, "other boxes"),
        (47, "other boxes"),
        (48, "longer than it says"),
        (52, "longer than it says"),
        (56, "bits have changed"),
        (HEAD, "bits have changed"),
        (HEAD + NODE + 17, "bits have changed"),
        (order - 1, "bits have changed"),
        (order, "bits have changed"),
        (end - SUM - 1, "bits have changed"),
        (end - SUM, "bits have changed"),
        (end - 1, "bits have changed"),
    ];
    for (at, why) in regions {
        for bit in [0, 7] {
            let mut bent = whole.clone();
            bent[at] ^= 1 << bit;
            refused(folder, &boxes, &right, &bent, why);
        }
    }
    for length in [0, 1, HEAD - 1, HEAD, HEAD + NODE, order, end - SUM, end - 1] {
        refused(folder, &boxes, &right, &whole[..length], "shorter or longer");
    }
    refused(folder, &boxes, &right, &[&whole[..], &[0]].concat(), "shorter or longer");
    refused(folder, &boxes, &right, &vec![0x55; end], "another version");
}

/// Files whose checksums are right, and that are no trees all the same.
#[test]
fn a_forged_tree_is_not_walked() {
    let folder = tempfile::tempdir().expect("a folder");
    let (folder, boxes) = (folder.path(), boxes(1500));
    let (right, ..) = tree(folder, &boxes);
    let whole = std::fs::read(file(folder)).expect("a file");
    let order = HEAD + right.nodes.len() * NODE;
    // Of the root, the last node, the order and the head.
    let [root_inner, root_held] = [HEAD + 24, HEAD + 28];
    let forgeries: [(&str, usize, &[u8]); 11] = [
        ("its own child", HEAD + 16, &[0; 4]),
        ("children beyond the end", HEAD + 16, &u32::MAX.to_le_bytes()),
        ("children of another", HEAD + 16, &2_u32.to_le_bytes()),
        ("leaves beyond the end", order - NODE + 20, &u32::MAX.to_le_bytes()),
        ("a node where there is none", root_inner, &[1]),
        ("a child that is both", root_held, &[0xff; 3]),
        ("more children than eight", root_held + 3, &[1]),
        ("a child too few", root_inner + 3, &[0x7f]),
        ("a leaf without its first", order - NODE + 28, &[0o66, 0o66]),
        ("a box that is not there", order, &u32::MAX.to_le_bytes()),
        ("another depth", 56, &[99, 0, 0, 0]),
    ];
    for (what, at, put) in forgeries {
        let mut forged = whole.clone();
        forged[at..at + put.len()].copy_from_slice(put);
        assert!(forged != whole, "{what}");
        let body = forged.len() - SUM;
        let sum = blake3::hash(&forged[..body]);
        forged[body..].copy_from_slice(sum.as_bytes());
        refused(folder, &boxes, &right, &forged, "no tree");
    }
    let mut twice = whole.clone();
    twice.copy_within(order..order + 4, order + 4);
    let body = twice.len() - SUM;
    let sum = blake3::hash(&twice[..body]);
    twice[body..].copy_from_slice(sum.as_bytes());
    refused(folder, &boxes, &right, &twice, "no tree");
}

#[test]
fn a_folder_that_takes_nothing_costs_no_tree() {
    let folder = tempfile::tempdir().expect("a folder");
    let boxes = boxes(1200);
    let right = Binned.build(boxes.clone());
    let blocked = folder.path().join("a file");
    std::fs::write(&blocked, "").expect("room");
    let (found, built, notes) = tree(&blocked.join("below"), &boxes);
    assert!(found == right && built, "{notes:?}");
    assert!(notes.iter().any(|note| note.contains("cannot be kept")), "{notes:?}");
    // A folder where the file should be.
    let (_, _, none) = tree(folder.path(), &[]);
    assert!(none.is_empty());
    let other = tempfile::tempdir().expect("a folder");
    tree(other.path(), &boxes);
    let name = file(other.path());
    std::fs::remove_file(&name).and_then(|()| std::fs::create_dir(&name)).expect("a folder in its place");
    let (found, built, notes) = tree(other.path(), &boxes);
    assert!(found == right && built && notes.len() == 2 && notes[0].contains("not a file"), "{notes:?}");
}

#[test]
fn many_at_a_time_share_a_folder() {
    let folder = tempfile::tempdir().expect("a folder");
    let boxes = boxes(3000);
    let right = Binned.build(boxes.clone());
    std::thread::scope(|scope| {
        for _ in 0..6 {
            scope.spawn(|| {
                for _ in 0..5 {
                    let (found, _, notes) = tree(folder.path(), &boxes);
                    assert!(found == right && notes.is_empty(), "{notes:?}");
                }
            });
        }
    });
    file(folder.path());
}

fn render(folder: &Path, more: &[&str]) -> (Vec<u8>, String) {
    let scene = root().join("scenes/bust.toml").display().to_string();
    let mut command = Command::new(env!("CARGO_BIN_EXE_twinlight"));
    command.current_dir(folder).args(["render", &scene, "--method", "trace", "--backend", "cpu", "--again"]);
    command.args(["--size", "31x23", "--samples", "1", "-o", "a.png"]).args(more);
    let Output { status, stderr, .. } = command.output().expect("the binary runs");
    let words = String::from_utf8_lossy(&stderr).into_owned();
    assert_eq!(status.code(), Some(0), "{words}");
    (std::fs::read(folder.join("a.png")).expect("a picture"), words)
}

#[test]
fn a_picture_has_the_same_bytes_with_kept_trees() {
    assert!(bust(1).len() > LEAST_KEPT, "the bust's tree is kept");
    let folder = tempfile::tempdir().expect("a folder");
    let trees = folder.path().join("trees");
    let (plain, _) = render(folder.path(), &[]);
    for turn in ["built", "found"] {
        let (picture, words) = render(folder.path(), &["--cache", "trees"]);
        assert!(picture == plain, "{turn}");
        assert!(!words.contains("note:"), "{turn}: {words}");
    }
    std::fs::write(file(&trees), "no tree").expect("room");
    let (picture, words) = render(folder.path(), &["--cache", "trees"]);
    assert!(picture == plain && words.contains("note:") && words.contains("built anew"), "{words}");
    let (picture, words) = render(folder.path(), &["--cache", "a.png/trees"]);
    assert!(picture == plain && words.contains("cannot be kept"), "{words}");
}
