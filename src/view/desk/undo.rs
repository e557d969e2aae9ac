//! what is done to what is looked at -> steps, and the way back

use glam::Vec3;

use super::Desk;
use crate::scene::{Camera, Draft};

/// What undo brings back.
#[derive(Debug, Clone)]
pub(super) struct State {
    pub(super) camera: Camera,
    /// What the eye turns about.
    pub(super) pivot: Vec3,
    pub(super) draft: Draft,
}

impl PartialEq for State {
    fn eq(&self, other: &Self) -> bool {
        self.camera == other.camera && self.draft.text() == other.draft.text()
    }
}

impl Desk {
    fn state(&self) -> State {
        State { camera: self.scene.camera.clone(), ..self.now.clone() }
    }

    pub(super) fn leave(&mut self) {
        if self.held.is_none() {
            self.history.leave(self.state());
        }
    }

    pub(super) fn hold(&mut self) {
        if self.held.is_none() {
            self.held = Some(self.state());
        }
    }

    /// The hand is off: what it did is one step.
    pub fn let_go(&mut self) {
        if let Some(state) = self.held.take().filter(|state| *state != self.state()) {
            self.history.leave(state);
        }
    }

    /// Whether a hand is on something.
    #[must_use]
    pub fn held(&self) -> bool {
        self.held.is_some()
    }

    pub(super) fn undo(&mut self) {
        if let Some(state) = self.history.undo(self.state()) {
            self.bring_back(state);
        }
    }

    pub(super) fn redo(&mut self) {
        if let Some(state) = self.history.redo(self.state()) {
            self.bring_back(state);
        }
    }

    fn bring_back(&mut self, state: State) {
        // It was a scene once; only files that are gone since could say otherwise, and then the text stays as it is.
        let _ = self.take(state.draft);
        (self.scene.camera, self.now.pivot) = (state.camera, state.pivot);
    }

    /// The file holds this text from now on. If it is another, all steps are forgotten: each has the text that it was
    /// done to, and one that is undone and saved would write over what somebody else has written. Whether there were any.
    pub(super) fn holds(&mut self, text: String) -> bool {
        if text == self.file {
            return false;
        }
        self.file = text;
        if let Some(held) = &mut self.held {
            held.draft.clone_from(&self.now.draft);
        }
        self.history.forget()
    }
}
