//! `twinlight`: arguments -> a job -> a picture or a sentence.

mod bands;
mod call;
mod check;
mod claim;
mod compare;
mod explain;
mod eye;
mod failure;
mod frames;
mod info;
mod job;
mod merge;
mod names;
mod plan;
mod progress;
mod render;
mod stop;
mod times;
mod told;
mod view;
mod writer;

use std::process::ExitCode;

use clap::{CommandFactory as _, Parser, Subcommand};

/// Renders 3-D scenes in compute shaders, each stage with a CPU twin.
#[derive(Debug, Parser)]
#[command(version, about, max_term_width = 100, after_help = EXIT_CODES)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

const EXIT_CODES: &str = "\
Exit codes:
  0  done                              5  the GPU could not be used or failed
  1  the comparison failed             6  not enough memory
  2  wrong arguments                   7  the deadline passed before all was done
  3  something is wrong with a scene   130, 143  stopped by Ctrl-C or SIGTERM
  4  a file could not be written

Words go to stderr, what was asked for to stdout or its file.";

#[derive(Debug, Subcommand)]
enum Command {
    /// Render scenes to pictures.
    ///
    /// A picture is written whole or not at all: what stood there before stays until the new one is
    /// complete. A picture knows what it was made of, so the same command makes only what is not there
    /// yet; several processes with one command share the work. The first Ctrl-C stops after the slice of
    /// work in hand, the second at once. Without a GPU the picture comes from the CPU, and a line says so.
    #[command(after_help = "Examples:
  twinlight render scenes/room.toml
  twinlight render scenes/room.toml -o room.tga --size 320x240 --samples 4 --backend cpu
  twinlight render scenes/turntable.toml --frames 1-100:2 -o frames/
  twinlight render scenes/turntable.toml --size 320x320 -o turntable.png
  twinlight render scenes/*.toml --set camera.fov=50 -o 'out/{scene}.png' --json --deadline 1h")]
    Render(Box<render::Arguments>),
    /// Render a scene on both backends and say where they differ.
    ///
    /// Prints the tolerance table with what was found, writes `cpu | gpu | difference` side by side, and ends
    /// with exit code 1 if anything is over its tolerance.
    Compare(Box<compare::Arguments>),
    /// Tell everything that made a pixel, each figure beside the spec's equation.
    ///
    /// The CPU twin makes the pixel again and tells what it has in hand; the last line is the rendered
    /// pixel to the bit.
    #[command(after_help = explain::SHAPE)]
    Explain(Box<explain::Arguments>),
    /// Render a scene on the GPU and say how long each stage took there.
    ///
    /// It is rendered twice, and the second time is told: the first one compiles the kernels.
    Times(Box<times::Arguments>),
    /// Put together what several `render --sample-range` have made, as if it had been made at once.
    ///
    /// Every sample must be there once, and all parts of one picture: the same scene, settings and version.
    #[command(after_help = "Example:
  twinlight render scenes/room.toml --samples 256 --sample-range 0..128 -o a.part
  twinlight render scenes/room.toml --samples 256 --sample-range 128..256 -o b.part
  twinlight merge a.part b.part -o room.png")]
    Merge(merge::Arguments),
    /// Look at a scene or a model in a window: by either method, on either backend.
    ///
    /// The picture follows the hand; the ray tracer is coarse while the eye moves and refines while it rests. H lists
    /// the keys. Scenes and models can be dropped on the window.
    View(Box<view::Arguments>),
    /// Say whether scenes can be rendered, all their frames, without rendering them.
    Check(check::Arguments),
    /// List the adapters, what of their limits matters, and what would be used and why.
    Info(info::Arguments),
    /// Print the JSON Schema of scene files, for editors.
    Schema,
    /// Print the completions of a shell: `twinlight completions bash > /etc/bash_completion.d/twinlight`.
    Completions {
        /// Which shell.
        shell: clap_complete::Shell,
    },
}

fn completions(shell: clap_complete::Shell) -> Result<ExitCode, job::Failure> {
    let mut text = Vec::new();
    clap_complete::generate(shell, &mut Arguments::command(), "twinlight", &mut text);
    job::say(text)
}

fn main() -> ExitCode {
    let done = match Arguments::parse().command {
        Command::Render(arguments) => render::run(&arguments),
        Command::Compare(arguments) => compare::run(&arguments),
        Command::Explain(arguments) => explain::run(&arguments),
        Command::Times(arguments) => times::run(&arguments),
        Command::Merge(arguments) => merge::run(&arguments),
        Command::View(arguments) => view::run(&arguments),
        Command::Check(arguments) => check::run(&arguments),
        Command::Completions { shell } => completions(shell),
        Command::Info(arguments) => info::run(&arguments),
        Command::Schema => job::say(twinlight::scene::file::schema()),
    };
    match done {
        Ok(code) => code,
        Err(failure) => {
            eprintln!("error: {failure}");
            failure.code()
        }
    }
}
