//! a scene file and what is said beside it -> the Scene of each frame

use std::cell::RefCell;
use std::collections::HashMap;
use std::fs;
use std::io::Read as _;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use serde::Deserialize as _;
use toml::de::{DeTable, DeValue, Deserializer};

use super::alone::{alone, text};
use super::animate::{Edit, edits};
use super::error::Complaint;
use super::file::{Animation, File};
use super::maps::Read;
use super::model::{Confined, Limits, Model, Refusal};
use super::place::{Place, moved};
use super::resolve::Resolver;
use super::{Error, Scene};

/// The longest scene text; it is read whole.
const MOST_BYTES: u64 = 64 << 20;

/// What a text is called that the command line sets.
pub(super) const SET: &str = "--set";

/// What a scene may read and take, and where what is made of it may be kept.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Reach {
    /// Folders beside the scene's own in which its models and pictures may lie.
    pub search: Vec<PathBuf>,
    /// Bytes of memory for the film, for all faces, and for each model; without it 60 % of this machine's, and at most
    /// 8 GiB for a model.
    pub memory: Option<u64>,
    /// A folder in which the ray tracer's trees are kept for the next time; without it they are built each time.
    pub cache: Option<PathBuf>,
}

impl Reach {
    /// The folders that a scene may read from.
    pub(super) fn folder(&self, scene: &Path) -> Result<Confined, Refusal> {
        let (own, _) = Confined::around(scene)?;
        self.search.iter().try_fold(own, |folders, more| folders.and(more))
    }

    /// Bytes that may be taken: what is said, or 60 % of this machine's; a machine that will not tell is trusted.
    #[must_use]
    pub fn most(&self) -> u64 {
        self.memory.unwrap_or_else(|| {
            let has = sysinfo::System::new().map_or(0, |mut system| {
                system.refresh_memory();
                system.total_memory()
            });
            if has > 0 { has / 10 * 6 } else { u64::MAX }
        })
    }

    /// How much a model may ask for.
    pub(super) fn limits(&self) -> Limits {
        let usual = Limits::default();
        let memory = self.memory.map_or(usual.memory, |most| most.min(usual.memory));
        Limits { memory, ..usual }
    }
}

/// Models that were read, by the name that the scene calls them.
pub(super) type Models = RefCell<HashMap<String, Arc<Model>>>;

/// A scene file, read once, from which the scene of any frame can be had.
#[derive(Debug)]
pub struct Source {
    path: PathBuf,
    /// What the names in the text are relative to, as if it were this file.
    home: PathBuf,
    reach: Reach,
    text: String,
    sets: Vec<String>,
    models: Models,
    pictures: Read,
    animation: Option<Animation>,
    /// A model with no scene file.
    alone: Option<Box<Scene>>,
}

impl Source {
    /// Reads a scene file, or a model (`.obj`), which gets a camera, lights and a ground that fit it. `sets` are put
    /// into the file's document before it is understood: `camera.fov=40`, `light.directional[0].toward=[0, 1, 0]`.
    ///
    /// # Errors
    /// If the file cannot be read, or its text with what is set is not a scene.
    pub fn open(path: &Path, sets: &[String], reach: &Reach) -> Result<Self, Error> {
        if path.extension().is_some_and(|e| e.eq_ignore_ascii_case("obj")) {
            let (scene, home, name) = alone(path, reach)?;
            let mut source = Self::new(text(&scene, &name), path, sets, reach);
            // The name stands for a file beside which names are looked for.
            source.home = home.join("scene");
            source.models.borrow_mut().insert(name, Arc::clone(&scene.meshes[0].model));
            if sets.is_empty() {
                source.alone = Some(Box::new(scene));
            }
            return Ok(source);
        }
        Self::written(read(path)?, path, sets, reach)
    }

    fn written(text: String, path: &Path, sets: &[String], reach: &Reach) -> Result<Self, Error> {
        let mut source = Self::new(text, path, sets, reach);
        source.animation = source.file(&[], None)?.animation;
        Ok(source)
    }

