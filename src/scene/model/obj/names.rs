//! What `usemtl`, `o`, `g`, `s` and `mtllib` say of the faces below them.

use std::collections::HashMap;

use super::super::Error;
use super::super::budget::Spent;
use super::super::lines::{Words, quote, text};
use super::{Mesh, Parser, Smoothing};

impl Parser<'_> {
    pub(super) fn usemtl(&mut self, words: &Words<'_>) -> Result<(), Error> {
        let name = text(words.rest());
        if name.is_empty() {
            self.warnings.add(self.file, self.line, "`usemtl` without a name chooses the default material");
        }
        let line = self.line;
        self.material = self.numbered(
            name,
            |parser| &mut parser.material_numbers,
            |mesh, name| mesh.materials.push((name, line)),
        )?;
        Ok(())
    }

    pub(super) fn group(&mut self, words: &Words<'_>) -> Result<(), Error> {
        self.group = self.numbered(
            text(words.rest()),
            |parser| &mut parser.group_numbers,
            |mesh, name| mesh.groups.push(name),
        )?;
        Ok(())
    }

    /// The number of a name; a new one is counted and noted.
    fn numbered(
        &mut self,
        name: String,
        numbers: impl Fn(&mut Self) -> &mut HashMap<String, u32>,
        note: impl Fn(&mut Mesh, String),
    ) -> Result<u32, Error> {
        let known = numbers(self).len() as u32;
        if let Some(&number) = numbers(self).get(&name) {
            return Ok(number);
        }
        self.room("names of groups or materials", known.into(), self.limits.names as u64)?;
        // Twice the text, and what a map's entry takes beside it.
        self.budget.take(2 * name.len() as u64 + 128).map_err(|Spent| self.spent())?;
        numbers(self).insert(name.clone(), known);
        note(&mut self.mesh, name);
        Ok(known)
    }

    pub(super) fn smooth(&mut self, mut words: Words<'_>) {
        let word = words.next().unwrap_or(b"off");
        let group = std::str::from_utf8(word).ok().and_then(|word| word.parse::<i64>().ok());
        self.smoothing = match (word, group) {
            (b"off", _) | (_, Some(0)) => Smoothing::Off,
            (b"on", _) => Smoothing::Group(1),
            (_, Some(group)) => Smoothing::Group(group as u32),
            _ => {
                let sentence = format!("the smoothing group {} is not a number, and is passed over", quote(word));
                self.warnings.add(self.file, self.line, sentence);
                self.smoothing
            }
        };
    }

    pub(super) fn library(&mut self, words: &Words<'_>) -> Result<(), Error> {
        let names = text(words.rest());
        if names.is_empty() {
            return self.pass_over("`mtllib` names no file");
        }
        if !self.mesh.libraries.iter().any(|(known, _)| *known == names) {
            self.room("`mtllib` lines", self.mesh.libraries.len() as u64, self.limits.mtl_files as u64)?;
            self.mesh.libraries.push((names, self.line));
        }
        Ok(())
    }
}
