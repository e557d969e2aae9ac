//! a scene's text and values by hand -> the text with them in their places; all else of it stays as it is

use std::cell::RefCell;
use std::collections::HashMap;

use toml::de::{DeTable, DeValue};

use super::place::{Place, Step, Value};

/// A scene file that somebody works on.
#[derive(Debug, Clone)]
pub struct Draft {
    text: String,
    edits: Vec<(String, String)>,
    /// What was asked for since the text has changed: a window asks for all of it, frame after frame.
    known: RefCell<HashMap<String, Option<Held>>>,
}

/// What a field holds.
#[derive(Debug, Clone, PartialEq)]
pub enum Held {
    /// One number.
    Number(f64),
    /// Some numbers.
    Numbers(Vec<f64>),
    /// A word, or a color as `#rrggbb`.
    Word(String),
    /// So many tables.
    Tables(usize),
}

impl Held {
    /// As the file writes it; tables are not written.
    #[must_use]
    pub fn to_toml(&self) -> String {
        match self {
            Self::Number(number) => shown(*number),
            Self::Numbers(list) => format!("[{}]", list.iter().map(|n| shown(*n)).collect::<Vec<_>>().join(", ")),
            // What JSON writes between quotation marks, TOML reads.
            Self::Word(word) => serde_json::Value::from(word.as_str()).to_string(),
            Self::Tables(_) => String::new(),
        }
    }

    fn of(value: &DeValue<'_>) -> Option<Self> {
        match value {
            DeValue::String(word) => Some(Self::Word(word.to_string())),
            DeValue::Array(list) if !list.is_empty() && list.iter().all(|entry| entry.get_ref().is_table()) => {
                Some(Self::Tables(list.len()))
            }
            DeValue::Array(list) => {
                list.iter().map(|entry| number(entry.get_ref())).collect::<Option<_>>().map(Self::Numbers)
            }
            plain => number(plain).map(Self::Number),
        }
    }
}

fn number(value: &DeValue<'_>) -> Option<f64> {
    match value {
        DeValue::Integer(whole) => {
            i64::from_str_radix(whole.as_str(), whole.radix()).ok().map(|whole| whole as f64)
        }
        DeValue::Float(float) => float.as_str().parse().ok(),
        _ => None,
    }
}

/// A number in the simplest form: counts are whole numbers, and all other fields take those too.
fn shown(number: f64) -> String {
    if number.fract() == 0.0 && number.abs() < 1e15 { format!("{number:.0}") } else { format!("{number:?}") }
}

impl Draft {
    /// A text that is TOML.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn new(text: &str) -> Result<Self, String> {
        DeTable::parse(text).map_err(|error| error.message().to_owned())?;
        Ok(Self { text: text.to_owned(), edits: Vec::new(), known: RefCell::default() })
    }

    /// What was put in by hand, the last for each place: as `--set` takes it.
    #[must_use]
    pub fn edits(&self) -> &[(String, String)] {
        &self.edits
    }

    /// The text is what the file holds now.
    pub fn saved(&mut self) {
        self.edits.clear();
    }

    /// The text with all that was put in.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// How many tables stand in an array of them: `light.point`.
    #[must_use]
    pub fn count(&self, place: &str) -> usize {
        if let Some(Held::Tables(count)) = self.get(place) { count } else { 0 }
    }

    /// What a field holds; nothing if it is left out.
    #[must_use]
    pub fn get(&self, place: &str) -> Option<Held> {
        if let Some(known) = self.known.borrow().get(place) {
            return known.clone();
        }
        let read = || {
            let document = DeTable::parse(&self.text).ok()?;
            Held::of(Place::parse(place).ok()?.get(document.get_ref())?.get_ref())
        };
        let held = read();
        self.known.borrow_mut().insert(place.to_owned(), held.clone());
        held
    }

    /// Puts a value into a field; a table of one is made where there is none.
    ///
    /// # Errors
    /// A sentence, if there is no such place, or the value is not TOML; then the text stays as it is.
    pub fn set(&mut self, place: &str, value: &str) -> Result<(), String> {
        let value = value.trim();
        DeValue::parse(value).map_err(|error| error.message().to_owned())?;
        let text = self.with(&Place::parse(place)?, value)?;
        // What does not fit together is found out here, whatever the text is like.
        let document = DeTable::parse(&text).map_err(|error| error.message().to_owned())?;
        let there = Place::parse(place)?.get(document.get_ref()).is_some();
        if !there {
            return Err(format!("{place}: there is no such place in the file"));
        }
        self.text = text;
        self.known.borrow_mut().clear();
        self.edits.retain(|(edited, _)| edited != place);
        self.edits.push((place.to_owned(), value.to_owned()));
        Ok(())
    }

    fn with(&self, place: &Place, value: &str) -> Result<String, String> {
        let nowhere = || format!("{place}: there is no such place in the file");
        let document = DeTable::parse(&self.text).map_err(|error| error.message().to_owned())?;
        let document = document.get_ref();
        if let Some(old) = place.get(document) {
            return Ok(replaced(&self.text, old.span(), value));
        }
        let Some((Step::Field(name), above)) = place.steps().split_last() else { return Err(nowhere()) };
        let line = format!("{name} = {value}");
        if let [Step::Field(table)] = above
            && document.get(table.as_str()).is_none()
        {
            let gap = if self.text.is_empty() || self.text.ends_with('\n') { "" } else { "\n" };
            return Ok(format!("{}{gap}\n[{table}]\n{line}\n", self.text));
        }
        if above.is_empty() {
            return Ok(format!("{line}\n{}", self.text));
        }
        let table = Place::of(above).get(document).ok_or_else(nowhere)?;
        let at = end_of(&self.text, table).ok_or_else(|| {
            format!("{place}: the table that it belongs to stands on one line, which is for the hand to change")
        })?;
        Ok(replaced(&self.text, at..at, &format!("\n{line}")))
    }
}

