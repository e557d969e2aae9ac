//! scenes, frames and a name -> the pictures of a call

use std::collections::HashMap;
use std::ops::Range;
use std::path::{Path, PathBuf};

use twinlight::film::Format;
use twinlight::scene::Source;

use crate::frames::Frames;
use crate::job::Failure;
use crate::names::{Template, template};

/// One file and the frames in it: several only in an animated picture.
#[derive(Debug, Clone)]
pub(crate) struct Picture {
    /// Which of the call's scenes.
    pub(crate) scene: usize,
    pub(crate) frames: Vec<i64>,
    /// Nothing for stdout.
    pub(crate) file: Option<PathBuf>,
}

impl Picture {
    /// What to call it.
    pub(crate) fn name(&self) -> String {
        self.file.as_ref().map_or_else(|| "-".to_owned(), |file| file.display().to_string())
    }
}

/// What the command line says of names.
#[derive(Debug)]
pub(crate) struct Names<'a> {
    pub(crate) output: Option<&'a str>,
    pub(crate) frames: Option<&'a Frames>,
    /// Of a part of the samples.
    pub(crate) samples: Option<&'a Range<u32>>,
}

/// The pictures of scenes in their order.
pub(crate) fn plan(sources: &[Source], names: &Names<'_>) -> Result<Vec<Picture>, Failure> {
    let mut pictures = Vec::new();
    for (scene, source) in sources.iter().enumerate() {
        let frames = match (names.frames, source.frames()) {
            (Some(frames), _) => frames.0.clone(),
            (None, Some((count, _))) => (1..=i64::from(count)).collect(),
            (None, None) => vec![1],
        };
        of_scene(scene, source, frames, names, &mut pictures)?;
    }
    let mut seen = HashMap::new();
    for picture in &pictures {
        let Some(file) = &picture.file else { continue };
        if names.samples.is_none() {
            Format::of(file)?;
        } else if file.extension().is_none_or(|ending| ending != "part") {
            return Err(Failure::Usage(format!("{}: the name of a part ends in .part", file.display())));
        }
        // Some file systems take a.png and A.png for one.
        if let Some(other) = seen.insert(file.to_string_lossy().to_lowercase(), picture) {
            let (a, b) = (of(other, sources), of(picture, sources));
            return Err(Failure::Usage(format!(
                "{}: both {a} and {b} would be written there; put {{scene}} or {{frame:4}} into the name",
                file.display()
            )));
        }
    }
    Ok(pictures)
}

/// Sentences about frames that an animation does not have: they are rendered as its keys and orbits go on.
pub(crate) fn beyond(sources: &[Source], frames: &Frames) -> Vec<String> {
    let told = sources.iter().filter_map(|source| {
        let (last, _) = source.frames()?;
        let mut outside = frames.0.iter().filter(|frame| !(1..=i64::from(last)).contains(frame));
        let (first, more) = (outside.next()?, outside.count());
        let others = if more > 0 { format!(" and {more} others are") } else { " is".to_owned() };
        let scene = source.path().display();
        Some(format!(
            "{scene}: frame {first}{others} outside of its 1 to {last}: keys stand still there, orbits go on"
        ))
    });
    told.collect()
}

fn of_scene(
    scene: usize,
    source: &Source,
    frames: Vec<i64>,
    names: &Names<'_>,
    pictures: &mut Vec<Picture>,
) -> Result<(), Failure> {
    let many = source.frames().is_some() || frames.len() > 1;
    let ending = names.samples.map_or_else(|| ".png".to_owned(), |s| format!("-{}-{}.part", s.start, s.end));
    let usual = if many { "{scene}-{frame:4}" } else { "{scene}" }.to_owned() + &ending;
    let name = match names.output {
        Some("-") if pictures.is_empty() && frames.len() == 1 && names.samples.is_none() => {
            pictures.push(Picture { scene, frames, file: None });
            return Ok(());
        }
        Some("-") => return Err(Failure::Usage("one picture alone can be written to stdout".to_owned())),
        Some(folder) if folder.ends_with('/') || Path::new(folder).is_dir() => {
            format!("{}/{usual}", folder.trim_end_matches('/'))
        }
        Some(name) => name.to_owned(),
        None => usual,
    };
    let template: Template = template(&name).map_err(Failure::Usage)?;
    let file = |frame: i64| template.fill(source.path(), frame);
    if frames.len() == 1 || template.tells_frames_apart() {
        pictures.extend(frames.iter().map(|&frame| Picture {
            scene,
            frames: vec![frame],
            file: Some(file(frame)),
        }));
        return Ok(());
    }
    let all = file(frames[0]);
    if names.samples.is_some() || Format::of(&all)? != Format::Png {
        return Err(Failure::Usage(format!(
            "{}: {} frames need {{frame:4}} or #### in the name; in a .png alone they can become one animated picture",
            all.display(),
            frames.len()
        )));
    }
    pictures.push(Picture { scene, frames, file: Some(all) });
    Ok(())
}

fn of(picture: &Picture, sources: &[Source]) -> String {
    let scene = sources[picture.scene].path().display();
    match picture.frames[..] {
        [frame] => format!("{scene} frame {frame}"),
        _ => format!("{scene}"),
    }
}
