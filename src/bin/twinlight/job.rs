//! What the commands share: a scene, and what of it the command line says otherwise.

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use twinlight::gpu::Wanted;
use twinlight::scene::value::{Depth, Samples, Side};
use twinlight::scene::{Method, Reach, Scene, Show, Source};

pub(crate) use crate::failure::Failure;

/// Where a scene comes from.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct Input {
    /// Put a value into the scene file, in TOML: --set camera.fov=40 --set 'light.point[0].color="#ffcc88"'.
    #[arg(long = "set", value_name = "FIELD=VALUE")]
    sets: Vec<String>,
    /// Another folder in which the scene's models and pictures may lie; nothing is read from elsewhere.
    #[arg(long = "search-path", value_name = "FOLDER")]
    search: Vec<PathBuf>,
    /// Memory that the film, all faces, and each model may take, as 512M or 4G [default: 60 % of this machine's].
    #[arg(long, value_name = "BYTES", value_parser = bytes)]
    max_memory: Option<u64>,
}

impl Input {
    /// The scene file as the command line wants it.
    pub(crate) fn open(&self, scene: &Path) -> Result<Source, Failure> {
        Ok(Source::open(scene, &self.sets, &self.reach())?)
    }

    pub(crate) fn reach(&self) -> Reach {
        Reach { search: self.search.clone(), memory: self.max_memory, cache: None }
    }
}

/// Where what takes long is kept.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct Keep {
    /// A folder in which the ray tracer's trees over large models are kept, so that they are built once; it may be
    /// shared, and emptied at any time. No picture depends on it.
    #[arg(long, value_name = "FOLDER")]
    cache: Option<PathBuf>,
}

impl Keep {
    pub(crate) fn reach(&self, input: &Input) -> Reach {
        Reach { cache: self.cache.clone(), ..input.reach() }
    }

    #[cfg(feature = "viewer")]
    pub(crate) fn as_arguments(&self) -> Vec<String> {
        let folder = self.cache.iter().map(|folder| folder.to_string_lossy().into_owned());
        folder.flat_map(|folder| ["--cache".to_owned(), folder]).collect()
    }
}

/// What of a scene the command line says otherwise.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct Job {
    #[command(flatten)]
    pub(crate) input: Input,
    /// How to render [default: the scene's method].
    #[arg(long)]
    method: Option<Method>,
    /// The adapter whose name or driver contains this; `twinlight info` lists them.
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
    /// Width and height in pixels, as 800x600 [default: the scene's].
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<[u32; 2]>,
    /// Samples a pixel; a square number lies on an n x n grid: 16 is 4 x 4. The rasterizer takes the next square number
    /// below, 256 at most [default: the scene's].
    #[arg(long, value_name = "N", value_parser = samples)]
    pub(crate) samples: Option<u32>,
    /// Rays in a row, the first one counted [default: the scene's].
    #[arg(long, value_name = "N", value_parser = depth)]
    depth: Option<u32>,
    /// What is shown, by the method that can [default: the picture].
    #[arg(long, value_name = "WHAT")]
    show: Option<Show>,
}

impl Job {
    /// A frame's scene as the command line wants it, and the method.
    pub(crate) fn scene(&self, source: &Source, frame: i64) -> Result<(Scene, Method), Failure> {
        let mut scene = match self.size {
            None => source.scene(frame)?,
            Some(size) => {
                let mut scene = source.scene_to_resize(frame)?;
                scene.resize_within(size, &self.input.reach())?;
                scene
            }
        };
        scene.trace.samples = self.samples.unwrap_or(scene.trace.samples);
        if let Some(samples) = self.samples {
            scene.raster.samples = samples.isqrt().min(16).pow(2);
        }
        let method = scene.method;
        scene.raster.show = self.show.unwrap_or_default();
        scene.trace.depth = self.depth.unwrap_or(scene.trace.depth);
        let shows = scene.raster.show.method();
        if let (Some(asked), Some(shows)) = (self.method, shows)
            && asked != shows
        {
            let [asked, shows] = [asked, shows].map(|method| format!("{method:?}").to_lowercase());
            let why =
                format!("what --show asks for is shown by --method {shows}, and --method {asked} is asked for");
            return Err(Failure::Usage(why));
        }
        Ok((scene, self.method.or(shows).unwrap_or(method)))
    }

