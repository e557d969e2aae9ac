//! Things passed over -> a short list: equal texts of one file are counted, not repeated.

use std::collections::HashMap;
use std::fmt;

/// Something that was passed over or replaced.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Warning {
    /// Relative to the scene's folder.
    pub file: String,
    /// Of the first time, counted from 1; 0 for the file as a whole.
    pub line: u64,
    /// One sentence without its full stop.
    pub text: String,
    /// How often this was met in this file.
    pub times: u64,
}

impl fmt::Display for Warning {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            0 => write!(out, "{}: {}", self.file, self.text)?,
            line => write!(out, "{}:{line}: {}", self.file, self.text)?,
        }
        match self.times {
            0 | 1 => Ok(()),
            times => write!(out, " ({times} times)"),
        }
    }
}

/// The warnings so far.
#[derive(Debug, Default)]
pub struct Warnings {
    list: Vec<Warning>,
    /// File and text -> place in the list.
    known: HashMap<(String, String), usize>,
    left_out: u64,
}

impl Warnings {
    /// So many different ones are kept: a hostile file must not fill memory with complaints.
    pub const MOST: usize = 200;

    /// Notes `text` about a line (0: about the whole file); one that is there already is counted.
    pub fn add(&mut self, file: &str, line: u64, text: impl Into<String>) {
        let key = (file.to_owned(), text.into());
        if let Some(warning) = self.known.get(&key).and_then(|&at| self.list.get_mut(at)) {
            warning.times += 1;
        } else if self.list.len() + 1 < Self::MOST {
            self.list.push(Warning { file: key.0.clone(), line, text: key.1.clone(), times: 1 });
            self.known.insert(key, self.list.len() - 1);
        } else {
            self.left_out += 1;
        }
    }

    /// The first so many, in the order in which they were met.
    pub fn first(&self, most: usize) -> impl Iterator<Item = &Warning> {
        self.list.iter().take(most)
    }

    /// In the order in which they were met; the last one tells how many more there were.
    #[must_use]
    pub fn into_vec(mut self) -> Vec<Warning> {
        if self.left_out > 0
            && let Some(file) = self.list.last().map(|last| last.file.clone())
        {
            let text = "further warnings are not listed".to_owned();
            self.list.push(Warning { file, line: 0, text, times: self.left_out });
        }
        self.list
    }
}
