//! a picture's name -> the right to make it, which one process has at a time

use std::fs::{File, OpenOptions, TryLockError};
use std::path::{Path, PathBuf};

/// The right to make a picture: a lock on a file beside it, in which runs of pixels are kept for a later try. The system takes the lock back when its holder ends,
/// however it ends, so a claim never outlives a process that was killed.
#[derive(Debug)]
pub(crate) struct Claim {
    /// Holds the lock, and what is kept of the picture until it is whole.
    file: File,
    path: PathBuf,
    done: bool,
}

impl Claim {
    /// The claim, or nothing if another process has it.
    pub(crate) fn take(picture: &Path) -> std::io::Result<Option<Self>> {
        let path = beside(picture);
        let file = OpenOptions::new().read(true).append(true).create(true).open(&path)?;
        match file.try_lock() {
            Err(TryLockError::WouldBlock) => Ok(None),
            // Some file systems have no locks: then at worst a picture is made twice, and both are the same.
            Err(TryLockError::Error(_)) | Ok(()) => Ok(Some(Self { file, path, done: false })),
        }
    }
}

impl Claim {
    /// Where runs of the picture can be kept.
    pub(crate) fn file(&self) -> std::io::Result<File> {
        self.file.try_clone()
    }

    /// The picture is whole: nothing that was kept of it is needed.
    pub(crate) fn done(mut self) {
        self.done = true;
    }
}

impl Drop for Claim {
    fn drop(&mut self) {
        // While the lock is held: whoever waits for it finds the picture, or makes it.
        if self.done || self.file.metadata().is_ok_and(|about| about.len() == 0) {
            let _ = std::fs::remove_file(&self.path);
        }
        let _ = self.file.unlock();
    }
}

fn beside(picture: &Path) -> PathBuf {
    let name = picture.file_name().unwrap_or_default().to_string_lossy();
    picture.with_file_name(format!(".{name}.kept"))
}
