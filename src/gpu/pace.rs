//! how long the last slice took -> how large the next one is

use std::time::Duration;

use crate::tables::MOST_TURNS;

/// The size of a slice of work: rounds of all stages, loop turns in a round, pixels in hand.
#[derive(Debug, Clone)]
pub(super) struct Pace {
    /// How long a slice may take.
    target: Duration,
    pub(super) rounds: u32,
    pub(super) budget: u32,
    pub(super) pixels: u32,
    warm: bool,
    tries: u32,
}

const FIRST_BUDGET: u32 = 100;
/// Passes in one submission: macOS has been seen to freeze at 683.
const MOST_ROUNDS: u32 = 20;
const LEAST_BUDGET: u32 = 64;
const LEAST_PIXELS: u32 = 1024;

impl Pace {
    pub(super) fn new(target: Duration, pixels: u32) -> Self {
        Self { target, rounds: 1, budget: FIRST_BUDGET, pixels, warm: false, tries: 3 }
    }

    /// Small steps up, large ones down: a slice that is too long may cost the device.
    pub(super) fn learn(&mut self, took: Duration) {
        if !self.warm {
            // A kernel is compiled at its first dispatch on lavapipe: 27 ms that say nothing.
            self.warm = true;
            return;
        }
        if took > self.target {
            if self.rounds > 1 {
                self.rounds = (self.rounds / 2).max(1);
            } else if self.budget > LEAST_BUDGET {
                self.budget = (self.budget / 2).max(LEAST_BUDGET);
            } else {
                self.pixels = (self.pixels / 2).max(LEAST_PIXELS);
            }
        } else if took * 3 < self.target * 2 {
            if self.budget < MOST_TURNS {
                self.budget = (self.budget * 3 / 2).min(MOST_TURNS);
            } else {
                self.rounds = (self.rounds + self.rounds.div_ceil(2)).min(MOST_ROUNDS);
            }
        }
    }

    /// Smaller slices after a failure; false once that has been tried often enough.
    pub(super) fn ease(&mut self) -> bool {
        if self.tries == 0 {
            return false;
        }
        self.tries -= 1;
        self.rounds = 1;
        self.budget = (self.budget / 4).max(LEAST_BUDGET);
        self.pixels = (self.pixels / 4).max(LEAST_PIXELS);
        true
    }
}
