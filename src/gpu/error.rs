//! Why the GPU did not make a picture.

use std::time::Duration;

use super::Wanted;

/// Why the GPU did not make a picture.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Error {
    /// There is no such adapter.
    #[error("{}", no_adapter(wanted, names))]
    NoAdapter {
        /// What was asked for.
        wanted: Wanted,
        /// What there is.
        names: Vec<String>,
    },
    /// The adapter gives no device.
    #[error("the adapter cannot be opened: {0}")]
    Device(String),
    /// A kernel's source is wrong; the message names its file and line.
    #[error("{0}")]
    Wgsl(String),
    /// A kernel and its caller disagree about a binding.
    #[error("kernel {kernel}, binding {name}: {why}")]
    Binding {
        /// The kernel.
        kernel: String,
        /// The WGSL variable.
        name: String,
        /// What is wrong.
        why: String,
    },
    /// A buffer is larger than one binding may be.
    #[error("buffer {label} would be {bytes} bytes, and one binding may hold {most}; render smaller or on the CPU")]
    TooLarge {
        /// The buffer.
        label: String,
        /// Its size.
        bytes: u64,
        /// The adapter's limit.
        most: u64,
    },
    /// The device has no room for a buffer.
    #[error("the GPU has no room for buffer {label} of {bytes} bytes")]
    NoRoom {
        /// The buffer.
        label: String,
        /// Its size.
        bytes: u64,
    },
    /// More lights than one dispatch may ask.
    #[error(
        "the scene has {lights} lights, and a pixel may ask {most} of them in one go; trace it, or draw on the CPU"
    )]
    Lights {
        /// Those of the scene.
        lights: u32,
        /// How many there may be.
        most: u32,
    },
    /// wgpu refused a call.
    #[error("the GPU refused its work: {0}")]
    Validation(String),
    /// The device is gone.
    #[error("the GPU was lost")]
    Lost,
    /// The device does not answer.
    #[error("the GPU did not finish its work within {} s", .0.as_secs())]
    TimeOut(Duration),
    /// Work was reported as done and was not.
    #[error("the GPU reported work as done that was not: {0}")]
    Incomplete(String),
}

fn no_adapter(wanted: &Wanted, names: &[String]) -> String {
    let has = if names.is_empty() { "there is none at all".to_owned() } else { names.join(", ") };
    match wanted {
        Wanted::Best => "no GPU and no software Vulkan adapter was found".to_owned(),
        Wanted::Software => format!("no software adapter was found; adapters here: {has}"),
        Wanted::Named(name) => format!("no adapter is called {name:?}; adapters here: {has}"),
    }
}
