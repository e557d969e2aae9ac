//! `{scene}-{frame:4}.png` -> the name of a picture

use std::path::{Path, PathBuf};

/// The most digits of a frame's number.
const MOST_DIGITS: usize = 12;

/// A name with places for the scene's name and the frame's number.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Template(Vec<Part>);

#[derive(Debug, Clone, PartialEq, Eq)]
enum Part {
    Text(String),
    Scene,
    /// With at least so many digits.
    Frame(usize),
}

/// Reads `{scene}`, `{frame}`, `{frame:4}` and, in the last part of the path, `####`.
pub(crate) fn template(text: &str) -> Result<Template, String> {
    let right = "a name may hold {scene}, {frame}, {frame:4} and ####";
    if text.is_empty() {
        return Err(right.to_owned());
    }
    let mut parts = Vec::new();
    let mut rest = text;
    while let Some(at) = rest.find(['{', '#']) {
        let (before, from) = rest.split_at(at);
        push(&mut parts, before);
        if let Some(after) = from.strip_prefix('{') {
            let (inside, after) = after.split_once('}').ok_or_else(|| format!("{text}: {right}"))?;
            parts.push(match inside.split_once(':') {
                None if inside == "scene" => Part::Scene,
                None if inside == "frame" => Part::Frame(1),
                Some(("frame", digits)) => {
                    let digits = digits.parse().ok().filter(|digits| (1..=MOST_DIGITS).contains(digits));
                    Part::Frame(digits.ok_or_else(|| format!("{text}: a frame has 1 to {MOST_DIGITS} digits"))?)
                }
                _ => return Err(format!("{text}: there is no {{{inside}}}; {right}")),
            });
            rest = after;
        } else {
            let after = from.trim_start_matches('#');
            let digits = from.len() - after.len();
            // One alone is part of many names: take#2.png.
            if digits == 1 {
                push(&mut parts, "#");
            } else {
                parts.push(Part::Frame(digits.min(MOST_DIGITS)));
            }
            rest = after;
        }
    }
    push(&mut parts, rest);
    Ok(Template(parts))
}

fn push(parts: &mut Vec<Part>, text: &str) {
    if !text.is_empty() {
        parts.push(Part::Text(text.to_owned()));
    }
}

impl Template {
    /// Whether frames get names of their own.
    pub(crate) fn tells_frames_apart(&self) -> bool {
        self.0.iter().any(|part| matches!(part, Part::Frame(_)))
    }

    /// The picture's name.
    pub(crate) fn fill(&self, scene: &Path, frame: i64) -> PathBuf {
        let stem = scene.file_stem().unwrap_or_default().to_string_lossy();
        let parts = self.0.iter().map(|part| match part {
            Part::Text(text) => text.clone(),
            Part::Scene => stem.to_string(),
            Part::Frame(digits) => format!("{frame:0digits$}"),
        });
        parts.collect::<String>().into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_filled() {
        for (text, wanted) in [
            ("a.png", "a.png"),
            ("{scene}.png", "room.png"),
            ("out/{scene}-{frame:4}.png", "out/room-0017.png"),
            ("{frame}.exr", "17.exr"),
            ("a.####.png", "a.0017.png"),
            ("take#2-##.png", "take#2-17.png"),
            ("{scene}/{scene}#####.png", "room/room00017.png"),
        ] {
            let template = template(text).unwrap_or_else(|why| panic!("{why}"));
            assert_eq!(template.fill(Path::new("scenes/room.toml"), 17), Path::new(wanted));
            assert_eq!(template.tells_frames_apart(), wanted.contains("17"), "{text}");
        }
        for wrong in ["", "{", "{scene", "{shot}.png", "{frame:}", "{frame:0}", "{frame:99}", "{frame:x}.png"] {
            assert!(template(wrong).is_err(), "{wrong}");
        }
    }
}
