//! Bytes -> logical lines with their numbers, words, numbers and names. Shared by OBJ and MTL.

use std::io::{self, Read};

/// A logical line: ends of line and `\` continuations are gone, the comment is not.
#[derive(Debug, Clone, Copy)]
pub struct Line<'a> {
    /// Of its first physical line, counted from 1.
    pub number: u64,
    /// At most [`Lines::new`]'s `longest` bytes.
    pub bytes: &'a [u8],
}

/// Why there is no next line.
#[derive(Debug)]
pub enum LineError {
    /// The line of this number is longer than the limit.
    TooLong(u64),
    /// The text is UTF-16.
    Utf16,
    /// The file cannot be read on.
    Read(io::Error),
}

/// Cuts what a reader gives into lines, holding one at a time.
///
/// LF, CR LF and CR end a line. A `\` at the end of a line joins the next one to it, but not in a
/// comment: `# from C:\models\` must not swallow the line below.
pub struct Lines<R> {
    source: R,
    /// `buffer[start..end]` was read and not yet given out.
    buffer: Vec<u8>,
    start: usize,
    end: usize,
    longest: usize,
    /// Physical lines given out.
    count: u64,
    finished: bool,
    at_start: bool,
}

impl<R: Read> Lines<R> {
    /// Lines of at most `longest` bytes.
    pub fn new(source: R, longest: usize) -> Self {
        let buffer = vec![0; longest + (64 << 10)];
        Self { source, buffer, start: 0, end: 0, longest, count: 0, finished: false, at_start: true }
    }

    /// The next line, empty ones too; `None` after the last.
    ///
    /// # Errors
    /// [`LineError`]; then the rest of the text is lost.
    #[expect(clippy::should_implement_trait, reason = "the line borrows from self")]
    pub fn next(&mut self) -> Result<Option<Line<'_>>, LineError> {
        if self.at_start {
            self.at_start = false;
            self.skip_mark()?;
        }
        let number = self.count + 1;
        let mut looked_at = self.start;
        loop {
            let fresh = self.buffer.get(looked_at..self.end).unwrap_or_default();
            let found = fresh.iter().position(|&byte| byte == b'\n').map(|at| looked_at + at);
            let stop = found.unwrap_or(self.end);
            if stop - self.start > self.longest {
                return Err(LineError::TooLong(number));
            }
            if found.is_none() && !self.finished {
                looked_at = self.end - self.start;
                self.fill()?;
                continue;
            }
            let line = self.buffer.get_mut(self.start..stop).unwrap_or_default();
            // A comment is not joined to the next line, so what was joined is none: looking once is
            // enough (and looking each time would take a million blank continuations' square).
            let may_join = self.count >= number || !line.trim_ascii_start().starts_with(b"#");
            if let Some(slash) = continuation(line).filter(|_| may_join) {
                // The joint becomes blanks in place, so that a logical line is one slice.
                looked_at = stop + usize::from(found.is_some());
                let joint = self.buffer.get_mut(self.start + slash..looked_at);
                joint.unwrap_or_default().fill(b' ');
                self.count += u64::from(found.is_some());
                continue;
            }
            if found.is_none() && self.start == self.end {
                return Ok(None);
            }
            let begin = self.start;
            self.start = stop + usize::from(found.is_some());
            self.count += 1;
            let bytes = self.buffer.get(begin..stop).unwrap_or_default();
            return Ok(Some(Line { number, bytes }));
        }
    }

    /// Moves the unread rest to the front, so that `start` is 0, and reads more behind it.
    fn fill(&mut self) -> Result<(), LineError> {
        self.buffer.copy_within(self.start..self.end, 0);
        self.end -= self.start;
        self.start = 0;
        // One byte is kept free for the look behind a CR at the very end.
        let room = self.buffer.len().saturating_sub(1);
        let count = self.read(self.end, room)?;
        let mut end = self.end + count;
        self.finished = count == 0;
        if count > 0 && self.buffer.get(end - 1) == Some(&b'\r') {
            end += self.read(end, end + 1)?;
        }
        let fresh = self.buffer.get_mut(self.end..end).unwrap_or_default();
        self.end = end;
        let mut from = 0;
        while let Some(at) = fresh.iter().skip(from).position(|&byte| byte == b'\r') {
            let is_pair = fresh.get(from + at + 1) == Some(&b'\n');
            if let Some(byte) = fresh.get_mut(from + at) {
                *byte = if is_pair { b' ' } else { b'\n' };
            }
            from += at + 1;
        }
        Ok(())
    }

    fn read(&mut self, from: usize, to: usize) -> Result<usize, LineError> {
        let room = self.buffer.get_mut(from..to).unwrap_or_default();
        loop {
            match self.source.read(room) {
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                other => return other.map_err(LineError::Read),
            }
        }
    }

    /// Passes over a UTF-8 byte order mark, and knows the UTF-16 ones.
    fn skip_mark(&mut self) -> Result<(), LineError> {
        while self.end < 3 && !self.finished {
            self.fill()?;
        }
        let text = self.buffer.get(..self.end).unwrap_or_default();
        if text.starts_with(&[0xEF, 0xBB, 0xBF]) {
            self.start = 3;
        } else if text.starts_with(&[0xFF, 0xFE]) || text.starts_with(&[0xFE, 0xFF]) {
            return Err(LineError::Utf16);
        }
        Ok(())
    }
}

