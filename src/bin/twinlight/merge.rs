//! `twinlight merge`: parts of a picture's samples -> the picture

use std::fs::File;
use std::path::PathBuf;
use std::process::ExitCode;

use twinlight::film::merge::{Misfit, merge};
use twinlight::film::{self, Format, exr, replace};

use crate::job::Failure;

#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// What `render --sample-range` has made: all samples of one picture, each once.
    #[arg(required = true, value_name = "PART")]
    parts: Vec<PathBuf>,
    /// The picture: .png, .exr, .tga or .ppm.
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
}

pub(crate) fn run(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let output = &arguments.output;
    let format = Format::of(output)?;
    let mut parts = Vec::new();
    for path in &arguments.parts {
        let name = path.display().to_string();
        // A pipe would wait for ever.
        let file = path.metadata().and_then(|about| {
            if about.is_file() { File::open(path) } else { Err(std::io::Error::other("it is not a file")) }
        });
        match file {
            Ok(file) => parts.push((name, file)),
            Err(error) => return Err(Failure::Part(name, error)),
        }
    }
    let (subject, film) = merge(parts)?;
    let encoded = match format {
        Format::Exr => exr::encode(&film, &[], &subject.stamp),
        _ => format.encode(&film.to_rgb8(subject.transfer), &subject.stamp),
    };
    let bytes = encoded.map_err(|why| film::Error::Encode { path: output.clone(), why })?;
    replace(output, &bytes)?;
    eprintln!("{}: {}x{} of {} parts", output.display(), film.width(), film.height(), arguments.parts.len());
    Ok(ExitCode::SUCCESS)
}

impl From<Misfit> for Failure {
    fn from(misfit: Misfit) -> Self {
        Self::Merge(misfit)
    }
}
