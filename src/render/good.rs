//! what is asked of a traced picture -> when it is good enough

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use crate::film::{Band, Watch};
use crate::tables::Tables;
use crate::trace::{Part, Trace, Until, bands, passes};

/// When a traced picture is good enough: once its time is used, and a tile once its error is low enough.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Good {
    /// How long it may take.
    pub time: Option<Duration>,
    /// The error of a tile of 16 x 16 pixels, in linear light.
    pub noise: Option<f32>,
}

impl Good {
    /// A part of a frame, so many rows at a time from the top, and all at once if more is asked.
    pub(super) fn trace<T: Trace>(
        self,
        stages: &mut T,
        tables: &Tables,
        wanted: &Part,
        height: u32,
        watch: &mut dyn Watch,
        each: &mut dyn FnMut(Band) -> ControlFlow<()>,
    ) -> Result<(), T::Error> {
        let Self { time, noise } = self;
        if time.is_none() && noise.is_none() {
            return bands(stages, tables, wanted, height, watch, each);
        }
        let start = Instant::now();
        let spent = || time.map_or(0.0, |time| start.elapsed().as_secs_f64() / time.as_secs_f64().max(1e-9));
        if let Some(film) = passes(stages, tables, wanted, watch, &Until { spent: &spent, noise })? {
            let _ = each(Band { top: 0, film });
        }
        Ok(())
    }
}
