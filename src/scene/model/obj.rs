//! OBJ text -> [`Mesh`]: positions, triangles, and the names of what the text refers to.
//!
//! The format: Wavefront, Advanced Visualizer 3.0, appendix B1. Polygons only: points, lines and free-form
//! curves are counted in a warning. Elements refer to vertices above them, as everyone writes them.

mod face;
mod names;

use std::collections::HashMap;
use std::io::Read;
use std::iter;

use glam::{Vec2, Vec3};

use super::budget::{Budget, Limits, Spent};
use super::far::told_apart;
use super::lines::{Line, LineError, Lines, Words, number, quote};
use super::polygon::Cutter;
use super::{Corner, Error, Triangle, Warnings};

/// Notes in the error of a file without a triangle.
const MOST_NOTES: usize = 3;

/// What the OBJ text alone tells.
#[derive(Debug, Default)]
pub struct Mesh {
    /// As [`super::Model::positions`].
    pub positions: Vec<Vec3>,
    /// As [`super::Model::uvs`].
    pub uvs: Vec<Vec2>,
    /// As written: of any length, 0 and not finite too.
    pub normals: Vec<Vec3>,
    /// Material and group count `materials` and `groups`; normals may be [`super::NONE`].
    pub triangles: Vec<Triangle>,
    /// One for each triangle.
    pub smoothing: Vec<Smoothing>,
    /// Names after `usemtl`, each with its first line; number 0 is "" for none.
    pub materials: Vec<(String, u64)>,
    /// Names after `o` and `g`; number 0 is "".
    pub groups: Vec<String>,
    /// What stands after each `mtllib`, which may be several names, with its line.
    pub libraries: Vec<(String, u64)>,
}

/// What the last `s` line above a face says.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Smoothing {
    /// There is none.
    #[default]
    Unsaid,
    /// `s off` or `s 0`.
    Off,
    /// The group's number.
    Group(u32),
}

/// Reads all of `source`; `file` is its name in messages.
///
/// # Errors
/// [`Error`] with the line.
pub fn parse(
    source: impl Read,
    file: &str,
    limits: &Limits,
    budget: &mut Budget,
    warnings: &mut Warnings,
) -> Result<Mesh, Error> {
    let mut parser = Parser::new(file, limits, budget, warnings);
    let mut lines = Lines::new(source, limits.line_bytes);
    while let Some(line) = lines.next().map_err(|error| parser.unreadable(&error))? {
        parser.line = line.number;
        parser.statement(line)?;
    }
    parser.finish()
}

struct Parser<'a> {
    file: &'a str,
    limits: &'a Limits,
    budget: &'a mut Budget,
    warnings: &'a mut Warnings,
    line: u64,
    mesh: Mesh,
    material: u32,
    material_numbers: HashMap<String, u32>,
    group: u32,
    group_numbers: HashMap<String, u32>,
    smoothing: Smoothing,
    cutter: Cutter,
    /// The polygon at hand, its corners' places, and its triangles.
    face: Vec<Corner>,
    places: Vec<Vec3>,
    cuts: Vec<[u32; 3]>,
}

impl<'a> Parser<'a> {
    fn new(file: &'a str, limits: &'a Limits, budget: &'a mut Budget, warnings: &'a mut Warnings) -> Self {
        let mesh = Mesh { materials: vec![(String::new(), 0)], groups: vec![String::new()], ..Mesh::default() };
        Self {
            file,
            limits,
            budget,
            warnings,
            line: 0,
            mesh,
            material: 0,
            material_numbers: HashMap::from([(String::new(), 0)]),
            group: 0,
            group_numbers: HashMap::from([(String::new(), 0)]),
            smoothing: Smoothing::Unsaid,
            cutter: Cutter::default(),
            face: Vec::new(),
            places: Vec::new(),
            cuts: Vec::new(),
        }
    }

    fn statement(&mut self, line: Line<'_>) -> Result<(), Error> {
        let mut words = Words::new(line.bytes);
        match words.next() {
            Some(keyword) => self.said(keyword, words),
            None => Ok(()),
        }
    }

    fn said(&mut self, keyword: &[u8], words: Words<'_>) -> Result<(), Error> {
        match keyword {
            b"v" => self.position(words),
            b"vt" => self.uv(words),
            b"vn" => self.normal(words),
            b"f" | b"fo" => self.face(words),
            b"usemtl" => self.usemtl(&words),
            b"o" | b"g" => self.group(&words),
            b"s" => {
                self.smooth(words);
                Ok(())
            }
            b"mtllib" => self.library(&words),
            b"l" | b"p" => self.pass_over("points and lines (`p`, `l`) are not drawn"),
            b"vp" | b"cstype" | b"deg" | b"bmat" | b"step" | b"curv" | b"curv2" | b"surf" | b"parm" | b"trim"
            | b"hole" | b"scrv" | b"sp" | b"end" | b"con" => {
                self.pass_over("free-form curves and surfaces are not drawn")
            }
            b"call" | b"csh" => self.pass_over("other files and commands (`call`, `csh`) are never run"),
            // Exporters do not agree about capitals.
            b"V" | b"VT" | b"VN" | b"F" | b"O" | b"G" | b"S" => self.said(&keyword.to_ascii_lowercase(), words),
            _ => {
                let sentence = format!("the statement {} is not known, and is passed over", quote(keyword));
                self.pass_over(&sentence)
            }
        }
    }

