//! what was done -> what was there before it, and what was taken back

/// States that are remembered.
const MOST: usize = 200;

/// What can be taken back.
#[derive(Debug, Clone)]
pub struct History<T> {
    before: Vec<T>,
    after: Vec<T>,
}

impl<T> Default for History<T> {
    fn default() -> Self {
        Self { before: Vec::new(), after: Vec::new() }
    }
}

impl<T: PartialEq> History<T> {
    /// Remembers a state that is about to be left. What was taken back before is forgotten.
    pub fn leave(&mut self, state: T) {
        self.after.clear();
        if self.before.last() != Some(&state) {
            self.before.push(state);
        }
        if self.before.len() > MOST {
            self.before.remove(0);
        }
    }

    /// The state before `now`.
    pub fn undo(&mut self, now: T) -> Option<T> {
        let state = self.before.pop()?;
        self.after.push(now);
        Some(state)
    }

    /// Forgets all states; whether there were any.
    pub fn forget(&mut self) -> bool {
        let any = !(self.before.is_empty() && self.after.is_empty());
        *self = Self::default();
        any
    }

    /// The state that was taken back.
    pub fn redo(&mut self, now: T) -> Option<T> {
        let state = self.after.pop()?;
        self.before.push(now);
        Some(state)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_taken_back_comes_again_until_something_else_is_done() {
        let mut history = History::default();
        history.leave(1);
        history.leave(2);
        assert_eq!((history.undo(3), history.undo(2), history.undo(1)), (Some(2), Some(1), None));
        assert_eq!((history.redo(1), history.redo(2), history.redo(3)), (Some(2), Some(3), None));
        assert_eq!(history.undo(3), Some(2));
        history.leave(2);
        assert_eq!(history.redo(9), None);
    }
}
