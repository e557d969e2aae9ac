//! wgsl files -> one kernel's source, and back from its lines to theirs

use std::borrow::Cow;

/// A line of this form is replaced by a file's text, the first time that the file is named.
const IMPORT: &str = "#import ";

macro_rules! embed {
    ($($name:literal),+ $(,)?) => {
        /// Every file of `wgsl/` with its text, by its path without the ending, in order.
        pub const FILES: &[(&str, &str)] =
            &[$(($name, include_str!(concat!("../../wgsl/", $name, ".wgsl")))),+];
    };
}

embed! {
    "math/power",
    "math/random",
    "math/sphere",
    "math/vector",
    "raster/clear",
    "raster/clip",
    "raster/count",
    "raster/cover",
    "raster/facet",
    "raster/fence",
    "raster/fill",
    "raster/mark",
    "raster/plan",
    "raster/project",
    "raster/reach",
    "raster/scan",
    "raster/shade",
    "raster/shadow",
    "raster/snap",
    "raster/split",
    "raster/texture",
    "raster/weights",
    "shade/phong",
    "tables/lens",
    "tables/light",
    "tables/material",
    "tables/mesh",
    "tables/paint",
    "tables/path",
    "tables/piece",
    "tables/plane",
    "tables/settings",
    "tables/slice",
    "tables/sphere",
    "tables/status",
    "tables/triangle",
    "tables/view",
    "trace/cast",
    "trace/follow",
    "trace/gather",
    "trace/meet",
    "trace/scatter",
    "trace/surface",
    "trace/walk",
}

/// Where kernels get their text from: the files built in, or some of them changed.
#[derive(Debug, Clone, Default)]
pub struct Sources {
    changed: Vec<(String, String)>,
}

impl Sources {
    /// The text of a file, by its path without the ending.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<Cow<'_, str>> {
        let changed = self.changed.iter().find(|(n, _)| n == name).map(|(_, text)| Cow::Borrowed(text.as_str()));
        changed.or_else(|| FILES.iter().find(|(n, _)| *n == name).map(|(_, text)| Cow::Borrowed(*text)))
    }

    /// The same sources with another text for one file: how a fault is planted, or a kernel tried out.
    #[must_use]
    pub fn with(mut self, name: &str, text: String) -> Self {
        self.changed.retain(|(n, _)| n != name);
        self.changed.push((name.to_owned(), text));
        self
    }
}

/// A kernel's source, joined from its files.
#[derive(Debug, Clone, Default)]
pub struct Joined {
    /// WGSL.
    pub text: String,
    lines: Vec<(String, u32)>,
}

impl Joined {
    /// The file and line, from 1, that a line of `text`, from 1, was written in.
    #[must_use]
    pub fn origin(&self, line: u32) -> Option<(&str, u32)> {
        let (file, line) = self.lines.get(line.checked_sub(1)? as usize)?;
        Some((file, *line))
    }
}

/// The source of the kernel that is written in file `name`.
///
/// # Errors
/// A sentence, if a file is named that does not exist.
pub fn join(sources: &Sources, name: &str) -> Result<Joined, String> {
    let mut joined = Joined::default();
    let mut seen = Vec::new();
    pull(sources, name, &mut seen, &mut joined)?;
    Ok(joined)
}

fn pull(sources: &Sources, name: &str, seen: &mut Vec<String>, out: &mut Joined) -> Result<(), String> {
    if seen.iter().any(|s| s == name) {
        return Ok(());
    }
    let text = sources.get(name).ok_or_else(|| format!("there is no file wgsl/{name}.wgsl"))?;
    seen.push(name.to_owned());
    for (line, number) in text.lines().zip(1..) {
        if let Some(import) = line.strip_prefix(IMPORT) {
            let import = import.trim().trim_matches('"').trim_end_matches(".wgsl");
            pull(sources, import, seen, out).map_err(|e| format!("wgsl/{name}.wgsl:{number}: {e}"))?;
        } else {
            out.text.push_str(line);
            out.text.push('\n');
            out.lines.push((format!("wgsl/{name}.wgsl"), number));
        }
    }
    Ok(())
}