    /// The method that is asked for, and what is to be shown.
    #[cfg(feature = "viewer")]
    pub(crate) fn asked(&self) -> (Option<Method>, Option<Show>) {
        (self.method, self.show)
    }

    /// All else that is asked for, as values put into the scene's file.
    #[cfg(feature = "viewer")]
    pub(crate) fn edits(&self) -> Result<Vec<(String, String)>, Failure> {
        let mut edits = Vec::new();
        for set in &self.input.sets {
            let parts = set.split_once('=');
            let (place, value) =
                parts.ok_or_else(|| Failure::Usage("what is set is written as camera.fov=40".to_owned()))?;
            edits.push((place.trim().to_owned(), value.trim().to_owned()));
        }
        let mut put =
            |place: &str, value: Option<String>| edits.extend(value.map(|value| (place.to_owned(), value)));
        put("film.size", self.size.map(|[width, height]| format!("[{width}, {height}]")));
        put("trace.samples", self.samples.map(|samples| samples.to_string()));
        put("raster.samples", self.samples.map(|samples| samples.isqrt().min(16).pow(2).to_string()));
        put("trace.depth", self.depth.map(|depth| depth.to_string()));
        Ok(edits)
    }

    /// What of the arguments is about this machine, and not about what is seen.
    #[cfg(feature = "viewer")]
    pub(crate) fn about_machine(&self) -> Vec<String> {
        let search = self.input.search.iter().map(|path| ("--search-path", path.to_string_lossy().into_owned()));
        let memory = self.input.max_memory.map(|bytes| ("--max-memory", bytes.to_string()));
        let adapter = self.adapter.clone().map(|name| ("--adapter", name));
        let all = search.chain(memory).chain(adapter);
        all.flat_map(|(option, value)| [option.to_owned(), value]).collect()
    }

    /// The adapter that is asked for.
    pub(crate) fn wanted(&self) -> Wanted {
        self.adapter.clone().map_or(Wanted::Best, Wanted::Named)
    }
}

fn size(text: &str) -> Result<[u32; 2], String> {
    let side = |text: &str| Side::new(text.parse().ok()?).map(|side| side.0);
    let sides = text.split_once('x').and_then(|(w, h)| Some([side(w)?, side(h)?]));
    sides.ok_or_else(|| format!("write it as 800x600; {}", Side::RIGHT))
}

fn samples(text: &str) -> Result<u32, String> {
    text.parse().ok().and_then(Samples::new).map(|n| n.0).ok_or_else(|| Samples::RIGHT.to_owned())
}

fn depth(text: &str) -> Result<u32, String> {
    text.parse().ok().and_then(Depth::new).map(|n| n.0).ok_or_else(|| Depth::RIGHT.to_owned())
}

fn bytes(text: &str) -> Result<u64, String> {
    let digits = text.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    let unit = match text[digits.len()..].to_ascii_lowercase().trim_end_matches("ib").trim_end_matches('b') {
        "" => Some(0),
        "k" => Some(10),
        "m" => Some(20),
        "g" => Some(30),
        "t" => Some(40),
        _ => None,
    };
    let bytes = unit.and_then(|unit| digits.parse::<u64>().ok()?.checked_mul(1 << unit));
    bytes.filter(|bytes| *bytes > 0).ok_or_else(|| "memory is written as 512M, 4G or in bytes".to_owned())
}

/// Prints to stdout; a reader that has gone away (`| head`) is no failure.
pub(crate) fn say(text: impl AsRef<[u8]>) -> Result<ExitCode, Failure> {
    let mut out = std::io::stdout().lock();
    match out.write_all(text.as_ref()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => Err(error.into()),
        _ => Ok(ExitCode::SUCCESS),
    }
}
