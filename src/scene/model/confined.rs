//! Folder + name written in a file -> open regular file inside that folder, or the reason why not.

use std::fs::File;
use std::io;
use std::path::{Component, Path, PathBuf};

/// The folders that a scene may read from: its own, and those of `--search-path`.
///
/// Nothing else is opened, however a name is written: absolute names and `..` beyond the folder are
/// refused as text; symbolic links are followed first and then held against the folder; only regular
/// files are opened, and they are looked at before opening, since opening a FIFO would hang. (Someone
/// who can exchange files inside the folder between the look and the opening is not kept out.)
#[derive(Debug, Clone)]
pub struct Confined {
    roots: Vec<PathBuf>,
}

/// A file that may be read.
#[derive(Debug)]
pub struct Opened {
    /// At its start.
    pub file: File,
    /// Without links: the same file has the same path.
    pub path: PathBuf,
    /// Its length now.
    pub bytes: u64,
}

/// Why a file is not opened.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Refusal {
    /// No such file.
    #[error("there is no such file")]
    Missing,
    /// The name is absolute, or leads out of the folder by `..` or by a link.
    #[error("the name leads out of the scene's folder")]
    Outside,
    /// A folder, device, FIFO or socket.
    #[error("this is not a regular file")]
    NotRegular,
    /// What the system says.
    #[error("the system refuses it ({0})")]
    System(String),
}

impl Refusal {
    /// What would be right.
    #[must_use]
    pub fn remedy(&self) -> &'static str {
        match self {
            Self::Missing => "wanted the name of a file in the scene's folder",
            Self::Outside => "wanted a relative name of a file in the scene's folder or below it",
            Self::NotRegular => "wanted a file, not a folder, device or pipe",
            Self::System(_) => "wanted a file that may be read",
        }
    }
}

impl From<io::Error> for Refusal {
    fn from(error: io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::NotFound | io::ErrorKind::NotADirectory => Self::Missing,
            _ => Self::System(error.to_string()),
        }
    }
}

impl Confined {
    /// Confined to `folder` and what is below it.
    ///
    /// # Errors
    /// If there is no such folder.
    pub fn new(folder: &Path) -> Result<Self, Refusal> {
        Self { roots: Vec::new() }.and(folder)
    }

    /// The same with one more folder, which is looked through after the ones before it.
    ///
    /// # Errors
    /// If there is no such folder.
    pub fn and(mut self, folder: &Path) -> Result<Self, Refusal> {
        let root = folder.canonicalize()?;
        if !root.metadata()?.is_dir() {
            return Err(Refusal::Missing);
        }
        self.roots.push(root);
        Ok(self)
    }

    /// Confined to the folder that `file` is in, and the file's name in it.
    ///
    /// # Errors
    /// If there is no such folder, or the path has no file name.
    pub fn around(file: &Path) -> Result<(Self, PathBuf), Refusal> {
        let name = file.file_name().ok_or(Refusal::Missing)?;
        let folder = file.parent().filter(|parent| !parent.as_os_str().is_empty());
        Ok((Self::new(folder.unwrap_or(Path::new(".")))?, PathBuf::from(name)))
    }

    /// The name that `name`, written in a file of the folder `base`, has seen from the root: `/` or `\`
    /// between its parts, no `.` and no `..` left.
    ///
    /// # Errors
    /// [`Refusal::Outside`] if it is absolute or leads above the root.
    pub fn relative(base: &Path, name: &str) -> Result<PathBuf, Refusal> {
        let name = name.replace('\\', "/");
        let drive = name.as_bytes().get(1) == Some(&b':');
        // On Windows a colon also opens the second stream of a file, or a device.
        if name.starts_with('/') || drive || name.contains('\0') || (cfg!(windows) && name.contains(':')) {
            return Err(Refusal::Outside);
        }
        let mut path = base.to_path_buf();
        for part in name.split('/') {
            match part {
                "" | "." => {}
                ".." if path.pop() => {}
                ".." => return Err(Refusal::Outside),
                part => path.push(part),
            }
        }
        Ok(path)
    }

    /// Opens a path that is relative to the root, in the first folder that has it.
    ///
    /// # Errors
    /// [`Refusal`]; of several folders the first one's, unless only it lacks the file.
    pub fn open(&self, relative: &Path) -> Result<Opened, Refusal> {
        let plain = |part| matches!(part, Component::Normal(_));
        if !relative.components().all(plain) {
            return Err(Refusal::Outside);
        }
        let mut first = Refusal::Missing;
        for root in &self.roots {
            match open_inside(root, relative) {
                Ok(opened) => return Ok(opened),
                Err(why) if first == Refusal::Missing => first = why,
                Err(_) => {}
            }
        }
        Err(first)
    }

    /// The names in a folder that is given relative to the root, in all folders, sorted. At most
    /// 65,536 are looked at, since a folder may hold millions.
    pub(super) fn list(&self, relative: &Path) -> Vec<String> {
        let mut names = Vec::new();
        for root in &self.roots {
            let Ok(folder) = root.join(relative).canonicalize() else { continue };
            if !folder.starts_with(root) {
                continue;
            }
            let entries = folder.read_dir().into_iter().flatten().take(65_536).flatten();
            names.extend(entries.filter_map(|entry| entry.file_name().into_string().ok()));
        }
        // A folder's own order is chance; the choice among look-alikes must not be.
        names.sort_unstable();
        names
    }
}

fn open_inside(root: &Path, relative: &Path) -> Result<Opened, Refusal> {
    let path = root.join(relative).canonicalize()?;
    if !path.starts_with(root) {
        return Err(Refusal::Outside);
    }
    if !path.symlink_metadata()?.is_file() {
        return Err(Refusal::NotRegular);
    }
    let file = File::open(&path)?;
    let metadata = file.metadata()?;
    if !metadata.is_file() {
        return Err(Refusal::NotRegular);
    }
    Ok(Opened { file, path, bytes: metadata.len() })
}