fn replaced(text: &str, span: std::ops::Range<usize>, value: &str) -> String {
    format!("{}{value}{}", &text[..span.start], &text[span.end..])
}

/// The end of the last line of a table's own values, or of its header.
fn end_of(text: &str, table: &Value<'_>) -> Option<usize> {
    let DeValue::Table(values) = table.get_ref() else { return None };
    if text[table.span()].starts_with('{') {
        return None;
    }
    let own = |value: &&Value<'_>| !matches!(Held::of(value.get_ref()), Some(Held::Tables(_)) | None);
    let last = values.values().filter(own).map(|value| value.span().end).max();
    let at = last.unwrap_or(table.span().end);
    Some(text[at..].find('\n').map_or(text.len(), |line| at + line))
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "# head\n[camera]\nfov = 40   # wide\nposition = [0, 0,\n  5]\n\n[[light.point]]\nposition = [1, 2, 3]\n\
                        [[light.point]]\nposition = [4, 5, 6]\n[film]\n# the end\n";

    #[test]
    fn values_go_to_their_places_and_all_else_stays() {
        let mut draft = Draft::new(TEXT).expect("TOML");
        assert_eq!((draft.count("light.point"), draft.get("camera.fov")), (2, Some(Held::Number(40.0))));
        draft.set("camera.fov", "25.5").expect("a place");
        draft.set("camera.position", "[1, 1, 1]").expect("a place");
        draft.set("light.point[1].intensity", "2").expect("a place");
        draft.set("film.background", "\"#102030\"").expect("a place");
        draft.set("trace.depth", "3").expect("a place");
        let wanted = "# head\n[camera]\nfov = 25.5   # wide\nposition = [1, 1, 1]\n\n[[light.point]]\nposition = [1, 2, 3]\n\
                      [[light.point]]\nposition = [4, 5, 6]\nintensity = 2\n[film]\nbackground = \"#102030\"\n# the end\n\
                      \n[trace]\ndepth = 3\n";
        assert_eq!(draft.text(), wanted);
        assert_eq!(draft.get("trace.depth"), Some(Held::Number(3.0)));
        assert_eq!(draft.edits().len(), 5);
    }

    #[test]
    fn what_has_no_place_changes_nothing() {
        let mut draft = Draft::new(TEXT).expect("TOML");
        for (place, value) in
            [("light.point[2].intensity", "1"), ("camera.fov", "= 3"), ("camera.fov.x", "3"), ("", "1")]
        {
            draft.set(place, value).expect_err(place);
        }
        assert_eq!(draft.text(), TEXT);
    }
}
