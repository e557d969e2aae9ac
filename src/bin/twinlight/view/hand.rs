//! egui's keys and drags -> what the desk understands

use eframe::egui::{self, Key, KeyboardShortcut, Modifiers, PointerButton};
use glam::{Vec2, Vec3};
use twinlight::view::desk::Hand;
use twinlight::view::keys::{Command, KEYS};

/// A key as the list writes it.
fn chord(text: &str) -> Option<KeyboardShortcut> {
    let mut modifiers = Modifiers::NONE;
    let mut key = None;
    for part in text.split('+') {
        match part {
            "Ctrl" => modifiers |= Modifiers::COMMAND,
            "Shift" => modifiers |= Modifiers::SHIFT,
            "Alt" => modifiers |= Modifiers::ALT,
            name => key = Key::from_name(name),
        }
    }
    Some(KeyboardShortcut::new(modifiers, key?))
}

/// What the keys say that were pressed; nothing while somebody types.
pub(super) fn commands(ctx: &egui::Context) -> Vec<Command> {
    if ctx.egui_wants_keyboard_input() {
        return Vec::new();
    }
    ctx.input_mut(|input| {
        let mut said = Vec::new();
        // egui makes events of its own of these two.
        for event in &input.events {
            match event {
                egui::Event::Copy if input.modifiers.shift => said.push(Command::CopyPicture),
                egui::Event::Copy => said.push(Command::CopyCamera),
                egui::Event::Paste(_) => said.push(Command::PasteCamera),
                _ => {}
            }
        }
        // Chords with more keys go first: `Ctrl+Shift+Z` is not `Ctrl+Z`.
        let mut keys: Vec<_> = KEYS.iter().collect();
        keys.sort_by_key(|key| std::cmp::Reverse(key.chord.matches('+').count()));
        let pressed =
            keys.into_iter().filter(|key| chord(key.chord).is_some_and(|keys| input.consume_shortcut(&keys)));
        said.extend(pressed.map(|key| key.command));
        said
    })
}

/// How fast a hand flies: shares of the distance to the pivot in a second.
const SPEED: f32 = 0.7;

/// What the mouse does on a picture.
pub(super) fn moves(ui: &egui::Ui, picture: &egui::Response) -> Vec<Hand> {
    let mut all = Vec::new();
    let rect = picture.rect;
    let share = |v: egui::Vec2| Vec2::new(v.x, v.y) / rect.height();
    let shift = ui.input(|input| input.modifiers.shift);
    let drag = share(picture.drag_delta());
    if drag != Vec2::ZERO {
        if picture.dragged_by(PointerButton::Middle) || (picture.dragged_by(PointerButton::Primary) && shift) {
            all.push(Hand::Pan(drag));
        } else if picture.dragged_by(PointerButton::Primary) {
            all.push(Hand::Orbit(drag));
        } else if picture.dragged_by(PointerButton::Secondary) {
            all.push(Hand::Turn(drag));
        }
    }
    if picture.is_pointer_button_down_on() && ui.input(|input| input.pointer.secondary_down()) {
        let way = ui.input(|input| {
            let axis =
                |more, less| f32::from(u8::from(input.key_down(more))) - f32::from(u8::from(input.key_down(less)));
            Vec3::new(axis(Key::D, Key::A), axis(Key::E, Key::Q), axis(Key::W, Key::S)) * input.stable_dt.min(0.1)
        });
        if way != Vec3::ZERO {
            all.push(Hand::Fly(way * if shift { 4.0 * SPEED } else { SPEED }));
            ui.ctx().request_repaint();
        }
    }
    if let Some(at) = picture.hover_pos() {
        let scroll = ui.input(|input| input.smooth_scroll_delta().y);
        if scroll != 0.0 {
            all.push(Hand::Dolly(share(at - rect.center()), (-scroll * 0.003).exp()));
        }
    }
    all
}
