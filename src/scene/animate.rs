//! a scene's document and a frame -> the values to put into it

use std::f64::consts::TAU;
use std::ops::Range;

use glam::{DQuat, DVec3};
use toml::Value;
use toml::de::{DeTable, DeValue};

use super::file::{Animation, Interpolation, Key, Orbit, Track};
use super::place::Place;

/// A value that a frame puts in.
#[derive(Debug)]
pub(super) struct Edit {
    pub(super) place: Place,
    /// As TOML writes it.
    pub(super) text: String,
    /// Where the animation says so.
    pub(super) span: Range<usize>,
}

/// What is wrong with an animation, and where.
pub(super) type Wrong = (Range<usize>, String);

/// All that a frame changes, in the order of the file: a value that two things change is the last one's.
pub(super) fn edits(animation: &Animation, document: &DeTable<'_>, frame: i64) -> Result<Vec<Edit>, Wrong> {
    let tracks = animation.track.iter().map(|track| follow(track, frame));
    let orbits = animation.orbit.iter().map(|orbit| {
        let turns = f64::from(orbit.turns.0) * (frame - 1) as f64 / f64::from(animation.frames.0);
        turn(orbit, document, turns)
    });
    tracks.chain(orbits).collect()
}

fn follow(track: &Track, frame: i64) -> Result<Edit, Wrong> {
    let place = Place::parse(track.target.get()).map_err(|why| (track.target.span(), why))?;
    let wrong = |why: &str| (track.keys.span(), why.to_owned());
    let keys = track.keys.get();
    if keys.is_empty() || keys.windows(2).any(|two| two[0].frame >= two[1].frame) {
        return Err(wrong("keys are at least one, and each is at a later frame than the one before it"));
    }
    let before = keys.iter().rposition(|key| key.frame <= frame);
    let value = match before {
        None => keys[0].value.clone(),
        Some(i) if i + 1 == keys.len() || keys[i].frame == frame => keys[i].value.clone(),
        Some(i) if track.interpolation == Interpolation::Step => keys[i].value.clone(),
        Some(i) => between(keys, i, frame, track.interpolation).ok_or_else(|| {
            wrong("between keys there are numbers, or lists of as many numbers; all else needs \"step\"")
        })?,
    };
    Ok(Edit { place, text: value.to_string(), span: track.keys.span() })
}

/// The value between the keys `i` and `i + 1`.
fn between(keys: &[Key], i: usize, frame: i64, how: Interpolation) -> Option<Value> {
    let time = |i: usize| keys[i].frame as f64;
    let [start, end] = [i, i + 1];
    let t = (frame as f64 - time(start)) / (time(end) - time(start));
    let (a, b) = (&keys[start].value, &keys[end].value);
    if how == Interpolation::Linear {
        return mix(&[(a, 1.0 - t), (b, t)]);
    }
    // Cubic Hermite with the slope of the neighbors' chord at each key: Catmull and Rom (1974), for uneven steps.
    let length = time(end) - time(start);
    let (t2, t3) = (t * t, t * t * t);
    let mut parts = vec![(a, 2.0 * t3 - 3.0 * t2 + 1.0), (b, 3.0 * t2 - 2.0 * t3)];
    for (key, weight) in [(start, t3 - 2.0 * t2 + t), (end, t3 - t2)] {
        let (low, high) = (key.saturating_sub(1), (key + 1).min(keys.len() - 1));
        let slope = weight * length / (time(high) - time(low));
        parts.extend([(&keys[high].value, slope), (&keys[low].value, -slope)]);
    }
    mix(&parts)
}

/// A weighted sum, number by number.
fn mix(parts: &[(&Value, f64)]) -> Option<Value> {
    if let Some((Value::Array(first), _)) = parts.first() {
        let entry = |i: usize| {
            let entries = parts.iter().map(|(value, weight)| match value {
                Value::Array(list) if list.len() == first.len() => Some((&list[i], *weight)),
                _ => None,
            });
            mix(&entries.collect::<Option<Vec<_>>>()?)
        };
        return (0..first.len()).map(entry).collect::<Option<Vec<_>>>().map(Value::Array);
    }
    let numbers = parts.iter().map(|(value, weight)| Some(number(value)? * weight));
    Some(shown(numbers.collect::<Option<Vec<_>>>()?.into_iter().sum()))
}

fn number(value: &Value) -> Option<f64> {
    match value {
        Value::Integer(whole) => Some(*whole as f64),
        Value::Float(number) => Some(*number),
        _ => None,
    }
}

/// A number in the simplest form: counts are whole numbers, and all other fields take those too.
fn shown(number: f64) -> Value {
    if number.fract() == 0.0 && number.abs() < 1e15 {
        return Value::Integer(number as i64);
    }
    Value::Float(number)
}

fn turn(orbit: &Orbit, document: &DeTable<'_>, turns: f64) -> Result<Edit, Wrong> {
    let wrong = |why: String| (orbit.target.span(), why);
    let place = Place::parse(orbit.target.get()).map_err(wrong)?;
    let at = place.get(document).and_then(|value| three(value.get_ref()));
    let at = at.ok_or_else(|| {
        wrong(format!("{place} is no list of three numbers in this file; only such a list turns"))
    })?;
    let around = orbit.around.0.as_dvec3();
    // Whole turns and none are exact.
    let angle = turns.fract() * TAU;
    let turned = DQuat::from_axis_angle(orbit.axis.0.as_dvec3().normalize(), angle) * (at - around) + around;
    let turned = if angle == 0.0 { at } else { turned };
    let list = Value::Array(turned.to_array().map(shown).to_vec());
    Ok(Edit { place, text: list.to_string(), span: orbit.target.span() })
}

fn three(value: &DeValue<'_>) -> Option<DVec3> {
    let DeValue::Array(list) = value else { return None };
    let part = |entry: &super::place::Value<'_>| match entry.get_ref() {
        DeValue::Integer(whole) => {
            i64::from_str_radix(whole.as_str(), whole.radix()).ok().map(|whole| whole as f64)
        }
        DeValue::Float(float) => float.as_str().parse().ok(),
        _ => None,
    };
    let parts: Option<Vec<f64>> = list.iter().map(part).collect();
    <[f64; 3]>::try_from(parts?).ok().map(DVec3::from_array)
}