    fn new(text: String, path: &Path, sets: &[String], reach: &Reach) -> Self {
        let (home, path, reach, sets) = (path.to_owned(), path.to_owned(), reach.clone(), sets.to_vec());
        Self {
            path,
            home,
            reach,
            text,
            sets,
            models: Models::default(),
            pictures: Read::default(),
            animation: None,
            alone: None,
        }
    }

    /// The same file with another text: models and pictures that were read are not read again.
    ///
    /// # Errors
    /// If the text with what is set is not a scene.
    pub fn again(&self, text: String) -> Result<Self, Error> {
        let mut source = Self::new(text, &self.path, &self.sets, &self.reach);
        source.home.clone_from(&self.home);
        source.models.clone_from(&self.models);
        source.pictures.clone_from(&self.pictures);
        source.animation = source.file(&[], None)?.animation;
        Ok(source)
    }

    /// The text of the file as it was read; of a model alone what a file would say.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The file itself and all that its scene reads, as far as it was found.
    #[must_use]
    pub fn files(&self, scene: &Scene) -> Vec<PathBuf> {
        let folder = self.home.parent().unwrap_or(Path::new(""));
        let models = self.models.borrow();
        let pictures = scene.meshes.iter().flat_map(|mesh| &mesh.model.textures).chain(&scene.textures);
        let pictures = pictures.map(|picture| folder.join(&picture.file));
        // A model's materials lie beside it, by its own name as a rule.
        let models = models.keys().flat_map(|name| [folder.join(name), folder.join(name).with_extension("mtl")]);
        let all = models.chain(pictures).chain([self.path.clone()]);
        all.filter(|file| file.is_file()).collect()
    }

    /// Where the text is kept: its file, or for a model alone a new one beside the folder that it lies in.
    #[must_use]
    pub fn keeps(&self) -> PathBuf {
        if self.home == self.path {
            return self.path.clone();
        }
        self.home.with_file_name(self.path.with_extension("toml").file_name().unwrap_or_default())
    }

    /// The file, as it was called.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// How many frames it has, and how many of them a second; nothing if it has no animation.
    #[must_use]
    pub fn frames(&self) -> Option<(u32, f32)> {
        self.animation.as_ref().map(|animation| (animation.frames.0, animation.rate.0))
    }

    /// The scene of a frame; without an animation that of all frames.
    ///
    /// # Errors
    /// If what the animation puts in is not right there, or what the scene names cannot be read.
    pub fn scene(&self, frame: i64) -> Result<Scene, Error> {
        self.resolved(frame, false)
    }

    /// The same, however large its film is: for who gives it another size.
    ///
    /// # Errors
    /// As [`scene`](Self::scene), but for the film's size.
    pub fn scene_to_resize(&self, frame: i64) -> Result<Scene, Error> {
        self.resolved(frame, true)
    }

    fn resolved(&self, frame: i64, any_size: bool) -> Result<Scene, Error> {
        if let Some(scene) = &self.alone {
            return Ok((**scene).clone());
        }
        let edits = match &self.animation {
            None => Vec::new(),
            Some(animation) => {
                let document = self.document(&[], None)?;
                edits(animation, &document, frame).map_err(|(span, why)| self.complain(span, &why, Some(frame)))?
            }
        };
        let file = self.file(&edits, Some(frame))?;
        let complain = |span: Range<usize>, right: &str| self.complain(span, right, Some(frame));
        Resolver {
            complain: &complain,
            name: &self.home,
            reach: &self.reach,
            any_size,
            models: &self.models,
            pictures: &self.pictures,
        }
        .scene(&file)
    }

