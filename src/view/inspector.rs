//! a pixel -> what made it, and where in the scene it is, told beside the window

use std::sync::mpsc::{Receiver, Sender, channel};

use glam::Vec3;

use super::overlay::{Line, lines};
use crate::cpu::first::first;
use crate::explain::Explainer;
use crate::prepare::{pose, prepare, room};
use crate::scene::{Method, Reach, Scene};

/// A question about a pixel of what is seen.
#[derive(Debug, Clone)]
pub struct Question {
    /// As it is seen, with the size of the picture.
    pub scene: Scene,
    /// How it is rendered.
    pub method: Method,
    /// Column and row, from the upper left.
    pub pixel: [u32; 2],
    /// What an answer may take.
    pub reach: Reach,
    /// Whether the point that is seen is wanted, or all that made the pixel.
    pub point: bool,
}

/// An answer.
#[derive(Debug, Clone)]
pub enum Answer {
    /// All that made the pixel, or why that cannot be told; and what of it is drawn over the picture.
    Text([u32; 2], String, Vec<Line>),
    /// What is seen there; nothing if it is the background; or why that cannot be told.
    Point(Result<Option<Vec3>, String>),
}

/// One who answers beside the window: the last question of those that wait.
#[derive(Debug)]
pub struct Inspector {
    questions: Sender<Question>,
    answers: Receiver<Answer>,
}

impl Inspector {
    /// Waits for questions; `wake` is called after each answer.
    #[must_use]
    pub fn new(wake: super::worker::Wake) -> Self {
        let (questions, asked) = channel::<Question>();
        let (tell, answers) = channel();
        std::thread::spawn(move || {
            let mut kept: Option<(Scene, Method, Explainer)> = None;
            while let Ok(mut question) = asked.recv() {
                while let Ok(newer) = asked.try_recv() {
                    // A wish for a point is a click, and no hover drops it.
                    question = if question.point && !newer.point { question } else { newer };
                }
                let answer =
                    if question.point { Answer::Point(pick(&question)) } else { explain(&question, &mut kept) };
                if tell.send(answer).is_err() {
                    return;
                }
                wake();
            }
        });
        Self { questions, answers }
    }

    /// Asks; nobody waits for the answer.
    pub fn ask(&self, question: Question) {
        // One who answers no more is one whose last answer stays.
        let _ = self.questions.send(question);
    }

    /// The next answer, if there is one.
    #[must_use]
    pub fn answer(&self) -> Option<Answer> {
        self.answers.try_recv().ok()
    }
}

fn explain(question: &Question, kept: &mut Option<(Scene, Method, Explainer)>) -> Answer {
    let Question { scene, method, pixel, reach, .. } = question;
    if !kept.as_ref().is_some_and(|(known, how, _)| known.is(scene) && how == method) {
        match Explainer::new(scene, *method, reach) {
            Ok(explainer) => *kept = Some((scene.clone(), *method, explainer)),
            Err(why) => return Answer::Text(*pixel, why.to_string(), Vec::new()),
        }
    }
    let told = kept.as_ref().map(|(_, _, explainer)| explainer.pixel(*pixel));
    match told {
        Some(Ok(told)) => Answer::Text(*pixel, told.to_string(), lines(scene, &told)),
        Some(Err(why)) => Answer::Text(*pixel, why.to_string(), Vec::new()),
        None => Answer::Text(*pixel, String::new(), Vec::new()),
    }
}

fn pick(Question { scene, pixel: [x, y], reach, .. }: &Question) -> Result<Option<Vec3>, String> {
    // Whatever is shown, it is a ray that asks.
    room::within(scene, Method::Trace, reach).map_err(|why| why.to_string())?;
    let tables = prepare(scene);
    let [x, y] = [*x.min(&(tables.view.width - 1)), *y.min(&(tables.view.height - 1))];
    let depth = first(&tables, x..x + 1, y..y + 1)[0].depth;
    let [right, up, back] = pose(&scene.camera);
    let high = 2.0 * (scene.camera.fov / 2.0).tan();
    let [width, height] = [tables.view.width as f32, tables.view.height as f32];
    let wide = high * scene.camera.aspect.unwrap_or(width / height);
    let across = (x as f32 + 0.5) / width - 0.5;
    let down = (y as f32 + 0.5) / height - 0.5;
    let way = right * (across * wide) - up * (down * high) - back;
    Ok(depth.is_finite().then(|| scene.camera.position + way * depth))
}
