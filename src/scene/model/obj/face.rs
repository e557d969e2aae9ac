//! The words of an `f` line -> checked indices -> triangles of the mesh.

use super::super::budget::Spent;
use super::super::lines::{Words, quote};
use super::super::polygon::Cut;
use super::super::{Corner, Error, NONE, Triangle};
use super::Parser;

impl Parser<'_> {
    /// Reads the corners, cuts the polygon, keeps the triangles that can be seen.
    pub(super) fn face(&mut self, words: Words<'_>) -> Result<(), Error> {
        let mut face = std::mem::take(&mut self.face);
        face.clear();
        for word in words {
            face.push(self.corner(word)?);
        }
        let done = self.polygon(&face);
        self.face = face;
        done
    }

    /// `v`, `v/vt`, `v//vn` or `v/vt/vn`.
    #[inline]
    fn corner(&self, word: &[u8]) -> Result<Corner, Error> {
        let mut parts = word.split(|&byte| byte == b'/');
        let position = parts.next().unwrap_or_default();
        let corner = Corner {
            position: self.index(position, word, "v", self.mesh.positions.len())?,
            uv: self.optional(parts.next(), word, "vt", self.mesh.uvs.len())?,
            normal: self.optional(parts.next(), word, "vn", self.mesh.normals.len())?,
        };
        match parts.next() {
            None => Ok(corner),
            Some(_) => {
                Err(self
                    .bad(format!("found the corner {}", quote(word)), "wanted `v`, `v/vt`, `v//vn` or `v/vt/vn`"))
            }
        }
    }

    #[inline]
    fn optional(&self, part: Option<&[u8]>, word: &[u8], list: &str, count: usize) -> Result<u32, Error> {
        match part {
            None | Some([]) => Ok(NONE),
            Some(part) => self.index(part, word, list, count),
        }
    }

    /// 1 is the first of `count` above this line, -1 the last.
    #[inline]
    fn index(&self, part: &[u8], word: &[u8], list: &str, count: usize) -> Result<u32, Error> {
        let (negative, digits) = match part {
            [b'-', digits @ ..] => (true, digits),
            digits => (false, digits),
        };
        let mut value = 0_u64;
        for digit in digits {
            if !digit.is_ascii_digit() {
                value = u64::MAX;
                break;
            }
            value = value.saturating_mul(10).saturating_add(u64::from(digit - b'0'));
        }
        let place = if negative { (count as u64).checked_sub(value) } else { value.checked_sub(1) };
        match place.filter(|&place| place < count as u64 && !digits.is_empty()) {
            Some(place) => Ok(place as u32),
            None => Err(self.bad_index(digits, word, list, count)),
        }
    }

    #[cold]
    fn bad_index(&self, digits: &[u8], word: &[u8], list: &str, count: usize) -> Error {
        let found = format!("found the corner {}", quote(word));
        if digits.is_empty() || !digits.iter().all(u8::is_ascii_digit) {
            return self.bad(found, "wanted `v`, `v/vt`, `v//vn` or `v/vt/vn` in whole numbers");
        }
        match count {
            0 => self.bad(found, format!("wanted no index into `{list}`, since no `{list}` stands above this line")),
            _ => self.bad(found, format!("wanted an index into `{list}` from 1 to {count} or from -{count} to -1, since {count} stand above this line")),
        }
    }

    fn polygon(&mut self, face: &[Corner]) -> Result<(), Error> {
        if face.len() < 3 {
            return self.pass_over("a face with fewer than three corners is not drawn");
        }
        self.places.clear();
        self.places.extend(face.iter().filter_map(|corner| self.mesh.positions.get(corner.position as usize)));
        if !self.places.iter().all(|place| place.is_finite()) {
            return self.pass_over("a face with a vertex that is not finite is not drawn");
        }
        self.room("triangles", (self.mesh.triangles.len() + face.len() - 3) as u64, self.limits.triangles)?;
        match self.cutter.cut(&self.places, &mut self.cuts) {
            Cut::Fan | Cut::Ears => {}
            Cut::Crossing => self.warnings.add(
                self.file,
                self.line,
                "a polygon that crosses or touches itself is drawn in one of several ways",
            ),
            Cut::TooLarge => self.warnings.add(
                self.file,
                self.line,
                "a concave polygon with very many corners is drawn as if it were convex",
            ),
        }
        for cut in &self.cuts {
            let [Some(&a), Some(&b), Some(&c)] = cut.map(|at| face.get(at as usize)) else { continue };
            let [Some(p), Some(q), Some(r)] = cut.map(|at| self.places.get(at as usize)) else { continue };
            // Two corners in one place cover nothing from anywhere. A triangle of three places in a
            // line is kept: rounded to a pixel grid, it closes the seam to a neighbor's long side.
            if p == q || q == r || r == p {
                self.warnings.add(self.file, self.line, "a triangle with two corners in one place is not drawn");
                continue;
            }
            let triangle = Triangle { corners: [a, b, c], material: self.material, group: self.group };
            let kept = self.budget.push(&mut self.mesh.triangles, triangle);
            let kept = kept.and_then(|()| self.budget.push(&mut self.mesh.smoothing, self.smoothing));
            kept.map_err(|Spent| self.spent())?;
        }
        Ok(())
    }
}