/// Where the `\` stands that joins this line to the next one.
fn continuation(line: &[u8]) -> Option<usize> {
    let slash = line.trim_ascii_end().len().checked_sub(1)?;
    (line.get(slash) == Some(&b'\\')).then_some(slash)
}

/// The words of a line, up to a comment.
#[derive(Debug, Clone)]
pub struct Words<'a> {
    rest: &'a [u8],
}

impl<'a> Words<'a> {
    /// The words of `line`.
    #[must_use]
    pub fn new(line: &'a [u8]) -> Self {
        Self { rest: line }
    }

    /// All that is left, without the blanks around it: for names, which may hold blanks and `#`.
    #[must_use]
    pub fn rest(&self) -> &'a [u8] {
        self.rest.trim_ascii()
    }
}

impl<'a> Iterator for Words<'a> {
    type Item = &'a [u8];

    #[inline]
    fn next(&mut self) -> Option<&'a [u8]> {
        let begin = self.rest.iter().position(|byte| *byte > b' ')?;
        let (_, rest) = self.rest.split_at_checked(begin)?;
        if rest.first() == Some(&b'#') {
            self.rest = &[];
            return None;
        }
        // All control characters part words, so that a NUL or a tab cannot hide in one.
        let length = rest.iter().position(|byte| *byte <= b' ').unwrap_or(rest.len());
        let (word, rest) = rest.split_at_checked(length)?;
        self.rest = rest;
        Some(word)
    }
}

/// A number as C and Rust write it, `nan` and `inf` and Visual C++'s `1.#INF` included; `None` for any
/// other word. The caller decides about what is not finite.
#[must_use]
pub fn number(word: &[u8]) -> Option<f32> {
    let text = std::str::from_utf8(word).ok()?;
    if let Ok(number) = text.parse() {
        return Some(number);
    }
    let (_, special) = text.split_once(".#")?;
    let known = ["IND", "INF", "QNAN", "SNAN"];
    known.iter().any(|name| special.starts_with(name)).then_some(f32::NAN)
}

/// Bytes as text: UTF-8, or else Latin-1, in which every byte is a character, so that two different
/// names never become one.
#[must_use]
pub fn text(bytes: &[u8]) -> String {
    match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().copied().map(char::from).collect(),
    }
}

/// What stands before a `#` with a blank before it, without quotes: the name is meant, and a comment after it, if the whole
/// (`Material #25`) is the name of nothing.
#[must_use]
pub fn before_comment(name: &str) -> Option<&str> {
    let at = name.match_indices('#').map(|(at, _)| at).find(|&at| name[..at].ends_with([' ', '\t']))?;
    let before = unquoted(&name[..at]);
    (!before.is_empty()).then_some(before)
}

/// A name without the quotes and blanks around it.
#[must_use]
pub fn unquoted(name: &str) -> &str {
    name.trim().trim_matches(['"', '\'']).trim()
}

/// Bytes for a message: in backquotes, short, nothing in it that a terminal would obey.
#[must_use]
pub fn quote(bytes: &[u8]) -> String {
    let text = text(bytes);
    let start: String = text.chars().take(40).collect();
    let dots = if start.len() < text.len() { "..." } else { "" };
    format!("`{}{dots}`", start.escape_debug())
}
