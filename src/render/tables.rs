//! a scene -> its tables, whose trees are kept on disk where that is wanted

use crate::prepare::bvh::{Binned, Kept};
use crate::prepare::{prepare, prepare_with};
use crate::scene::{Reach, Scene};
use crate::tables::Tables;

/// The tables, and what was wrong with the trees that were kept, a sentence each.
pub(super) fn tables(scene: &Scene, reach: &Reach) -> (Tables, Vec<String>) {
    let Some(folder) = &reach.cache else { return (prepare(scene), Vec::new()) };
    let kept = Kept::new(folder, &Binned);
    let tables = prepare_with(scene, &kept);
    (tables, kept.notes())
}