    #[expect(clippy::unnecessary_wraps, reason = "an arm of `statement`")]
    fn pass_over(&mut self, sentence: &str) -> Result<(), Error> {
        self.warnings.add(self.file, self.line, sentence);
        Ok(())
    }

    fn position(&mut self, mut words: Words<'_>) -> Result<(), Error> {
        self.room("vertices (`v`)", self.mesh.positions.len() as u64, self.limits.vertices)?;
        let position = Vec3::from(self.numbers(&mut words, "`v x y z`", 3)?);
        // A fourth number is the weight of rational curves, which we do not draw; more are colors.
        if words.next().is_some() && words.next().is_some() {
            self.warnings.add(self.file, self.line, "colors of vertices are not used");
        }
        self.budget.push(&mut self.mesh.positions, position).map_err(|Spent| self.spent())
    }

    fn uv(&mut self, mut words: Words<'_>) -> Result<(), Error> {
        self.room("texture coordinates (`vt`)", self.mesh.uvs.len() as u64, self.limits.vertices)?;
        let [u, v, _] = self.numbers(&mut words, "`vt u v`", 1)?;
        self.budget.push(&mut self.mesh.uvs, Vec2::new(u, v)).map_err(|Spent| self.spent())
    }

    fn normal(&mut self, mut words: Words<'_>) -> Result<(), Error> {
        self.room("normals (`vn`)", self.mesh.normals.len() as u64, self.limits.vertices)?;
        let normal = Vec3::from(self.numbers(&mut words, "`vn x y z`", 3)?);
        self.budget.push(&mut self.mesh.normals, normal).map_err(|Spent| self.spent())
    }

    /// Up to three numbers, of which the first `least` must be there; 0 for the others.
    #[inline]
    fn numbers(&self, words: &mut Words<'_>, wanted: &str, least: usize) -> Result<[f32; 3], Error> {
        let mut numbers = [0.0; 3];
        for (place, slot) in numbers.iter_mut().enumerate() {
            match words.next() {
                Some(word) => *slot = number(word).ok_or_else(|| self.not_a_number(word, wanted))?,
                None if place < least => {
                    let found = format!("found only {place} of the numbers of a vertex");
                    return Err(self.bad(found, format!("wanted {wanted}")));
                }
                None => break,
            }
        }
        Ok(numbers)
    }

    fn finish(self) -> Result<Mesh, Error> {
        let mut mesh = self.mesh;
        if mesh.triangles.is_empty() {
            // Why there is none may well be in the notes, which an error would lose.
            let vertices = format!("found {} vertices and no triangle to draw", mesh.positions.len());
            let notes = self.warnings.first(MOST_NOTES).map(ToString::to_string);
            let found = iter::once(vertices).chain(notes).collect::<Vec<_>>().join("; ");
            return Err(Error::Empty { file: self.file.to_owned(), found });
        }
        // No triangle has them any more; whoever takes bounds must not meet them.
        for position in &mut mesh.positions {
            if !position.is_finite() {
                *position = Vec3::ZERO;
            }
        }
        if let Some(sentence) = told_apart(&mesh.positions) {
            self.warnings.add(self.file, 0, sentence);
        }
        let mut lost = 0_u64;
        for uv in &mut mesh.uvs {
            if !uv.is_finite() {
                *uv = Vec2::ZERO;
                lost += 1;
            }
        }
        if lost > 0 {
            let sentence = format!("{lost} texture coordinates that are not finite are taken as 0");
            self.warnings.add(self.file, 0, sentence);
        }
        Ok(mesh)
    }

    /// Whether one more is allowed where there are `count`.
    #[inline]
    fn room(&self, what: &'static str, count: u64, most: u64) -> Result<(), Error> {
        if count < most { Ok(()) } else { Err(Error::too_much(self.file, self.line, what, most)) }
    }

    #[cold]
    fn spent(&self) -> Error {
        Error::too_much(self.file, self.line, "bytes of memory for this model", self.budget.whole)
    }

    #[cold]
    fn not_a_number(&self, word: &[u8], wanted: &str) -> Error {
        self.bad(
            format!("found {} where a number should be", quote(word)),
            format!("wanted {wanted}, like 0.5 or -1e-3"),
        )
    }

    #[cold]
    fn bad(&self, found: impl Into<String>, wanted: impl Into<String>) -> Error {
        Error::bad(self.file, self.line, found, wanted)
    }

    #[cold]
    fn unreadable(&self, error: &LineError) -> Error {
        match error {
            LineError::TooLong(line) => {
                Error::too_much(self.file, *line, "bytes in one line", self.limits.line_bytes as u64)
            }
            LineError::Utf16 => {
                Error::bad(self.file, 1, "found UTF-16 text", "wanted the file saved as UTF-8 or ASCII")
            }
            LineError::Read(why) => Error::Unread {
                file: self.file.to_owned(),
                found: format!("it cannot be read on after line {} ({why})", self.line),
                wanted: "wanted a file that can be read whole".to_owned(),
            },
        }
    }
}
