//! bytes that come one after the other -> a file, whole or not at all

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use tempfile::TempPath;

use super::save::{Error, PREFIX, SUFFIX, folder_of};

/// A file in the making. It is written beside its target, flushed to the disk, and only then given its name: `image`'s
/// own `save` returned Ok for a truncated file on a full disk.
///
/// Clones write to the same file.
#[derive(Debug, Clone)]
pub(super) struct Whole(Arc<Mutex<Inner>>);

#[derive(Debug)]
struct Inner {
    target: PathBuf,
    /// Removed when it is dropped.
    place: Option<TempPath>,
    out: BufWriter<File>,
    sum: blake3::Hasher,
    /// The first refusal: an encoder that is dropped writes its end and tells nobody how that went.
    refused: Option<std::io::Error>,
}

/// As many links as systems follow from one name on.
const MOST_LINKS: usize = 40;

/// Where a name leads, if there is nothing yet, too: links stay, and what they lead to is replaced.
fn followed(target: &Path) -> std::io::Result<PathBuf> {
    let mut target = target.to_owned();
    for _ in 0..MOST_LINKS {
        let Ok(next) = target.read_link() else { return Ok(target) };
        target = folder_of(&target).join(next);
    }
    Err(std::io::Error::other("links lead from one to another without an end"))
}

impl Whole {
    /// Begins a file; what stands there stays until it is whole.
    pub(super) fn begin(target: &Path) -> Result<Self, Error> {
        let refused = |source| Error::Write { path: target.to_owned(), source };
        let target = &followed(target).map_err(refused)?;
        let begin = || {
            if target.is_dir() {
                return Err(std::io::Error::other("a folder has this name"));
            }
            if target.exists() && !target.is_file() {
                return Err(std::io::Error::other("a pipe or a device has this name; -o - writes to stdout"));
            }
            let mut builder = tempfile::Builder::new();
            builder.prefix(PREFIX).suffix(SUFFIX);
            #[cfg(unix)]
            {
                // As an ordinary new file would get it: what the umask leaves of this.
                use std::os::unix::fs::PermissionsExt as _;
                builder.permissions(std::fs::Permissions::from_mode(0o666));
            }
            Ok(builder.tempfile_in(folder_of(target))?.into_parts())
        };
        let (file, place) = begin().map_err(refused)?;
        Ok(Self(Arc::new(Mutex::new(Inner {
            target: target.to_owned(),
            place: Some(place),
            out: BufWriter::new(file),
            sum: blake3::Hasher::new(),
            refused: None,
        }))))
    }

    fn inner(&self) -> MutexGuard<'_, Inner> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// What to tell of an encoder's failure: what the disk has refused, if it has; else that.
    pub(super) fn failure(&self, why: String) -> Error {
        let mut inner = self.inner();
        let path = inner.target.clone();
        match inner.refused.take() {
            Some(source) => Error::Write { path, source },
            None => Error::Encode { path, why },
        }
    }

    /// Gives the file its name; what its bytes are known by.
    pub(super) fn finish(self) -> Result<blake3::Hash, Error> {
        let mut inner = self.inner();
        let finished = finish(&mut inner);
        finished.map_err(|source| Error::Write { path: inner.target.clone(), source })
    }
}

fn finish(inner: &mut Inner) -> std::io::Result<blake3::Hash> {
    if let Some(refused) = inner.refused.take() {
        return Err(refused);
    }
    inner.out.flush()?;
    inner.out.get_ref().sync_all()?;
    if let Some(place) = inner.place.take() {
        place.persist(&inner.target).map_err(|error| error.error)?;
    }
    // So that the name too survives a power cut; not every file system can be asked.
    if let Ok(folder) = File::open(folder_of(&inner.target)) {
        let _ = folder.sync_all();
    }
    Ok(inner.sum.finalize())
}

impl Write for Whole {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        let mut inner = self.inner();
        match inner.out.write(bytes) {
            Ok(count) => {
                inner.sum.update(&bytes[..count]);
                Ok(count)
            }
            Err(error) => {
                let told = std::io::Error::new(error.kind(), error.to_string());
                inner.refused.get_or_insert(error);
                Err(told)
            }
        }
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.inner().out.flush()
    }
}
