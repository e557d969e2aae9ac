//! files that a picture is made of -> word that one of them has changed

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Programs write a file in several steps; this long after the last one it is taken as whole.
const CALM: Duration = Duration::from_millis(150);

/// Files that matter, and the time of their last change.
#[derive(Debug, Default)]
pub struct Changes {
    files: BTreeSet<PathBuf>,
    last: Option<Instant>,
}

impl Changes {
    /// Other files matter from now on.
    pub fn about(&mut self, files: impl IntoIterator<Item = PathBuf>) {
        self.files = files.into_iter().map(|file| file.canonicalize().unwrap_or(file)).collect();
    }

    /// The folders that they lie in: an editor that saves puts a new file in the place of the old one.
    #[must_use]
    pub fn folders(&self) -> BTreeSet<&Path> {
        self.files.iter().filter_map(|file| file.parent()).collect()
    }

    /// Something has happened to these files.
    pub fn notice(&mut self, files: &[PathBuf], when: Instant) {
        if files.iter().any(|file| self.files.contains(file)) {
            self.last = Some(when);
        }
    }

    /// Whether something has changed and is whole by now; asked again, it has not.
    pub fn settled(&mut self, now: Instant) -> bool {
        let settled = self.last.is_some_and(|last| now.saturating_duration_since(last) >= CALM);
        if settled {
            self.last = None;
        }
        settled
    }

    /// Whether something has changed and may not be whole yet.
    #[must_use]
    pub fn pending(&self) -> bool {
        self.last.is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_is_told_once_and_when_it_is_whole() {
        let mut changes = Changes::default();
        changes.about([PathBuf::from("/nowhere/scene.toml")]);
        let start = Instant::now();
        changes.notice(&["/nowhere/other.toml".into()], start);
        assert!(!changes.pending(), "another file is no matter");
        changes.notice(&["/nowhere/scene.toml".into()], start);
        changes.notice(&["/nowhere/scene.toml".into()], start + CALM / 2);
        assert!(!changes.settled(start + CALM), "half written");
        assert!(changes.settled(start + CALM * 2));
        assert!(!changes.settled(start + CALM * 9));
    }
}