    /// The document with what is set and what a frame changes.
    fn document<'t>(&'t self, edits: &'t [Edit], frame: Option<i64>) -> Result<DeTable<'t>, Error> {
        let Self { text, sets, .. } = self;
        let wrong = |from: usize| {
            move |e: toml::de::Error| {
                let span = e.span().unwrap_or(0..0);
                self.complain(span.start + from..span.end + from, e.message().trim(), frame)
            }
        };
        let mut document = DeTable::parse(text).map_err(wrong(0))?.into_inner();
        let mut from = text.len() + 1;
        for set in sets {
            let refuse = |why: String| self.complain(from..from + set.len(), &why, frame);
            let (place, value) =
                set.split_once('=').ok_or_else(|| refuse("what is set is written as camera.fov=40".to_owned()))?;
            let start = from + set.len() - value.trim_start().len();
            let place = Place::parse(place).map_err(&refuse)?;
            let value = value.trim();
            // A shell takes quotes away: what is a word, a name or a color, and no TOML, is text.
            let value = DeValue::parse(value).or_else(|why| as_text(value).ok_or(why)).map_err(wrong(start))?;
            let value = moved(value, &|span| span.start + start..span.end + start);
            place.set(&mut document, value).map_err(&refuse)?;
            from += set.len() + 1;
        }
        for edit in edits {
            let value = DeValue::parse(&edit.text).map_err(wrong(0))?;
            let value = moved(value, &|_| edit.span.clone());
            edit.place.set(&mut document, value).map_err(|why| self.complain(edit.span.clone(), &why, frame))?;
        }
        Ok(document)
    }

    fn file(&self, edits: &[Edit], frame: Option<i64>) -> Result<File, Error> {
        let document = toml::Spanned::new(0..0, self.document(edits, frame)?);
        File::deserialize(Deserializer::from(document))
            .map_err(|e| self.complain(e.span().unwrap_or(0..0), e.message().trim(), frame))
    }

    /// What is wrong: spans beyond the file's end are those of what is set, one text after the other with a byte between.
    fn complain(&self, span: Range<usize>, right: &str, frame: Option<i64>) -> Error {
        let mut from = self.text.len() + 1;
        for set in self.sets.iter().filter(|_| span.end > self.text.len()) {
            let end = from + set.len();
            if span.start <= end {
                let within = span.start.saturating_sub(from)..span.end.saturating_sub(from);
                let mut complaint = Complaint::new(SET.into(), set, within, right);
                set.split('=').next().unwrap_or_default().trim().clone_into(&mut complaint.field);
                return Error::Text(Box::new(complaint));
            }
            from = end + 1;
        }
        let mut complaint = Complaint::new(self.path.clone(), &self.text, span, right);
        if let Some(frame) = frame.filter(|_| complaint.field.starts_with("animation")) {
            complaint.message = format!("{} (in frame {frame})", complaint.message);
        }
        Error::Text(Box::new(complaint))
    }
}

/// Reads a scene file, or a model alone; of an animation the first frame.
///
/// # Errors
/// If the file cannot be read, or its text is not a scene.
pub fn load(path: &Path) -> Result<Scene, Error> {
    Source::open(path, &[], &Reach::default())?.scene(1)
}

/// Reads a scene from text; `name` is what errors call it. Of an animation it is the first frame.
///
/// # Errors
/// If the text is not a scene.
pub fn parse(text: &str, name: &Path) -> Result<Scene, Error> {
    Source::written(text.to_owned(), name, &[], &Reach::default())?.scene(1)
}

/// A word without its quotes.
fn as_text(value: &str) -> Option<toml::Spanned<DeValue<'_>>> {
    let first = value.starts_with(|c: char| c.is_ascii_alphabetic() || c == '#');
    let word = first && value.chars().all(|c| c.is_ascii_alphanumeric() || "#_-./".contains(c));
    word.then(|| toml::Spanned::new(0..value.len(), DeValue::String(value.into())))
}

fn read(path: &Path) -> Result<String, Error> {
    let failed = |why: String| Error::Read { path: path.to_owned(), why };
    let about = fs::metadata(path).map_err(|e| failed(e.to_string()))?;
    // A pipe would wait for ever, and /dev/zero never ends.
    if !about.is_file() {
        return Err(failed("it is not a file".to_owned()));
    }
    let mut bytes = Vec::new();
    let file = fs::File::open(path).map_err(|e| failed(e.to_string()))?;
    file.take(MOST_BYTES + 1).read_to_end(&mut bytes).map_err(|e| failed(e.to_string()))?;
    if bytes.len() as u64 > MOST_BYTES {
        return Err(failed("it is longer than 64 MiB".to_owned()));
    }
    String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        let line = error.as_bytes()[..at].split(|&b| b == b'\n').count();
        failed(format!("line {line} is not UTF-8 text; save it as UTF-8"))
    })
}
