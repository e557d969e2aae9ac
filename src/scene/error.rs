//! What is wrong with a scene file, where, and what would be right.

use std::fmt::{self, Write as _};
use std::ops::Range;
use std::path::PathBuf;

use toml::de::{DeTable, DeValue};

use super::source::SET;

/// Why a scene cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The file cannot be read.
    #[error("{}: cannot read the scene: {why}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system says, or what kind of thing it is.
        why: String,
    },
    /// The text is not a scene.
    #[error("{0}")]
    Text(Box<Complaint>),
    /// The picture would not fit into memory.
    #[error("a film of {}x{} needs at least {needed} MiB, and {most} MiB of memory may be taken; render it smaller", size[0], size[1])]
    Memory {
        /// The film's width and height.
        size: [u32; 2],
        /// MiB.
        needed: u64,
        /// MiB.
        most: u64,
    },
    /// More pixels than can be counted; the film's width and height.
    #[error("a film of {}x{} has too many pixels; below 2^30 of them can be counted", .0[0], .0[1])]
    Pixels([u32; 2]),
}

impl Error {
    /// The same, known to be about memory.
    pub(super) fn of_memory(mut self) -> Self {
        if let Self::Text(complaint) = &mut self {
            complaint.memory = true;
        }
        self
    }
}

/// A place in the text and what is wrong with it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Complaint {
    /// The file, as it was called.
    pub file: PathBuf,
    /// From 1.
    pub line: usize,
    /// From 1, in characters.
    pub column: usize,
    /// Dotted, with array entries counted from 0: `object.sphere[1].radius`. Empty outside all fields.
    pub field: String,
    /// What was found and what would be right.
    pub message: String,
    /// Whether it is about memory, of which there may be more elsewhere.
    pub memory: bool,
    /// The line itself.
    excerpt: String,
    /// How many characters to underline.
    width: usize,
}

impl Complaint {
    /// Whether it is about what the command line sets, rather than about the file.
    #[must_use]
    pub fn of_command_line(&self) -> bool {
        self.file.as_os_str() == SET
    }

    /// A complaint about `span` of `text`. Unless the message says what was found, the text itself does.
    pub(super) fn new(file: PathBuf, text: &str, span: Range<usize>, right: &str) -> Self {
        let start = floor(text, span.start);
        let end = floor(text, span.end).max(start);
        let line_start = text[..start].rfind('\n').map_or(0, |at| at + 1);
        let line_end = text[start..].find('\n').map_or(text.len(), |at| start + at);
        let excerpt = text[line_start..line_end].trim_end_matches('\r');
        let found = text[start..end].lines().next().unwrap_or_default().trim();
        let says_itself = right.contains('`') || right.starts_with("invalid") || found.is_empty();
        let message = if says_itself { right.to_owned() } else { format!("found {}; {right}", shorten(found)) };
        Self {
            file,
            line: text[..start].matches('\n').count() + 1,
            column: text[line_start..start].chars().count() + 1,
            field: field_at(text, start),
            message,
            memory: false,
            excerpt: excerpt.chars().take(160).collect(),
            width: text[start..end.min(line_end)].trim_end().chars().count().clamp(1, 160),
        }
    }
}

impl fmt::Display for Complaint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { file, line, column, field, message, excerpt, width, .. } = self;
        let colon = if field.is_empty() { "" } else { ": " };
        writeln!(f, "{}:{line}:{column}: {field}{colon}{message}", file.display())?;
        let number = line.to_string();
        let margin = " ".repeat(number.len());
        writeln!(f, "{margin} |")?;
        writeln!(f, "{number} | {excerpt}")?;
        // Tabs stay tabs, so that the mark stands below what it marks.
        let before: String = excerpt.chars().take(column - 1).map(|c| if c == '\t' { '\t' } else { ' ' }).collect();
        write!(f, "{margin} | {before}{}", "^".repeat((*width).min(160_usize.saturating_sub(column - 1).max(1))))
    }
}

fn shorten(found: &str) -> String {
    if found.chars().count() <= 60 {
        return found.to_owned();
    }
    found.chars().take(57).chain("...".chars()).collect()
}

fn floor(text: &str, at: usize) -> usize {
    let mut at = at.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

/// The innermost field whose key or value holds the byte `at`, as far as the text can be read as TOML.
fn field_at(text: &str, at: usize) -> String {
    let (table, _) = DeTable::parse_recoverable(text);
    let mut path = String::new();
    in_table(table.get_ref(), at, &mut path);
    path
}

fn in_table(table: &DeTable<'_>, at: usize, path: &mut String) -> bool {
    for (key, value) in table {
        let before = path.len();
        if !path.is_empty() {
            path.push('.');
        }
        path.push_str(key.get_ref());
        if in_value(value.get_ref(), at, path) || key.span().contains(&at) || value.span().contains(&at) {
            return true;
        }
        path.truncate(before);
    }
    false
}

fn in_value(value: &DeValue<'_>, at: usize, path: &mut String) -> bool {
    match value {
        DeValue::Table(table) => in_table(table, at, path),
        DeValue::Array(array) => {
            // A list of numbers is one field; a list of tables is many.
            for (i, entry) in array.iter().enumerate().filter(|(_, entry)| entry.get_ref().is_table()) {
                let before = path.len();
                let _ = write!(path, "[{i}]");
                if in_value(entry.get_ref(), at, path) || entry.span().contains(&at) {
                    return true;
                }
                path.truncate(before);
            }
            false
        }
        _ => false,
    }
}
