//! `twinlight info`: this machine -> its adapters, and which would be used

use std::fmt::Write as _;
use std::process::ExitCode;

use twinlight::gpu::{Gpu, Wanted, adapters};

use crate::job::{Failure, say};

#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// Ask for the adapter whose name or driver contains this.
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
}

pub(crate) fn run(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let mut text = format!("twinlight {}\n\nadapters:\n", env!("CARGO_PKG_VERSION"));
    let adapters = adapters();
    if adapters.is_empty() {
        text.push_str("  none\n");
    }
    for adapter in &adapters {
        let [binding, buffers, invocations] = adapter.limits();
        let _ = writeln!(text, "  {} ({}, {}, {})", adapter.name, adapter.kind, adapter.api, adapter.driver);
        let _ = writeln!(
            text,
            "    storage binding {} MiB, {buffers} storage buffers a kernel, {invocations} invocations a workgroup",
            binding >> 20
        );
    }
    text.push_str("    (Twinlight asks for WebGPU's defaults: 128 MiB, 8 and 256)\n\nwould use: ");
    let wanted = arguments.adapter.clone().map_or(Wanted::Best, Wanted::Named);
    let opened = Gpu::open(&wanted);
    match &opened {
        Ok(gpu) => {
            let why = match (&wanted, gpu.adapter().kind) {
                (Wanted::Named(_), _) => "it was asked for by name",
                (_, "software") => "there is no hardware GPU, and a software adapter runs the same kernels",
                _ => "it is the fastest kind of adapter here",
            };
            let alike = if gpu.exact() {
                "computes as the CPU twin does, to the bit"
            } else {
                "may round otherwise than the CPU twin; `twinlight compare SCENE` measures it"
            };
            let _ = writeln!(text, "{}: {why}\n  it {alike}", gpu.adapter().name);
            if gpu.adapter().kind == "software" {
                text.push_str("  (its kernels run on the processor too: `--backend cpu` is mostly faster)\n");
            }
        }
        Err(error) => {
            let _ = writeln!(text, "the CPU: {error}");
        }
    }
    say(&text)?;
    match (wanted, opened) {
        (Wanted::Named(_), Err(error)) => Err(error.into()),
        _ => Ok(ExitCode::SUCCESS),
    }
}
