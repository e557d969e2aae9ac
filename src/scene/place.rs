//! `light.directional[0].toward` -> that value of a scene's document

use std::borrow::Cow;
use std::fmt;
use std::ops::Range;

use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

/// A value with the bytes of the text that it stands in.
pub(super) type Value<'t> = Spanned<DeValue<'t>>;

/// Where a value stands in a scene: fields with dots between them, entries of lists counted from 0.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Place(Vec<Step>);

#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Step {
    Field(String),
    Entry(usize),
}

/// What would be right.
const RIGHT: &str = "a field is written as camera.fov or light.directional[0].toward";
/// The format itself is six deep.
const DEEPEST: usize = 16;

impl Place {
    /// Reads it.
    pub(super) fn parse(text: &str) -> Result<Self, String> {
        let wrong = || format!("{text:?} is no field; {RIGHT}");
        let mut steps = Vec::new();
        for part in text.trim().split('.') {
            let (name, mut entries) = part.split_at(part.find('[').unwrap_or(part.len()));
            let bare = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
            if name.is_empty() || !name.chars().all(bare) {
                return Err(wrong());
            }
            steps.push(Step::Field(name.to_owned()));
            while let Some(rest) = entries.strip_prefix('[') {
                let (number, rest) = rest.split_once(']').ok_or_else(wrong)?;
                steps.push(Step::Entry(number.parse().map_err(|_| wrong())?));
                entries = rest;
            }
            if !entries.is_empty() || steps.len() > DEEPEST {
                return Err(wrong());
            }
        }
        Ok(Self(steps))
    }

    /// The value that a way leads to.
    pub(super) fn of(steps: &[Step]) -> Self {
        Self(steps.to_vec())
    }

    /// The way to it from the outermost table.
    pub(super) fn steps(&self) -> &[Step] {
        &self.0
    }

    /// The value that stands there.
    pub(super) fn get<'a, 't>(&self, document: &'a DeTable<'t>) -> Option<&'a Value<'t>> {
        let mut steps = self.0.iter();
        let Some(Step::Field(first)) = steps.next() else { return None };
        let mut value = document.get(first.as_str())?;
        for step in steps {
            value = match (step, value.get_ref()) {
                (Step::Field(name), DeValue::Table(table)) => table.get(name.as_str())?,
                (Step::Entry(i), DeValue::Array(list)) => list.get(*i)?,
                _ => return None,
            };
        }
        Some(value)
    }

    /// Puts a value there; tables on the way are made where there are none.
    pub(super) fn set<'t>(&self, document: &mut DeTable<'t>, value: Value<'t>) -> Result<(), String> {
        let Some((Step::Field(first), rest)) = self.0.split_first() else { return Err(RIGHT.to_owned()) };
        self.put(document, first, rest, value)
    }

    fn put<'t>(&self, table: &mut DeTable<'t>, name: &str, rest: &[Step], value: Value<'t>) -> Result<(), String> {
        if rest.is_empty() {
            let key = Spanned::new(value.span(), Cow::Owned(name.to_owned()));
            table.insert(key, value);
            return Ok(());
        }
        if !table.contains_key(name) {
            let key = Spanned::new(value.span(), Cow::Owned(name.to_owned()));
            table.insert(key, Spanned::new(value.span(), DeValue::Table(DeTable::new())));
        }
        match table.get_mut(name) {
            Some(inner) => self.descend(inner, rest, value),
            None => Err(RIGHT.to_owned()),
        }
    }

    fn descend<'t>(&self, inner: &mut Value<'t>, rest: &[Step], value: Value<'t>) -> Result<(), String> {
        match (inner.get_mut(), rest) {
            (DeValue::Table(table), [Step::Field(name), rest @ ..]) => self.put(table, name, rest, value),
            (DeValue::Array(list), [Step::Entry(i), rest @ ..]) => {
                let count = list.len();
                let entry = list.get_mut(*i);
                let entry = entry.ok_or_else(|| format!("{self}: entries go from 0 to below {count} here"))?;
                if rest.is_empty() {
                    *entry = value;
                    return Ok(());
                }
                self.descend(entry, rest, value)
            }
            (DeValue::Array(_), _) => Err(format!("{self}: a list's entries are called [0], [1] and so on")),
            (other, _) => Err(format!("{self}: there is a {} on the way to it", other.type_str())),
        }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, step) in self.0.iter().enumerate() {
            match step {
                Step::Field(name) if i == 0 => f.write_str(name)?,
                Step::Field(name) => write!(f, ".{name}")?,
                Step::Entry(number) => write!(f, "[{number}]")?,
            }
        }
        Ok(())
    }
}

/// A value that stands elsewhere: every span in it goes through `to`.
pub(super) fn moved<'t>(value: Value<'t>, to: &dyn Fn(Range<usize>) -> Range<usize>) -> Value<'t> {
    let span = to(value.span());
    let value = match value.into_inner() {
        DeValue::Array(list) => {
            let list: DeArray<'t> = list.into_iter().map(|entry| moved(entry, to)).collect();
            DeValue::Array(list)
        }
        DeValue::Table(table) => {
            let mut all = DeTable::new();
            for (key, value) in table {
                all.insert(Spanned::new(to(key.span()), key.into_inner()), moved(value, to));
            }
            DeValue::Table(all)
        }
        plain => plain,
    };
    Spanned::new(span, value)
}
