//! What was found -> a sentence: file, line, what it is, what would be right.

use super::Refusal;

/// Why there is no model. The text is the whole story; the variant says what kind of trouble it is.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The file is not there, or may not or cannot be read.
    #[error("{file}: {found}; {wanted}")]
    Unread {
        /// The file as the caller named it.
        file: String,
        /// What was met.
        found: String,
        /// What would be right.
        wanted: String,
    },
    /// A line says something that cannot be taken.
    #[error("{file}:{line}: {found}; {wanted}")]
    Bad {
        /// The file as the caller named it.
        file: String,
        /// Counted from 1.
        line: u64,
        /// What stands there.
        found: String,
        /// What would be right.
        wanted: String,
    },
    /// The file is sound but holds no triangle that can be drawn.
    #[error("{file}: {found}; wanted at least one `f` line with three corners in different places")]
    Empty {
        /// The file as the caller named it.
        file: String,
        /// What stands there instead.
        found: String,
    },
    /// The file asks for more than [`super::Limits`] allow. Nothing of it was allocated.
    #[error("{file}:{line}: too many {what}; at most {most} are taken")]
    TooMuch {
        /// The file as the caller named it.
        file: String,
        /// Counted from 1; 0 for the file as a whole.
        line: u64,
        /// Of what.
        what: &'static str,
        /// The limit.
        most: u64,
    },
}

impl Error {
    /// Whether another machine, or a larger limit, may have the memory that is lacking.
    #[must_use]
    pub fn is_of_memory(&self) -> bool {
        matches!(self, Self::TooMuch { what, .. } if what.contains("memory"))
    }

    pub(super) fn unread(file: &str, why: &Refusal) -> Self {
        Self::Unread { file: file.to_owned(), found: why.to_string(), wanted: why.remedy().to_owned() }
    }

    pub(super) fn bad(file: &str, line: u64, found: impl Into<String>, wanted: impl Into<String>) -> Self {
        Self::Bad { file: file.to_owned(), line, found: found.into(), wanted: wanted.into() }
    }

    pub(super) fn too_much(file: &str, line: u64, what: &'static str, most: u64) -> Self {
        Self::TooMuch { file: file.to_owned(), line, what, most }
    }
}
