//! nothing -> words that are larger than any depth and any id

use std::sync::atomic::AtomicU32;

/// So many words.
#[must_use]
pub fn clear(words: usize) -> Vec<AtomicU32> {
    (0..words).map(|_| AtomicU32::new(u32::MAX)).collect()
}
