//! a wish -> pictures of it, made beside the window in portions; a newer wish ends the work on an older one

use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use crate::gpu::wgsl::Sources;
use crate::gpu::{Gpu, Screen, StageTime};
use crate::render::live::{LightMap, Live, Progress, Wish};
use crate::scene::Reach;

/// What the worker is asked for.
#[derive(Debug, Clone)]
pub struct Order {
    /// What is to be seen.
    pub wish: Wish,
    /// Kernels; others than the last ones make everything anew.
    pub sources: Arc<Sources>,
    /// What it may take.
    pub reach: Reach,
    /// What else is to be told.
    pub inside: Inside,
}

/// What is told of a picture beside it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Inside {
    /// How long each stage took on the GPU.
    pub times: bool,
    /// What the lights see.
    pub lights: bool,
}

/// What the worker says.
#[derive(Debug, Clone, Default)]
pub struct Report {
    /// The last good picture.
    pub screen: Option<Arc<Screen>>,
    /// How far it is.
    pub progress: Progress,
    /// Pictures that were shown, all in all.
    pub pictures: u64,
    /// From a wish to its first picture.
    pub first: Duration,
    /// Of the last picture.
    pub took: Duration,
    /// How long each stage took for the last picture, on the GPU.
    pub times: Vec<StageTime>,
    /// What the lights see.
    pub lights: Arc<Vec<LightMap>>,
    /// What was wrong on the way to the last picture, a sentence each.
    pub notes: Vec<String>,
    /// Why there is no picture of the last wish.
    pub error: Option<String>,
    /// What share of a tree is built, while one is.
    pub building: Option<f64>,
    /// Whether it is at work.
    pub busy: bool,
}

#[derive(Debug, Default)]
struct Desk {
    order: Option<Order>,
    report: Report,
    over: bool,
}

#[derive(Debug, Default)]
struct Shared {
    desk: Mutex<Desk>,
    bell: Condvar,
}

impl Shared {
    fn desk(&self) -> MutexGuard<'_, Desk> {
        self.desk.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// One who makes pictures beside the window.
#[derive(Debug)]
pub struct Worker {
    shared: Arc<Shared>,
}

/// Called whenever there is something new to see.
pub type Wake = Box<dyn Fn() + Send + Sync>;

impl Worker {
    /// Begins to wait for orders.
    #[must_use]
    pub fn new(gpu: Arc<Gpu>, wake: Wake) -> Self {
        let shared = Arc::new(Shared::default());
        let theirs = Arc::clone(&shared);
        std::thread::spawn(move || {
            while !theirs.desk().over {
                // What panics here has its sentence in the report, and the window stays.
                let work = catch_unwind(AssertUnwindSafe(|| work(&theirs, &gpu, &wake)));
                if work.is_err() {
                    theirs.desk().report.error =
                        Some("the picture could not be made: a fault of Twinlight's".to_owned());
                    wake();
                }
            }
        });
        Self { shared }
    }

    /// Asks for something; what was asked for before is dropped.
    pub fn ask(&self, order: Order) {
        self.shared.desk().order = Some(order);
        self.shared.bell.notify_one();
    }

    /// What there is to say.
    #[must_use]
    pub fn report(&self) -> Report {
        self.shared.desk().report.clone()
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        self.shared.desk().over = true;
        self.shared.bell.notify_one();
    }
}

/// Waits for an order while there is nothing to do; whether the window is still there.
fn next(shared: &Shared, idle: bool, order: &mut Option<Order>) -> bool {
    let mut desk = shared.desk();
    while idle && desk.order.is_none() && !desk.over {
        desk = shared.bell.wait(desk).unwrap_or_else(PoisonError::into_inner);
    }
    *order = desk.order.take();
    !desk.over
}

/// How often the share of a tree is shown.
const EVERY: Duration = Duration::from_millis(100);

/// Puts into the report how much of a wish's tree is built, until something else is wished for. That the eye moves
/// meanwhile is no reason to begin again.
fn telling(shared: &Shared, wake: &Wake, wish: &Wish) -> impl Fn(f64) -> ControlFlow<()> + Sync {
    let shown = Mutex::new(Instant::now());
    move |share| {
        let mut desk = shared.desk();
        desk.report.building = Some(share);
        let other =
            |order: &Order| order.wish.method != wish.method || !order.wish.scene.has_the_things_of(&wish.scene);
        let over = desk.over || desk.order.as_ref().is_some_and(other);
        drop(desk);
        let mut shown = shown.lock().unwrap_or_else(PoisonError::into_inner);
        if shown.elapsed() > EVERY {
            *shown = Instant::now();
            wake();
        }
        if over { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

fn work(shared: &Shared, gpu: &Gpu, wake: &Wake) {
    let mut live: Option<Live<'_>> = None;
    let mut sources = Arc::new(Sources::default());
    let mut screen: Option<Arc<Screen>> = None;
    let (mut asked, mut first) = (Instant::now(), true);
    let mut last = Instant::now();
    let mut size = [1; 2];
    let (mut inside, mut lit) = (Inside::default(), 0);
    loop {
        let idle = live.as_ref().is_none_or(Live::done);
        if idle {
            shared.desk().report.busy = false;
            wake();
        }
        let mut order = None;
        if !next(shared, idle, &mut order) {
            return;
        }
        let stepped = (|| {
            if let Some(order) = order {
                shared.desk().report.busy = true;
                (asked, first, last) = (Instant::now(), true, Instant::now());
                size = order.wish.scene.film.size;
                let more = order.inside != inside && order.inside != Inside::default();
                inside = order.inside;
                gpu.measure(inside.times);
                let same = Arc::ptr_eq(&sources, &order.sources);
                let aimed = same && live.as_mut().map_or(Ok(false), |live| live.aim(&order.wish))?;
                if !aimed {
                    // What is large is given back before its like is taken; what is shown stays the window's.
                    live = None;
                    if !same {
                        screen = None;
                    }
                    sources = order.sources;
                    let told = telling(shared, wake, &order.wish);
                    let ready = Live::watched(gpu, &sources, order.wish.clone(), &order.reach, &told);
                    shared.desk().report.building = None;
                    live = Some(ready?);
                } else if let Some(live) = live.as_mut().filter(|_| more) {
                    // What is told of is a picture's making.
                    lit = 0;
                    live.again()?;
                }
            }
            let Some(live) = &mut live else { return Ok(()) };
            if !live.step()? {
                return Ok(());
            }
            if screen.as_ref().is_none_or(|screen| screen.size() != size) {
                screen = Some(Arc::new(Screen::new(gpu, &sources, size)?));
            }
            if let Some(screen) = &screen {
                live.show(screen)?;
            }
            let times = gpu.times();
            let lights = if inside.lights { live.lights(&mut lit)? } else { None };
            let mut desk = shared.desk();
            let report = &mut desk.report;
            report.screen.clone_from(&screen);
            report.progress = live.progress();
            report.pictures += 1;
            report.took = last.elapsed();
            report.error = None;
            report.notes = live.notes().to_vec();
            report.times = times;
            if let Some(lights) = lights {
                report.lights = Arc::new(lights);
            }
            last = Instant::now();
            if std::mem::take(&mut first) {
                report.first = asked.elapsed();
            }
            drop(desk);
            wake();
            Ok::<(), crate::render::Error>(())
        })();
        if let Err(error) = stepped {
            live = None;
            // Who stopped it has another order.
            if !matches!(error, crate::render::Error::Stopped) {
                shared.desk().report.error = Some(error.to_string());
            }
            wake();
        }
    }
}
