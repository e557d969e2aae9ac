//! `twinlight`: arguments -> a job -> a picture or a sentence.

mod compare;
mod info;
mod job;
mod render;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// Renders 3-D scenes in compute shaders, each stage with a CPU twin.
#[derive(Debug, Parser)]
#[command(version, about, max_term_width = 100, after_help = EXIT_CODES)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

const EXIT_CODES: &str = "\
Exit codes:
  0  done                            4  a file could not be written
  1  the comparison failed           5  the GPU could not be used or failed
  2  wrong arguments                 6  not enough memory
  3  something is wrong with a scene

Words go to stderr, what was asked for to stdout or its file.";

#[derive(Debug, Subcommand)]
enum Command {
    /// Render a scene to a picture.
    ///
    /// The picture is written whole or not at all: what stood there before stays until the new one is
    /// complete. Without a GPU the picture comes from the CPU, and a line says so.
    #[command(after_help = "Examples:
  twinlight render scenes/room.toml
  twinlight render scenes/room.toml -o room.tga --size 320x240 --samples 4 --backend cpu")]
    Render(render::Arguments),
    /// Render a scene on both backends and say where they differ.
    ///
    /// Prints the tolerance table with what was found, writes `cpu | gpu | difference` side by side, and ends
    /// with exit code 1 if anything is over its tolerance.
    Compare(compare::Arguments),
    /// List the adapters, what of their limits matters, and what would be used and why.
    Info(info::Arguments),
    /// Print the JSON Schema of scene files, for editors.
    Schema,
}

fn main() -> ExitCode {
    let done = match Arguments::parse().command {
        Command::Render(arguments) => render::run(&arguments),
        Command::Compare(arguments) => compare::run(&arguments),
        Command::Info(arguments) => info::run(&arguments),
        Command::Schema => job::say(&twinlight::scene::file::schema()),
    };
    match done {
        Ok(code) => code,
        Err(failure) => {
            eprintln!("error: {failure}");
            failure.code()
        }
    }
}
