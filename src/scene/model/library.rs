//! MTL files -> materials by their names.

use std::collections::HashMap;

use super::find::Sheet;
use super::lines::{before_comment, quote};
use super::mtl::{Written, parse};
use super::{Limits, Warnings};

/// All materials of a model's MTL files.
pub(super) struct Library {
    written: HashMap<String, Written>,
    /// Name before a comment -> name.
    before_comments: HashMap<String, String>,
}

impl Library {
    /// Of materials with the same name the last one stays.
    pub(super) fn read(sheets: &[Sheet], limits: &Limits, warnings: &mut Warnings) -> Self {
        let mut library = Self { written: HashMap::new(), before_comments: HashMap::new() };
        for sheet in sheets {
            for material in parse(&sheet.bytes, &sheet.file, limits, warnings) {
                let (name, line) = (material.material.name.clone(), material.line);
                if let Some(before) = before_comment(&name) {
                    library.before_comments.insert(before.to_owned(), name.clone());
                }
                if library.written.insert(name.clone(), material).is_some() {
                    let name = quote(name.as_bytes());
                    let text = format!("material {name} is defined again, and the later one is used");
                    warnings.add(&sheet.file, line, text);
                }
            }
        }
        library
    }

    /// The material that `usemtl wanted` means, first said in that line of `file`: the name, or the name before a comment
    /// there or here. None, with a note, if there is none; none without a name.
    pub(super) fn find(&self, wanted: &str, file: &str, line: u64, warnings: &mut Warnings) -> Option<&Written> {
        if let Some(found) = self.written.get(wanted) {
            return Some(found);
        }
        if wanted.is_empty() {
            return None;
        }
        let without = before_comment(wanted).and_then(|before| self.written.get_key_value(before));
        let meant = || self.before_comments.get(wanted).and_then(|name| self.written.get_key_value(name));
        let found = without.or_else(meant);
        let name = quote(wanted.as_bytes());
        let instead = match found {
            Some((instead, _)) => format!("; {} is used", quote(instead.as_bytes())),
            None => ", and is drawn light gray".to_owned(),
        };
        warnings.add(file, line, format!("material {name} is defined in no MTL file{instead}"));
        found.map(|(_, written)| written)
    }
}
