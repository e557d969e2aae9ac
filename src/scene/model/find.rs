//! Name written in a file -> the file that is meant, also where the name is not quite right.

use std::collections::{HashMap, HashSet};
use std::io::Read as _;
use std::path::{Path, PathBuf};

use super::confined::{Confined, Opened, Refusal};
use super::lines::{before_comment, quote, unquoted};
use super::obj::Mesh;
use super::{Limits, Warnings};

/// Looks for the files that a model names.
#[derive(Debug)]
pub struct Finder<'a> {
    folder: &'a Confined,
    obj: PathBuf,
    /// Folder -> lower-case name -> name. A folder is listed once.
    listings: HashMap<PathBuf, HashMap<String, String>>,
}

/// What a name led to.
#[derive(Debug)]
pub struct Found {
    /// To be read.
    pub opened: Opened,
    /// Its path seen from the root.
    pub relative: PathBuf,
    /// A sentence, if the name as written led to nothing.
    pub note: Option<String>,
}

/// An MTL file in memory.
pub(super) struct Sheet {
    pub(super) file: String,
    pub(super) bytes: Vec<u8>,
}

impl<'a> Finder<'a> {
    /// For the OBJ file `obj`, seen from the root of `folder`.
    #[must_use]
    pub fn new(folder: &'a Confined, obj: &Path) -> Self {
        Self { folder, obj: obj.to_path_buf(), listings: HashMap::new() }
    }

    /// Opens what `name`, written in a file of the folder `base`, means. In this order: the name; the
    /// name from the OBJ file's folder; each in other capitals; the last part of the name, in both
    /// folders, since many files carry the paths of another machine; the name and its last part in the
    /// scene's folder and in those that are searched beside it; all of it for the name before a comment.
    ///
    /// # Errors
    /// Why the name itself is refused.
    pub fn find(&mut self, base: &Path, name: &str) -> Result<Found, Refusal> {
        let exact = Confined::relative(base, name);
        let why = match exact.and_then(|path| Ok((self.folder.open(&path)?, path))) {
            Ok((opened, relative)) => return Ok(Found { opened, relative, note: None }),
            Err(why @ (Refusal::NotRegular | Refusal::System(_))) => return Err(why),
            Err(why) => why,
        };
        let home = self.obj.parent().unwrap_or(Path::new("")).to_path_buf();
        let last = name.rsplit(['/', '\\']).next().unwrap_or_default();
        let root = Path::new("");
        for (folder, name) in [(base, name), (&home, name), (base, last), (&home, last), (root, name), (root, last)]
        {
            let Ok(path) = Confined::relative(folder, name) else { continue };
            for path in [Some(path.clone()), self.look_alike(&path)].into_iter().flatten() {
                if let Ok(opened) = self.folder.open(&path) {
                    let note = Some(format!("{why}; `{}` is used", path.display()));
                    return Ok(Found { opened, relative: path, note });
                }
            }
        }
        // Nothing before a comment has one.
        let before = before_comment(name).and_then(|before| self.find(base, before).ok()).ok_or(why.clone())?;
        let note = Some(format!("{why}; `{}` is used", before.relative.display()));
        Ok(Found { note, ..before })
    }

    /// The same path in the capitals that the disk has.
    fn look_alike(&mut self, path: &Path) -> Option<PathBuf> {
        let mut found = PathBuf::new();
        for part in path {
            let lower = part.to_str()?.to_lowercase();
            let listing = self.listings.entry(found.clone()).or_insert_with(|| {
                // Backward, so that of several look-alikes the first one stays.
                self.folder.list(&found).into_iter().rev().map(|name| (name.to_lowercase(), name)).collect()
            });
            found.push(listing.get(&lower)?);
        }
        Some(found)
    }

    /// Reads the MTL files that the mesh names, each once. One that cannot be read is a warning.
    pub(super) fn libraries(
        &mut self,
        mesh: &Mesh,
        obj: &str,
        limits: &Limits,
        warnings: &mut Warnings,
    ) -> Vec<Sheet> {
        let home = self.obj.parent().unwrap_or(Path::new("")).to_path_buf();
        let mut gathered =
            Gathered { obj, left: limits.mtl_bytes, seen: HashSet::new(), sheets: Vec::new(), warnings };
        for (names, line) in &mesh.libraries {
            if let Ok(found) = self.find(&home, unquoted(names)) {
                gathered.take(found, *line);
                continue;
            }
            for (count, name) in split(names).iter().enumerate() {
                if count >= limits.mtl_files {
                    gathered.warn(*line, format!("only the first {count} names of this line are used"));
                    break;
                }
                match self.find(&home, name) {
                    Ok(found) => gathered.take(found, *line),
                    Err(why) => {
                        gathered.warn(*line, format!("the MTL file {} is not used: {why}", quote(name.as_bytes())));
                    }
                }
            }
        }
        let own = self.obj.with_extension("mtl");
        // Number 0 is the default material: only a file that names another one misses something.
        if gathered.sheets.is_empty()
            && mesh.materials.len() > 1
            && let Some(name) = own.file_name().and_then(|name| name.to_str())
            && let Ok(mut found) = self.find(&home, name)
        {
            found.note = Some(format!("none was found by name; `{}` is used", found.relative.display()));
            gathered.take(found, 0);
        }
        gathered.sheets
    }
}

/// The MTL files so far.
struct Gathered<'a> {
    obj: &'a str,
    /// Bytes that may still be read.
    left: u64,
    seen: HashSet<PathBuf>,
    sheets: Vec<Sheet>,
    warnings: &'a mut Warnings,
}

impl Gathered<'_> {
    fn take(&mut self, found: Found, line: u64) {
        if let Some(note) = found.note {
            self.warn(line, format!("the MTL file: {note}"));
        }
        if !self.seen.insert(found.opened.path.clone()) {
            return;
        }
        match read(found.opened, self.left) {
            Ok(bytes) => {
                self.left -= bytes.len() as u64;
                self.sheets.push(Sheet { file: found.relative.display().to_string(), bytes });
            }
            Err(why) => self.warn(line, format!("the MTL file is not used: {why}")),
        }
    }

    fn warn(&mut self, line: u64, text: String) {
        self.warnings.add(self.obj, line, text);
    }
}

/// All bytes of a file, if they are at most `most`.
pub(in crate::scene) fn read(opened: Opened, most: u64) -> Result<Vec<u8>, String> {
    let too_large = || format!("it is larger than the {most} bytes that are left for it");
    if opened.bytes > most {
        return Err(too_large());
    }
    let mut bytes = Vec::new();
    bytes.try_reserve(opened.bytes as usize).map_err(|error| error.to_string())?;
    // One more than allowed, so that a file that grows meanwhile is noticed.
    opened.file.take(most.saturating_add(1)).read_to_end(&mut bytes).map_err(|error| error.to_string())?;
    if bytes.len() as u64 > most { Err(too_large()) } else { Ok(bytes) }
}

/// `a.mtl my b.mtl` -> `a.mtl`, `my b.mtl`: a name ends with the word that ends in `.mtl`.
fn split(names: &str) -> Vec<String> {
    let mut list = Vec::new();
    let mut name = String::new();
    for word in names.split_whitespace() {
        if !name.is_empty() {
            name.push(' ');
        }
        name.push_str(word);
        if unquoted(&name).to_ascii_lowercase().ends_with(".mtl") {
            list.push(unquoted(&std::mem::take(&mut name)).to_owned());
        }
    }
    if !name.is_empty() || list.is_empty() {
        list.push(unquoted(&name).to_owned());
    }
    list
}
