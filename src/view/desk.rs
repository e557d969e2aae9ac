//! what is looked at, how, and what was done to it: all that a window would lose

mod out;
mod undo;

use std::path::{Path, PathBuf};

use glam::{Vec2, Vec3};

use super::eye::Eye as _;
use super::history::History;
use super::keys::Command;
use crate::render::live::{Side, Wish};
use crate::scene::{Camera, Draft, Error, Held, Method, Reach, Scene, Show, Source};
use undo::State;

/// What is looked at, and how.
#[derive(Debug)]
pub struct Desk {
    source: Source,
    /// The text that the file holds, as far as is known.
    file: String,
    /// With the camera as it stands now.
    scene: Scene,
    home: Camera,
    /// What was put in by hand when it was opened.
    given: Vec<(String, String)>,
    method: Method,
    side: Side,
    now: State,
    history: History<State>,
    /// What was there before the drag in hand.
    held: Option<State>,
}

/// What one does with the hand that is on the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Hand {
    /// Turns the eye about the pivot.
    Orbit(Vec2),
    /// Moves it sideways.
    Pan(Vec2),
    /// Looks around.
    Turn(Vec2),
    /// Flies: right, up and forward, in shares of the distance to the pivot.
    Fly(Vec3),
    /// Goes nearer to what is under a place of the picture, or away from it.
    Dolly(Vec2, f32),
}

impl Desk {
    /// A scene file or a model, with values put in by hand: the place of each, and the value in TOML.
    ///
    /// # Errors
    /// If it cannot be read, or is no scene with these values.
    pub fn open(path: &Path, edits: &[(String, String)], reach: &Reach) -> Result<Self, Error> {
        let read = Source::open(path, &[], reach)?;
        let wrong = |why: String| Error::Read { path: path.to_owned(), why };
        let mut draft = Draft::new(read.text()).map_err(wrong)?;
        for (place, value) in edits {
            draft.set(place, value).map_err(wrong)?;
        }
        let source = read.again(draft.text().to_owned())?;
        let scene = source.scene(1)?;
        let (camera, method) = (scene.camera.clone(), scene.method);
        let now = State { pivot: camera.look_at, camera: camera.clone(), draft };
        let (file, history) = (read.text().to_owned(), History::default());
        let given = now.draft.edits().to_vec();
        Ok(Self { source, file, scene, home: camera, given, method, side: Side::Gpu, now, history, held: None })
    }

    /// The same with another method or backend.
    #[must_use]
    pub fn with(mut self, method: Option<Method>, side: Side) -> Self {
        (self.method, self.side) = (method.unwrap_or(self.method), side);
        self
    }

    /// The same scene read again: the eye stays where it is, and what is shown stays, as does what was put in by hand
    /// while it was read. Whether there was something to undo that cannot be undone any more, since the file holds another
    /// text than before.
    pub fn renew(&mut self, read: Self) -> bool {
        let edits = self.now.draft.edits();
        let read = if edits == read.now.draft.edits() { read } else { read.edited(edits) };
        let (camera, show) = (self.scene.camera.clone(), self.scene.raster.show);
        let at_home = camera == self.home;
        (self.source, self.home, self.scene) = (read.source, read.home, read.scene);
        self.now.draft = read.now.draft;
        self.scene.raster.show = show;
        if !at_home {
            self.scene.camera = camera;
        }
        self.holds(read.file)
    }

    /// The file's text with other values put in by hand; as it is, if it has no room for them.
    fn edited(self, edits: &[(String, String)]) -> Self {
        let put_in = || {
            let mut draft = Draft::new(&self.file).ok()?;
            edits.iter().try_for_each(|(place, value)| draft.set(place, value)).ok()?;
            let source = self.source.again(draft.text().to_owned()).ok()?;
            let scene = source.scene(1).ok()?;
            Some((draft, source, scene))
        };
        let Some((draft, source, scene)) = put_in() else { return self };
        Self { home: scene.camera.clone(), source, scene, now: State { draft, ..self.now }, ..self }
    }

    /// What was put in by hand is an edit that would be lost.
    #[must_use]
    pub fn with_unsaved_edits(mut self) -> Self {
        self.given.clear();
        self
    }

    /// The file that was opened.
    #[must_use]
    pub fn path(&self) -> &Path {
        self.source.path()
    }

    /// The files that it is made of.
    #[must_use]
    pub fn files(&self) -> Vec<PathBuf> {
        self.source.files(&self.scene)
    }

    /// The scene as it is seen.
    #[must_use]
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The text that is worked on.
    #[must_use]
    pub fn draft(&self) -> &Draft {
        &self.now.draft
    }

