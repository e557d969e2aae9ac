//! what is looked at -> the scene's file, the command that renders it, and the camera as text

use std::path::{Path, PathBuf};

use glam::Vec3;

use super::Desk;
use crate::render::live::Side;
use crate::scene::{Camera, Draft, Held, Method};

impl Desk {
    /// The draft with the camera as it stands.
    fn with_camera(&self) -> Result<Draft, String> {
        let mut draft = self.now.draft.clone();
        for (place, value) in camera_edits(&self.scene.camera, &self.home) {
            draft.set(&format!("camera.{place}"), &value.to_toml())?;
        }
        Ok(draft)
    }

    /// Whether the scene's file holds another text than the one that was read.
    #[must_use]
    pub fn is_behind(&self) -> bool {
        let file = self.source.keeps();
        file == self.source.path() && std::fs::read(file).is_ok_and(|text| text != self.file.as_bytes())
    }

    /// Writes the scene's file, or of a model alone a new one; where.
    ///
    /// # Errors
    /// A sentence, if it cannot be written, or holds what somebody else has written; then the file is what it was.
    pub fn save(&mut self) -> Result<PathBuf, String> {
        let mut draft = self.with_camera()?;
        let file = self.source.keeps();
        if self.is_behind() {
            return Err(format!(
                "{}: has changed since it was read, and is not overwritten; once it is read again (F5), save again",
                file.display()
            ));
        }
        if file != self.source.path() && file.exists() {
            return Err(format!("{}: is there already, and is not this scene's", file.display()));
        }
        crate::film::replace(&file, draft.text().as_bytes()).map_err(|error| error.to_string())?;
        draft.saved();
        if file == self.source.path() {
            draft.text().clone_into(&mut self.file);
        }
        self.now.draft = draft;
        self.home = self.scene.camera.clone();
        self.given.clear();
        Ok(file)
    }

    /// The command that renders what is seen now, with so many pixels, into a file.
    ///
    /// # Errors
    /// A sentence, if the camera cannot be written.
    pub fn command(&self, size: [u32; 2], file: &Path) -> Result<String, String> {
        let [size, file] = [format!("{}x{}", size[0], size[1]), file.to_string_lossy().into_owned()];
        let words = self.words(&["film.size"])?;
        let words = ["twinlight", "render"].into_iter().chain(words.iter().map(String::as_str));
        let words = words.chain(["--size", &size, "-o", &file]).map(quoted);
        Ok(words.collect::<Vec<_>>().join(" "))
    }

    /// The scene, and the options with which `render` and `view` see it as it is seen now; some places stay the file's.
    ///
    /// # Errors
    /// A sentence, if the camera cannot be written.
    pub fn words(&self, but: &[&str]) -> Result<Vec<String>, String> {
        let mut words = vec![self.path().to_string_lossy().into_owned()];
        let mut say = |option: &str, value: &str| words.extend([option.to_owned(), value.to_owned()]);
        say("--method", if self.method == Method::Raster { "raster" } else { "trace" });
        say("--backend", if self.side == Side::Gpu { "gpu" } else { "cpu" });
        if self.scene.raster.show.method() == Some(self.method) {
            let show = clap::ValueEnum::to_possible_value(&self.scene.raster.show);
            say("--show", show.as_ref().map_or("color", |show| show.get_name()));
        }
        for (place, value) in self.with_camera()?.edits().iter().filter(|(place, _)| !but.contains(&place.as_str()))
        {
            say("--set", &format!("{place}={value}"));
        }
        Ok(words)
    }

    /// The camera as a scene file has it.
    #[must_use]
    pub fn camera_toml(&self) -> String {
        let Camera { position, look_at, up, fov, near, far, .. } = &self.scene.camera;
        let list = |v: &Vec3| numbers(*v).to_toml();
        format!(
            "[camera]\nposition = {}\nlook_at = {}\nup = {}\nfov = {:?}\nnear = {near:?}\nfar = {far:?}\n",
            list(position),
            list(look_at),
            list(up),
            fov.to_degrees()
        )
    }

    /// Takes up the camera of a text like that of [`Desk::camera_toml`].
    ///
    /// # Errors
    /// A sentence, if there is none in it, or it is not right.
    pub fn paste_camera(&mut self, text: &str) -> Result<(), String> {
        let pasted = Draft::new(text)?;
        let mut draft = self.now.draft.clone();
        let mut any = false;
        for name in ["position", "look_at", "up", "fov", "near", "far"] {
            if let Some(value) = pasted.get(&format!("camera.{name}")) {
                draft.set(&format!("camera.{name}"), &value.to_toml())?;
                any = true;
            }
        }
        if !any {
            return Err("there is no [camera] in the clipboard".to_owned());
        }
        // The scene's own checks say whether it is one.
        let scene = self.source.again(draft.text().to_owned()).and_then(|source| source.scene(1));
        self.set_camera(scene.map_err(|error| error.to_string())?.camera);
        Ok(())
    }
}

/// What of a camera differs from another, as the file would say it.
fn camera_edits(camera: &Camera, home: &Camera) -> Vec<(&'static str, Held)> {
    let mut edits = Vec::new();
    for (name, now, before) in [
        ("position", camera.position, home.position),
        ("look_at", camera.look_at, home.look_at),
        ("up", camera.up, home.up),
    ] {
        if now != before {
            edits.push((name, numbers(now)));
        }
    }
    let degrees = [camera.fov, home.fov].map(f32::to_degrees);
    for (name, now, before) in
        [("fov", degrees[0], degrees[1]), ("near", camera.near, home.near), ("far", camera.far, home.far)]
    {
        if now != before {
            edits.push((name, Held::Number(short(now))));
        }
    }
    edits
}

fn numbers(v: Vec3) -> Held {
    Held::Numbers(v.to_array().map(short).to_vec())
}

/// The f64 with the fewest digits that is this f32.
fn short(x: f32) -> f64 {
    format!("{x:?}").parse().unwrap_or(f64::from(x))
}

/// A word as a shell takes it.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./=:,+%@".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        return word.to_owned();
    }
    format!("'{}'", word.replace('\'', r"'\''"))
}
