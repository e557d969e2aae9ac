//! Ctrl-C, SIGTERM and the deadline -> whether to go on

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

use crate::job::Failure;

/// What may end the work before it is done.
#[derive(Debug, Clone)]
pub(crate) struct Stop {
    signal: Arc<AtomicUsize>,
    deadline: Option<Instant>,
}

impl Stop {
    /// From now on the first signal is noted, and the second ends the process at once: pictures are whole or not
    /// there, so that is safe.
    pub(crate) fn new(deadline: Option<Duration>) -> std::io::Result<Self> {
        let signal = Arc::new(AtomicUsize::new(0));
        let again = Arc::new(AtomicBool::new(false));
        for number in [SIGINT, SIGTERM] {
            flag::register_conditional_shutdown(number, 128 + number, Arc::clone(&again))?;
            flag::register_usize(number, Arc::clone(&signal), number as usize)?;
            flag::register(number, Arc::clone(&again))?;
        }
        Ok(Self { signal, deadline: deadline.and_then(|time| Instant::now().checked_add(time)) })
    }

    /// Why to stop, if there is a reason.
    pub(crate) fn why(&self) -> Option<Failure> {
        match self.signal.load(Ordering::Relaxed) {
            0 if self.deadline.is_some_and(|deadline| Instant::now() >= deadline) => Some(Failure::Deadline),
            0 => None,
            signal => Some(Failure::Signal(signal as u8)),
        }
    }
}

/// Reads `90`, `90s`, `15m` and `1.5h`.
pub(crate) fn time(text: &str) -> Result<Duration, String> {
    let (number, unit) = match text.strip_suffix(['s', 'm', 'h']) {
        Some(number) => (number, &text[number.len()..]),
        None => (text, "s"),
    };
    let seconds = match unit {
        "m" => 60.0,
        "h" => 3600.0,
        _ => 1.0,
    };
    let time = number.parse::<f64>().ok().and_then(|number| Duration::try_from_secs_f64(number * seconds).ok());
    time.ok_or_else(|| "a time is written as 90 (seconds), 90s, 15m or 1.5h".to_owned())
}