    /// The method in use.
    #[must_use]
    pub fn method(&self) -> Method {
        self.method
    }

    /// The backend in use.
    #[must_use]
    pub fn side(&self) -> Side {
        self.side
    }

    /// What the eye turns about.
    #[must_use]
    pub fn pivot(&self) -> Vec3 {
        self.now.pivot
    }

    /// Whether something would be lost if the window were gone.
    #[must_use]
    pub fn unsaved(&self) -> bool {
        self.now.draft.edits() != self.given || self.scene.camera != self.home
    }

    /// Turns about another point from now on, and looks at it.
    pub fn set_pivot(&mut self, pivot: Vec3) {
        self.leave();
        self.now.pivot = pivot;
        self.scene.camera.look(pivot);
    }

    /// Puts the eye somewhere else.
    pub fn set_camera(&mut self, camera: Camera) {
        self.leave();
        self.now.pivot = camera.look_at;
        self.scene.camera = camera;
    }

    /// A move of the hand; all moves and values until [`Desk::let_go`] are one step for undo.
    pub fn hand(&mut self, hand: Hand) {
        self.hold();
        let camera = &mut self.scene.camera;
        let pivot = &mut self.now.pivot;
        let before = camera.position;
        match hand {
            Hand::Orbit(drag) => camera.orbit(*pivot, drag),
            Hand::Turn(drag) => camera.turn(drag),
            Hand::Dolly(place, factor) => {
                let point = camera.under(*pivot, place);
                camera.dolly(point, factor);
                *pivot = point + (*pivot - point) * factor;
            }
            Hand::Pan(drag) => {
                camera.pan(*pivot, drag);
                *pivot += camera.position - before;
            }
            Hand::Fly(way) => {
                camera.fly(way * before.distance(*pivot).max(1e-3));
                *pivot += camera.position - before;
            }
        }
    }

    /// Puts a value into a field of the scene.
    ///
    /// # Errors
    /// A sentence, if there is no such field or the value is not right there; then all is as it was.
    pub fn set(&mut self, place: &str, value: &Held) -> Result<(), String> {
        self.hold();
        let mut draft = self.now.draft.clone();
        draft.set(place, &value.to_toml())?;
        self.take(draft).map_err(|error| error.to_string())
    }

    /// Sees what another draft says.
    fn take(&mut self, draft: Draft) -> Result<(), Error> {
        let source = self.source.again(draft.text().to_owned())?;
        let scene = source.scene(1)?;
        let (camera, show) = (self.scene.camera.clone(), self.scene.raster.show);
        (self.source, self.scene, self.now.draft) = (source, scene, draft);
        (self.scene.camera, self.scene.raster.show) = (camera, show);
        Ok(())
    }

    /// Does what a key says, if it is about what is seen.
    pub fn obey(&mut self, command: Command) {
        match command {
            Command::Show(show) => self.show(show),
            Command::SwitchMethod => {
                self.method = if self.method == Method::Raster { Method::Trace } else { Method::Raster };
            }
            Command::SwitchSide => self.side = if self.side == Side::Gpu { Side::Cpu } else { Side::Gpu },
            Command::From(side) => {
                self.leave();
                self.scene.camera.from(side);
            }
            Command::Reset => self.set_camera(self.home.clone()),
            Command::FrameAll => {
                self.leave();
                let [center, corner] = self.scene.bounds().unwrap_or([Vec3::ZERO, Vec3::ONE]);
                let [width, height] = self.scene.film.size.map(|side| side as f32);
                self.now.pivot = center;
                self.scene.camera.frame(center, center.distance(corner), width / height);
            }
            Command::Undo => self.undo(),
            Command::Redo => self.redo(),
            _ => {}
        }
    }

    /// What is shown instead of the picture is one method's.
    fn show(&mut self, show: Show) {
        self.scene.raster.show = show;
        self.method = show.method().unwrap_or(self.method);
    }

    /// What is to be seen in so many pixels at most: the film's own proportions, and never more pixels than it has.
    #[must_use]
    pub fn wish(&self, room: [f32; 2]) -> Wish {
        let mut scene = self.scene.clone();
        scene.film.size = fit(scene.film.size, room);
        Wish { scene, method: self.method, side: self.side, moving: self.held() }
    }
}

/// The most pixels, across and down, that a preview has.
const MOST: f32 = 2048.0;

/// A film's size in a room of so many pixels.
fn fit(film: [u32; 2], room: [f32; 2]) -> [u32; 2] {
    let film = film.map(|side| side as f32);
    let share = (room[0] / film[0]).min(room[1] / film[1]).min(MOST / film[0]).min(MOST / film[1]).min(1.0);
    film.map(|side| ((side * share).round() as u32).max(1))
}
