//! why a command did not do what was asked -> a sentence and an exit code

use std::process::ExitCode;

use twinlight::prepare::room;
use twinlight::scene::Error as SceneError;
use twinlight::{explain, film, gpu, render, scene};

/// Why a command did not do what was asked; its exit code hangs on it.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Failure {
    #[error(transparent)]
    Scene(#[from] scene::Error),
    #[error(transparent)]
    Film(#[from] film::Error),
    #[error(transparent)]
    Render(#[from] render::Error),
    #[error(transparent)]
    Gpu(#[from] gpu::Error),
    #[error(transparent)]
    Sizes(#[from] film::compare::Sizes),
    #[error("cannot write to stdout: {0}")]
    Stdout(#[from] std::io::Error),
    #[error(transparent)]
    Merge(film::merge::Misfit),
    #[error(transparent)]
    Explain(#[from] explain::Error),
    #[error("{0}: cannot read the part: {1}")]
    Part(String, std::io::Error),
    #[cfg(feature = "viewer")]
    #[error("the window cannot be opened: {0}; `twinlight render SCENE` needs none")]
    Window(String),
    #[error("{0}")]
    Usage(String),
    #[error(
        "the deadline has passed; pictures that were finished are there, and the same command goes on from there"
    )]
    Deadline,
    #[error("stopped; pictures that were finished are there, and the same command goes on from there")]
    Signal(u8),
}

impl Failure {
    /// Of `twinlight --help`'s table.
    pub(crate) fn code(&self) -> ExitCode {
        ExitCode::from(match self {
            Self::Scene(SceneError::Text(complaint)) if complaint.memory => 6,
            Self::Scene(SceneError::Text(complaint)) if complaint.of_command_line() => 2,
            Self::Scene(SceneError::Memory { .. })
            | Self::Gpu(gpu::Error::NoRoom { .. })
            | Self::Render(
                render::Error::Room(room::Error::Memory { .. })
                | render::Error::Film { .. }
                | render::Error::Gpu(gpu::Error::NoRoom { .. }),
            )
            | Self::Explain(explain::Error::Room(room::Error::Memory { .. })) => 6,
            Self::Render(render::Error::Room(room::Error::Numbers(_)))
            | Self::Explain(explain::Error::Room(room::Error::Numbers(_))) => 3,
            Self::Usage(_)
            | Self::Scene(SceneError::Pixels(_))
            | Self::Sizes(_)
            | Self::Explain(_)
            | Self::Film(film::Error::Ending(_))
            | Self::Render(render::Error::Outside(_) | render::Error::Samples(_) | render::Error::Untold(_)) => 2,
            Self::Scene(_) | Self::Merge(_) | Self::Part(..) => 3,
            Self::Film(_) | Self::Stdout(_) => 4,
            #[cfg(feature = "viewer")]
            Self::Window(_) => 5,
            Self::Render(render::Error::Gpu(_)) | Self::Gpu(_) => 5,
            // Only who asked for the stop knows why; without a reason it is the deadline's.
            Self::Deadline | Self::Render(render::Error::Stopped) => 7,
            Self::Signal(number) => 128 + number,
        })
    }

    /// Whether the next picture may fare better.
    pub(crate) fn is_of_one_scene(&self) -> bool {
        matches!(
            self,
            Self::Scene(_)
                | Self::Render(
                    render::Error::Outside(_)
                        | render::Error::Samples(_)
                        | render::Error::Untold(_)
                        | render::Error::Room(_)
                        | render::Error::Film { .. }
                )
        )
    }
}
