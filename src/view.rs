//! What the preview knows and does, without its window: so that all of it can be tested without one.
//!
//! The window (`src/bin/twinlight/view`) turns keys and drags into calls of these, and shows what they say.

pub mod desk;
pub mod difference;
pub mod eye;
pub mod fields;
pub mod history;
pub mod inspector;
pub mod keys;
pub mod overlay;
pub mod watch;
pub mod worker;
