//! wgsl files -> one kernel's source, and back from its lines to theirs

use std::borrow::Cow;
use std::path::Path;

/// A line of this form is replaced by a file's text, the first time that the file is named.
const IMPORT: &str = "#import ";
/// The lines from one of this form to [`END`] are written once for each of a kind of thing, or so many times, with its
/// number in the place of [`NUMBER`]: an index that is a constant is what lavapipe reads once for all lanes, not lane by lane.
const REPEAT: &str = "#repeat ";
/// The lines from one of this form to [`ELSE`] or [`END`] are there if the sources are for what it names, those from
/// [`ELSE`] on if they are not.
const IF: &str = "#if ";
const ELSE: &str = "#else";
const END: &str = "#end";
const NUMBER: &str = "$i";

macro_rules! embed {
    ($($name:literal),+ $(,)?) => {
        /// Every file of `wgsl/` with its text, by its path without the ending, in order.
        pub const FILES: &[(&str, &str)] =
            &[$(($name, include_str!(concat!("../../wgsl/", $name, ".wgsl")))),+];
    };
}

embed! {
    "film/develop",
    "math/angle",
    "math/fence",
    "math/power",
    "math/quotient",
    "math/random",
    "math/sphere",
    "math/vector",
    "math/whole",
    "raster/behind",
    "raster/call",
    "raster/clip",
    "raster/count",
    "raster/cover",
    "raster/crowd",
    "raster/cut",
    "raster/facet",
    "raster/far",
    "raster/fill",
    "raster/ground",
    "raster/heat",
    "raster/hold",
    "raster/lace",
    "raster/mark",
    "raster/pixels",
    "raster/plan",
    "raster/project",
    "raster/reach",
    "raster/scan",
    "raster/shade",
    "raster/shadow",
    "raster/sift",
    "raster/snap",
    "raster/speck",
    "raster/split",
    "raster/veil",
    "raster/weights",
    "shade/look",
    "shade/phong",
    "shade/scale",
    "shade/texture",
    "tables/instance",
    "tables/leaf",
    "tables/lens",
    "tables/light",
    "tables/material",
    "tables/mesh",
    "tables/node",
    "tables/paint",
    "tables/path",
    "tables/piece",
    "tables/plane",
    "tables/print",
    "tables/settings",
    "tables/slice",
    "tables/sphere",
    "tables/status",
    "tables/texel",
    "tables/view",
    "trace/aim",
    "trace/boxes",
    "trace/cast",
    "trace/detail",
    "trace/few",
    "trace/follow",
    "trace/gather",
    "trace/hold",
    "trace/instanced",
    "trace/lay",
    "trace/meet",
    "trace/primary",
    "trace/scatter",
    "trace/seat",
    "trace/solid",
    "trace/stack",
    "trace/steps",
    "trace/surface",
    "trace/tree",
    "trace/triangle",
    "trace/unrolled",
    "trace/walk",
}

/// Where kernels get their text from: the files built in, or some of them changed.
#[derive(Debug, Clone, Default)]
pub struct Sources {
    changed: Vec<(String, String)>,
    counts: Vec<(String, u32)>,
    variant: Vec<String>,
}

