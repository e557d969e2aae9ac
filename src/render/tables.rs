//! a scene -> its tables, whose trees are kept on disk where that is wanted

use std::sync::atomic::{AtomicBool, Ordering};

use super::Error;
use crate::prepare::bvh::{Kept, Told, Watched};
use crate::prepare::prepare_with;
use crate::scene::{Reach, Scene};
use crate::tables::Tables;

/// The tables, and what was wrong with the trees that were kept, a sentence each.
pub(super) fn tables(scene: &Scene, reach: &Reach, told: &Told<'_>) -> Result<(Tables, Vec<String>), Error> {
    let over = AtomicBool::new(false);
    let told = |share| {
        let flow = told(share);
        over.fetch_or(flow.is_break(), Ordering::Relaxed);
        flow
    };
    let builder = Watched(&told);
    let made = match &reach.cache {
        None => (prepare_with(scene, &builder), Vec::new()),
        Some(folder) => {
            let kept = Kept::new(folder, &builder);
            (prepare_with(scene, &kept), kept.notes())
        }
    };
    if over.into_inner() { Err(Error::Stopped) } else { Ok(made) }
}
