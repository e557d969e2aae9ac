//! the list of fields -> panels in which they are changed

use eframe::egui::{self, Ui};
use twinlight::scene::{Draft, Held};
use twinlight::view::desk::Desk;
use twinlight::view::fields::{Field, GROUPS, Group, Kind};

/// All groups; what went wrong, if something did.
pub(super) fn panels(ui: &mut Ui, desk: &mut Desk) -> Option<String> {
    let mut changed = None;
    for group in GROUPS {
        let count = if group.many { desk.draft().count(group.place) } else { 1 };
        for number in 0..count {
            let place = if group.many { format!("{}[{number}]", group.place) } else { group.place.to_owned() };
            let title = title(group, desk.draft(), &place, number);
            egui::CollapsingHeader::new(title).id_salt(&place).show(ui, |ui| {
                egui::Grid::new(&place).num_columns(2).show(ui, |ui| {
                    for field in group.fields {
                        let label = ui.label(field.name);
                        let at = format!("{place}.{}", field.name);
                        let now = desk.draft().get(&at).or_else(|| usual(field));
                        if let Some(new) = now.and_then(|now| input(ui, label.id, &at, field.kind, now)) {
                            changed = Some((at, new));
                        }
                        ui.end_row();
                    }
                });
            });
        }
    }
    let (place, value) = changed?;
    desk.set(&place, &value).err()
}

fn title(group: &Group, draft: &Draft, place: &str, number: usize) -> String {
    match draft.get(&format!("{place}.name")) {
        Some(Held::Word(name)) => format!("{} {name}", group.title),
        _ if group.many => format!("{} {}", group.title, number + 1),
        _ => group.title.to_owned(),
    }
}

/// What a field holds that is not in the file.
fn usual(field: &Field) -> Option<Held> {
    let mut one = Draft::new("").ok()?;
    one.set("usual", field.usual).ok()?;
    one.get("usual")
}

/// The input of one field; what it holds now, if that is something else.
fn input(ui: &mut Ui, label: egui::Id, place: &str, kind: Kind, now: Held) -> Option<Held> {
    match (kind, now) {
        (Kind::Number(low, high), Held::Number(x)) => number(ui, label, low, high, x, false).map(Held::Number),
        (Kind::Whole(low, high), Held::Number(x)) => number(ui, label, low, high, x, true).map(Held::Number),
        (Kind::Numbers(low, high), Held::Numbers(mut list)) => {
            let whole = low == 1.0;
            let mut changed = false;
            ui.horizontal(|ui| {
                for x in &mut list {
                    if let Some(new) = number(ui, label, low, high, *x, whole) {
                        (*x, changed) = (new, true);
                    }
                }
            });
            changed.then_some(Held::Numbers(list))
        }
        (Kind::Color, Held::Numbers(list)) => {
            let mut rgb = <[f64; 3]>::try_from(list).ok()?.map(|part| part as f32);
            let picked = egui::color_picker::color_edit_button_rgb(ui, &mut rgb).labelled_by(label).changed();
            let short = |part: f32| f64::from((part * 1e4).round()) / 1e4;
            picked.then(|| Held::Numbers(rgb.map(short).to_vec()))
        }
        (Kind::Color, Held::Word(word)) => {
            let color = egui::Color32::from_hex(&word).ok()?;
            let mut rgb = [color.r(), color.g(), color.b()];
            let picked = egui::color_picker::color_edit_button_srgb(ui, &mut rgb).labelled_by(label).changed();
            let [red, green, blue] = rgb;
            picked.then(|| Held::Word(format!("#{red:02x}{green:02x}{blue:02x}")))
        }
        (Kind::Word(words), Held::Word(word)) => {
            let new = choice(ui, label, place, words.iter().map(ToString::to_string), &word)?;
            Some(Held::Word(new))
        }
        (Kind::OneOf(numbers), Held::Number(x)) => {
            let new = choice(ui, label, place, numbers.iter().map(ToString::to_string), &format!("{x:.0}"))?;
            new.parse().ok().map(Held::Number)
        }
        // What is not as the list has it is for the file to change.
        _ => None,
    }
}

fn number(ui: &mut Ui, label: egui::Id, low: f64, high: f64, x: f64, whole: bool) -> Option<f64> {
    let mut new = x;
    // Numbers without an end move by their own size.
    let speed = if whole { 0.2 } else { (high - low).min(x.abs().max(0.1)) * 0.01 };
    let drag =
        egui::DragValue::new(&mut new).range(low..=high).speed(speed).max_decimals(if whole { 0 } else { 5 });
    ui.add(drag).labelled_by(label).changed().then_some(new)
}

fn choice(
    ui: &mut Ui,
    label: egui::Id,
    place: &str,
    all: impl Iterator<Item = String>,
    now: &str,
) -> Option<String> {
    let mut picked = None;
    let shown = egui::ComboBox::from_id_salt(place).selected_text(now).show_ui(ui, |ui| {
        for word in all {
            if ui.selectable_label(word == now, &word).clicked() && word != now {
                picked = Some(word);
            }
        }
    });
    shown.response.labelled_by(label);
    picked
}