impl Sources {
    /// The text of a file, by its path without the ending.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<Cow<'_, str>> {
        let changed = self.changed.iter().find(|(n, _)| n == name).map(|(_, text)| Cow::Borrowed(text.as_str()));
        changed.or_else(|| FILES.iter().find(|(n, _)| *n == name).map(|(_, text)| Cow::Borrowed(*text)))
    }

    /// The kernels of a folder, each file by the name of one that is built in.
    ///
    /// # Errors
    /// If one of them cannot be read.
    pub fn of_folder(folder: &Path) -> std::io::Result<Self> {
        let read = |name: &str| std::fs::read_to_string(folder.join(name).with_extension("wgsl"));
        FILES.iter().try_fold(Self::default(), |all, (name, _)| Ok(all.with(name, read(name)?)))
    }

    /// The same sources with another text for one file: how a fault is planted, or a kernel tried out.
    #[must_use]
    pub fn with(mut self, name: &str, text: String) -> Self {
        self.changed.retain(|(n, _)| n != name);
        self.changed.push((name.to_owned(), text));
        self
    }

    /// The same sources for so many of a kind of thing: what is in `#repeat KIND` is written as often; else once.
    #[must_use]
    pub fn with_count(mut self, kind: &str, count: u32) -> Self {
        self.counts.retain(|(k, _)| k != kind);
        self.counts.push((kind.to_owned(), count));
        self
    }

    /// The same sources for a variant of a kernel: what is in `#if WHAT` is there, what is in its `#else` is not.
    #[must_use]
    pub fn for_what(mut self, what: &str) -> Self {
        self.variant.push(what.to_owned());
        self
    }

    fn are_for(&self, what: &str) -> bool {
        self.variant.iter().any(|w| w == what)
    }

    /// A line with each `$KIND` replaced by how many there are.
    fn counted<'a>(&self, line: &'a str) -> Cow<'a, str> {
        let Some((before, rest)) = line.split_once('$') else { return Cow::Borrowed(line) };
        let end = rest.find(|c: char| !c.is_ascii_lowercase()).unwrap_or(rest.len());
        let (kind, after) = rest.split_at(end);
        Cow::Owned(format!("{before}{}{after}", self.count(kind)))
    }

    fn count(&self, kind: &str) -> u32 {
        let told = || self.counts.iter().find(|(k, _)| k == kind).map_or(1, |(_, count)| *count);
        kind.parse().unwrap_or_else(|_| told())
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
    let lines: Vec<_> = text.lines().zip(1..).collect();
    put(sources, name, &lines, seen, out)
}

/// Lines of one file, with what they ask for in the place of those that begin with `#`.
fn put(
    sources: &Sources,
    name: &str,
    mut lines: Lines<'_, '_>,
    seen: &mut Vec<String>,
    out: &mut Joined,
) -> Result<(), String> {
    while let Some((&(line, number), rest)) = lines.split_first() {
        lines = rest;
        let trimmed = line.trim_start();
        if let Some(import) = line.strip_prefix(IMPORT) {
            let import = import.trim().trim_matches('"').trim_end_matches(".wgsl");
            pull(sources, import, seen, out).map_err(|e| format!("wgsl/{name}.wgsl:{number}: {e}"))?;
        } else if let Some(kind) = trimmed.strip_prefix(REPEAT) {
            let [body, _, after] = block(lines);
            lines = after;
            for i in 0..sources.count(kind.trim()) {
                let numbered: Vec<_> = body.iter().map(|(l, n)| (l.replace(NUMBER, &i.to_string()), *n)).collect();
                let numbered: Vec<_> = numbered.iter().map(|(l, n)| (l.as_str(), *n)).collect();
                put(sources, name, &numbered, seen, out)?;
            }
        } else if let Some(what) = trimmed.strip_prefix(IF) {
            let [then, otherwise, after] = block(lines);
            lines = after;
            put(sources, name, if sources.are_for(what.trim()) { then } else { otherwise }, seen, out)?;
        } else {
            out.text.push_str(&sources.counted(line));
            out.text.push('\n');
            out.lines.push((format!("wgsl/{name}.wgsl"), number));
        }
    }
    Ok(())
}

/// Lines of a file with their numbers.
type Lines<'a, 'b> = &'a [(&'b str, u32)];

/// The lines up to this block's [`ELSE`], those from there to its [`END`], and those after it.
fn block<'a, 'b>(lines: Lines<'a, 'b>) -> [Lines<'a, 'b>; 3] {
    let (mut depth, mut middle) = (0, None);
    for (i, (line, _)) in lines.iter().enumerate() {
        let line = line.trim();
        if line.starts_with(REPEAT) || line.starts_with(IF) {
            depth += 1;
        } else if line == ELSE && depth == 0 {
            middle = Some(i);
        } else if line == END {
            if depth == 0 {
                let otherwise = middle.map_or(i, |m| m + 1);
                return [&lines[..middle.unwrap_or(i)], &lines[otherwise..i], &lines[i + 1..]];
            }
            depth -= 1;
        }
    }
    [lines, &[], &[]]
}
