//! what can be done by hand -> the keys that do it, as one list for the window and for who asks

use super::eye::From;
use crate::scene::Show;

/// What a key does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Command {
    /// Shows the picture, or one of the things that it is made of.
    Show(Show),
    /// Looks from a side.
    From(From),
    /// Makes everything fit into the picture.
    FrameAll,
    /// Goes back to the scene's own camera.
    Reset,
    /// Takes back what was done last.
    Undo,
    /// Does it again.
    Redo,
    /// Writes the scene file.
    Save,
    /// Copies the camera as TOML.
    CopyCamera,
    /// Takes a camera from the clipboard.
    PasteCamera,
    /// Reads the scene again.
    Reload,
    /// The other method.
    SwitchMethod,
    /// The other backend.
    SwitchSide,
    /// Shows or hides the panels.
    Panels,
    /// Shows this list.
    Help,
    /// Ends what is going on: a list, a dialog, a long work.
    Cancel,
    /// Tells what made the pixel under the cursor.
    Inspect,
    /// Shows or hides how long each stage takes.
    Times,
    /// Shows or hides what the lights see.
    Lights,
    /// Puts another picture beside this one.
    Compare,
    /// Shows where the two differ.
    Difference,
    /// Renders at the film's full size, into a file.
    Render,
    /// Copies the picture.
    CopyPicture,
    /// Writes a picture, and beside it the command that makes it.
    Screenshot,
}

/// A key and what it does. Keys are written as egui names them, with `Ctrl+`, `Shift+` and `Alt+` before them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Key {
    /// As `Ctrl+Shift+Z`.
    pub chord: &'static str,
    /// What it does.
    pub command: Command,
    /// The same in words.
    pub words: &'static str,
}

const fn key(chord: &'static str, command: Command, words: &'static str) -> Key {
    Key { chord, command, words }
}

/// All keys. 1, 3, 7 and 9 with Alt are the fixed views that Blender and F3D have on these digits.
pub const KEYS: &[Key] = &[
    key("1", Command::Show(Show::Color), "show the picture"),
    key("2", Command::Show(Show::Depth), "show the distance from the eye"),
    key("3", Command::Show(Show::Shadow), "show the shadows"),
    key("4", Command::Show(Show::Normal), "show the normals"),
    key("5", Command::Show(Show::Uv), "show the texture coordinates"),
    key("6", Command::Show(Show::Albedo), "show the surfaces' own colors"),
    key("7", Command::Show(Show::Ambient), "show the ambient term"),
    key("8", Command::Show(Show::Diffuse), "show the diffuse term"),
    key("9", Command::Show(Show::Specular), "show the specular term"),
    key("0", Command::Show(Show::Id), "show every face in another color"),
    key("Minus", Command::Show(Show::Tiles), "show how many faces each tile has"),
    key("Equals", Command::Show(Show::Wire), "show the faces' edges"),
    key("Comma", Command::Show(Show::Steps), "show how many steps the ray tracer takes"),
    key("Alt+1", Command::From(From::Front), "look from the front"),
    key("Ctrl+Alt+1", Command::From(From::Back), "look from the back"),
    key("Alt+3", Command::From(From::Right), "look from the right"),
    key("Ctrl+Alt+3", Command::From(From::Left), "look from the left"),
    key("Alt+7", Command::From(From::Top), "look from above"),
    key("Ctrl+Alt+7", Command::From(From::Bottom), "look from below"),
    key("Alt+9", Command::From(From::Corner), "look from a corner"),
    key("Home", Command::FrameAll, "frame all"),
    key("Backspace", Command::Reset, "back to the scene's camera"),
    key("Ctrl+Z", Command::Undo, "undo"),
    key("Ctrl+Shift+Z", Command::Redo, "redo"),
    key("Ctrl+Y", Command::Redo, "redo"),
    key("Ctrl+S", Command::Save, "save the scene file"),
    key("Ctrl+C", Command::CopyCamera, "copy the camera as TOML"),
    key("Ctrl+V", Command::PasteCamera, "paste a camera"),
    key("F5", Command::Reload, "read the scene again"),
    key("M", Command::SwitchMethod, "rasterizer | ray tracer"),
    key("B", Command::SwitchSide, "GPU | CPU"),
    key("I", Command::Inspect, "tell what made the pixel under the cursor"),
    key("T", Command::Times, "how long each stage takes on the GPU"),
    key("L", Command::Lights, "what the lights see: the shadow maps"),
    key(
        "C",
        Command::Compare,
        "compare: GPU | CPU, then rasterizer | ray tracer, then a saved picture if there is one, then none; hold Space for \
         the other alone",
    ),
    key("D", Command::Difference, "the difference of what is compared"),
    key("N", Command::Panels, "panels"),
    key("H", Command::Help, "this list"),
    key("Questionmark", Command::Help, "this list"),
    key("F12", Command::Screenshot, "write the picture, and the command that makes it"),
    key("Ctrl+R", Command::Render, "render at full size, into a file"),
    key("Ctrl+Shift+C", Command::CopyPicture, "copy the picture"),
    key("Escape", Command::Cancel, "close, cancel"),
];

/// What the mouse does, for the same list.
pub const MOUSE: &[(&str, &str)] = &[
    ("drag", "orbit about the pivot"),
    ("Shift+drag, middle drag", "pan"),
    ("wheel", "nearer to what is under the cursor, or away from it"),
    ("double-click", "set the pivot"),
    ("right drag", "look around; with W A S D Q E fly, with Shift faster"),
    ("drop a file", "open a scene or a model; a picture to compare with"),
];

/// The lines of the list that contain every word of a search, whatever the case of letters.
#[must_use]
pub fn search(what: &str) -> Vec<(&'static str, &'static str)> {
    let wanted: Vec<String> = what.split_whitespace().map(str::to_lowercase).collect();
    let all = MOUSE.iter().copied().chain(KEYS.iter().map(|key| (key.chord, key.words)));
    let fits = |line: &(&str, &str)| {
        let text = format!("{} {}", line.0, line.1).to_lowercase();
        wanted.iter().all(|word| text.contains(word.as_str()))
    };
    all.filter(fits).collect()
}
