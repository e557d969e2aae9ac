//! a sample of the ray tracer -> words

use std::fmt;

use glam::Vec3;

use super::{Page, maps, numbers, thing, vector};
use crate::explain::{Kind, Meeting, Onward, ShadowRay, Traced, TracedSample, Way};

pub(super) fn sample(page: &mut Page<'_, '_>, sample: &TracedSample, i: usize, count: usize) -> fmt::Result {
    page.say("")?;
    page.row(&format!("sample {i} of {count}"), &format!("    at {}, {}", sample.at.x, sample.at.y), "at")?;
    page.depth += 1;
    page.row("its rays", "", "rays")?;
    for (ray, number) in sample.rays.iter().zip(1..) {
        let what = ray.meets.as_ref().map_or_else(|| "nothing".to_owned(), |meeting| thing(&meeting.thing));
        page.say(&format!("{:indent$}{number} {}: {what}", "", word(ray.way), indent = 2 * ray.depth as usize))?;
    }
    for (ray, number) in sample.rays.iter().zip(1..) {
        self::ray(page, sample, ray, number)?;
    }
    page.row("color", &vector(sample.color), "color")?;
    page.row("", "    = what the lights and the background give, ray by ray", "")?;
    page.depth -= 1;
    Ok(())
}

fn word(way: Way) -> &'static str {
    match way {
        Way::Primary => "primary",
        Way::Reflected => "reflected",
        Way::Refracted => "refracted",
    }
}

fn ray(page: &mut Page<'_, '_>, sample: &TracedSample, ray: &Traced, number: u32) -> fmt::Result {
    let inside = if ray.inside { ", inside an object" } else { "" };
    let from = ray.parent.map_or_else(|| " from the eye".to_owned(), |parent| format!(" from ray {}", parent + 1));
    page.say(&format!("ray {number}: {}{from}{inside}", word(ray.way)))?;
    page.depth += 1;
    page.row("counts for", &vector(ray.weight), "weight")?;
    page.row("starts at", &vector(ray.origin), "")?;
    page.row("direction", &vector(ray.direction), if ray.parent.is_none() { "direction" } else { word(ray.way) })?;
    if let Some(meeting) = &ray.meets {
        self::meeting(page, meeting, ray.inside)?;
        for way in &meeting.ways {
            let child = sample.rays.iter().position(|r| r.parent == Some(number - 1) && r.way == way.way);
            onward(page, way, child)?;
        }
    } else {
        page.row("meets", "    nothing", "")?;
    }
    if let Some(light) = ray.background {
        page.row("background gives", &vector(light), "")?;
    }
    page.depth -= 1;
    Ok(())
}

fn meeting(page: &mut Page<'_, '_>, meeting: &Meeting, inside: bool) -> fmt::Result {
    page.row("meets", &format!("    {}", thing(&meeting.thing)), "")?;
    let kind = match meeting.kind {
        Kind::Sphere => "sphere",
        Kind::Plane => "plane",
        Kind::Triangle => "triangle",
    };
    page.row("at t", &numbers(&[f64::from(meeting.t)]), kind)?;
    page.row("point", &vector(meeting.point), "point")?;
    page.row("normal n", &vector(meeting.normal), "normal")?;
    maps(page, &meeting.maps, meeting.tangents)?;
    if meeting.shading != meeting.normal {
        page.row("lit by the normal", &vector(meeting.shading), "shading")?;
    }
    page.row("color", &vector(meeting.color), "")?;
    if meeting.specular != Vec3::ONE {
        page.row("specular weight", &vector(meeting.specular), "")?;
    }
    page.row("local weight, k", &numbers(&[meeting.local, meeting.exponent].map(f64::from)), "")?;
    if inside {
        page.row("lights", "    none is asked inside an object", "lights")?;
    }
    meeting.lights.iter().try_for_each(|light| shadow_ray(page, light))
}

fn shadow_ray(page: &mut Page<'_, '_>, light: &ShadowRay) -> fmt::Result {
    let verdict = match &light.blocker {
        _ if !light.before => "behind the surface".to_owned(),
        _ if light.arrives => "arrives".to_owned(),
        Some(blocker) => format!("hidden by {}", thing(blocker)),
        None => "hidden".to_owned(),
    };
    page.row(&light.light, &format!("    {verdict}"), "lights")?;
    page.depth += 1;
    page.row("toward it", &vector(light.toward), "toward")?;
    if light.before {
        page.row("cos theta, cos^k alpha", &numbers(&light.phong.map(f64::from)), "phong")?;
        let label = if light.arrives { "gives" } else { "would give" };
        page.row(label, &vector(light.color), "")?;
    }
    page.depth -= 1;
    Ok(())
}

fn onward(page: &mut Page<'_, '_>, way: &Onward, child: Option<usize>) -> fmt::Result {
    let counts = vector(way.weight);
    let becomes = match child {
        Some(child) => format!("{counts}   ray {}", child + 1),
        None if way.weight.max_element() == 0.0 => "    none".to_owned(),
        None => format!("{counts}   not followed"),
    };
    page.row(&format!("{} counts for", word(way.way)), &becomes, word(way.way))
}
